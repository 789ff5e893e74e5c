// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>

#include "inputs/batches.hpp"
#include "random.hpp"

/// Sets on which structures break: empty, alone, all in one place, flat, in a row, touching, and batches of all kinds.
namespace boxstream::papers::tests {

struct BoxSet {
  std::string name;
  std::vector<Aabb> boxes;
};

inline Aabb box_at(float x, float y, float z, float sx = 0, float sy = 0, float sz = 0) {
  return {{x, y, z}, {x + sx, y + sy, z + sz}};
}

inline std::vector<BoxSet> box_sets() {
  std::vector<BoxSet> sets{{"none", {}},
                           {"one", {box_at(1, 2, 3, 1, 1, 1)}},
                           {"one point", {box_at(-5, 0, 7)}},
                           {"two apart", {box_at(0, 0, 0, 1, 1, 1), box_at(9, 9, 9, 1, 1, 1)}},
                           {"identical points", std::vector<Aabb>(100, box_at(1e6F, -3, 0.1F))},
                           {"identical boxes", std::vector<Aabb>(100, box_at(1, 1, 1, 2, 3, 4))}};
  BoxSet row{"points in a row", {}}, slanted{"points on a line", {}}, sheet{"flat sheet", {}}, tied{"few values", {}};
  boxstream::tests::Random random(11);
  for (int i = 0; i < 300; ++i) {
    const auto at = static_cast<float>(random.integer(0, 99));
    row.boxes.push_back(box_at(at, 0, 0));
    slanted.boxes.push_back(box_at(at, 2 * at, -at));
    sheet.boxes.push_back(
        box_at(at, static_cast<float>(random.integer(0, 99)), 0.5F, static_cast<float>(random.integer(0, 9)), 2, 0));
    const auto few = [&] { return static_cast<float>(random.integer(0, 3)); };
    tied.boxes.push_back(box_at(few(), few(), few(), few(), few(), few()));
  }
  for (const BoxSet& set : {row, slanted, sheet, tied}) sets.push_back(set);
  for (const auto& batch : batches::all())
    sets.push_back({std::string(batch.name), batches::make(batch.name, batch.quadratic ? 60 : 400, 3)});
  return sets;
}

/// Small and large, in the midst of the set and beside it, and some that only touch one of its boxes.
inline std::vector<Aabb> queries_for(const std::vector<Aabb>& boxes, std::size_t count, std::uint64_t seed) {
  boxstream::tests::Random random(seed);
  std::vector<Aabb> queries;
  const Aabb unit = box_at(-1, -1, -1, 2, 2, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const Aabb& a = boxes.empty() ? unit : boxes[random.index(boxes.size())];
    const Aabb& b = boxes.empty() || random.chance(0.5) ? a : boxes[random.index(boxes.size())];
    Aabb query = random.chance(0.5) ? merged(a, b) : a;
    const int axis = random.integer(0, 2);
    if (random.chance(0.3)) query.max[axis] = query.min[axis];                    // a touch
    if (random.chance(0.1)) query.min[axis] = query.max[axis] = b.max[axis] + 1;  // perhaps a miss
    queries.push_back(query);
  }
  return queries;
}

}  // namespace boxstream::papers::tests
