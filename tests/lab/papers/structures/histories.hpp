// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>

#include "box_sets.hpp"
#include "papers/structures/binary_structure.hpp"
#include "papers/structures/kd_builder.hpp"
#include "papers/structures/kd_tree.hpp"
#include "papers/structures/worst_case_structure.hpp"

/// The two dynamic k-d trees, what must be true of them after each operation, and histories to put them through.
namespace boxstream::papers::tests {

using boxstream::tests::Random;
using Binary = BinaryStructure<KdBoxes>;
using WorstCase = WorstCaseStructure<KdBoxes, KdBuilder<6>>;
using Numbers = std::vector<std::uint32_t>;

inline Aabb random_box(Random& random) {
  const auto at = [&] { return static_cast<float>(random.integer(0, 30)); };
  const auto side = [&] { return static_cast<float>(random.integer(0, 4)); };
  return box_at(at(), at(), at(), side(), side(), side());
}

inline std::vector<KdPoint<6>> points_of(const std::vector<Aabb>& boxes) {
  std::vector<KdPoint<6>> points;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) points.push_back(as_point(boxes[i], i));
  return points;
}

inline std::uint64_t log_up(std::size_t n) {
  return n < 2 ? 0 : static_cast<std::uint64_t>(std::bit_width(n - 1));
}

inline void check_invariants(const Binary& binary) {
  // A part for each bit, of just that many objects; never as many deleted as alive.
  std::size_t stored = 0;
  for (std::size_t i = 0; i < binary.parts().size(); ++i) {
    const std::size_t size = binary.parts()[i].items().size();
    ASSERT_EQ(size, binary.stored() & (std::size_t{1} << i));
    stored += size;
  }
  ASSERT_EQ(stored, binary.stored());
  ASSERT_TRUE(2 * binary.size() > binary.stored() || binary.stored() == 0);
}

/// What a level of SteppedLevels does at an insertion, added up over levels: theorem 13 with the constants of
/// KdBuilder.
inline std::uint64_t most_insertion_work(std::size_t stored) {
  std::uint64_t work = 1;
  for (std::uint64_t level = 1; level <= log_up(stored + 1); ++level) work += 3 + level * 17;
  return work;
}

inline void check_invariants(const WorstCase& structure) {
  std::size_t stored = 0;
  for (std::size_t level = 0; level < structure.levels().level_count(); ++level) {
    ASSERT_LE(structure.levels().parts_at(level), 3u) << level;
    stored += structure.levels().parts_at(level) << level;
  }
  structure.levels().for_each_part([](const auto& part) { ASSERT_TRUE(std::has_single_bit(part->items().size())); });
  ASSERT_EQ(stored, structure.stored());
  ASSERT_TRUE(2 * structure.size() >= structure.stored());
  // Two insertions more for the second structure; its building, B(n) and two looks at each object, in n / 8 operations,
  // which are no fewer than n / 16 for n >= 8.
  const std::uint64_t most =
      3 * most_insertion_work(structure.stored()) + 16 * (6 + 17 * log_up(structure.stored())) + 1;
  ASSERT_LE(structure.last_work(), most) << structure.stored();
}

/// A history with its brute force beside it.
template <class Dynamic>
class History {
 public:
  explicit History(std::uint64_t seed, std::size_t at_first) : random_(seed) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < at_first; ++i) boxes.push_back(random_box(random_));
    dynamic_ = Dynamic(points_of(boxes));
    for (std::uint32_t i = 0; i < at_first; ++i) live_[next_number_++] = {i, boxes[i]};
  }

  void insert() {
    const Aabb box = random_box(random_);
    const std::uint32_t number = next_number_++;
    live_[number] = {dynamic_.insert(as_point(box, number)), box};
  }

  void erase() {
    if (live_.empty()) return;
    auto gone = live_.begin();
    std::advance(gone, static_cast<std::ptrdiff_t>(random_.index(std::min<std::size_t>(live_.size(), 40))));
    const auto handle = gone->second.handle;
    ASSERT_TRUE(dynamic_.erase(handle));
    ASSERT_FALSE(dynamic_.erase(handle));
    live_.erase(gone);
  }

  void check() {
    ASSERT_EQ(dynamic_.size(), live_.size());
    check_invariants(dynamic_);
  }

  void check_query() {
    const Aabb wanted = random_.chance(0.1) ? box_at(-1, -1, -1, 99, 99, 99) : random_box(random_);
    Numbers expected, found;
    for (const auto& [number, entry] : live_)
      if (overlaps(entry.box, wanted)) expected.push_back(number);
    dynamic_.query(touching(wanted), [&](std::uint32_t number) { found.push_back(number); });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }

  /// Of `operations`, this share are insertions.
  void run(int operations, double insertions) {
    for (int i = 0; i < operations; ++i) {
      random_.chance(insertions) ? insert() : erase();
      ASSERT_NO_FATAL_FAILURE(check());
      if (i % 3 == 0) {
        ASSERT_NO_FATAL_FAILURE(check_query());
      }
    }
  }

  const Dynamic& dynamic() const { return dynamic_; }

 private:
  struct Entry {
    typename Dynamic::Handle handle;
    Aabb box;
  };
  Random random_;
  Dynamic dynamic_;
  std::map<std::uint32_t, Entry> live_;
  std::uint32_t next_number_ = 0;
};

}  // namespace boxstream::papers::tests
