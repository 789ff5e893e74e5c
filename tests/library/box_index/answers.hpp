// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include <boxstream/box_index.hpp>

#include "core/box_sets.hpp"
#include "world/model.hpp"
#include "world/values.hpp"

namespace boxstream::tests {

template <class S>
std::vector<std::size_t> in_box(const BasicBoxIndex<S>& index, const BasicAabb<S>& box) {
  std::vector<std::size_t> found;
  index.query_box(box, [&](std::uint32_t i) {
    found.push_back(i);
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

template <class S>
std::map<std::size_t, S> on_ray(const BasicBoxIndex<S>& index, const BasicRay<S>& ray) {
  std::map<std::size_t, S> found;
  index.query_ray(ray, [&](std::uint32_t i, S enter, S length) {
    EXPECT_TRUE(found.emplace(i, enter).second) << "met twice";
    return length;
  });
  return found;
}

template <class S>
std::vector<std::size_t> nearest(const BasicBoxIndex<S>& index, const S (&point)[3], std::size_t count) {
  std::vector<std::uint32_t> out(count);
  out.resize(index.query_nearest(point, Span<std::uint32_t>(out)));
  return {out.begin(), out.end()};
}

/// The boxes as a World would have them, looked at one by one.
template <class S>
Model<S> model_of(const Boxes<S>& boxes) {
  Model<S> model(false);
  for (std::uint32_t i = 0; i < boxes.size(); ++i) model.create({i, 1}, boxes[i], {}, 0);
  return model;
}

/// All that can be asked, about a few places.
template <class S>
void expect_answers(const BasicBoxIndex<S>& index, const Boxes<S>& boxes, const Boxes<S>& places) {
  const Model<S> model = model_of(boxes);
  ASSERT_EQ(index.size(), boxes.size());
  constexpr S inf = std::numeric_limits<S>::infinity();
  BasicAabb<S> all{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const BasicAabb<S>& box : boxes)
    if (makes_sense(box)) all = merged(all, box);
  EXPECT_TRUE(index.bounds() == all);

  std::vector<Pair> together, one_by_one;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const BasicAabb<S>& place = places[i];
    const auto touching = model.in_box(place);
    ASSERT_EQ(in_box(index, place), touching);
    for (const std::size_t box : touching) one_by_one.push_back({i, static_cast<std::uint32_t>(box)});

    for (const auto& ray : {ray_from<S>(i), BasicRay<S>::along(place.min, place.max, 1)})
      ASSERT_EQ(on_ray(index, ray), model.on_ray(ray));

    const S point[3] = {place.min[0], place.max[1], place.min[2]};
    ASSERT_EQ(nearest(index, point, 1 + i * 7 % 40), model.nearest(point, 1 + i * 7 % 40));

    const BasicPlane<S> planes[] = {{{1, S(0.5), -1}, -place.min[0]}, {{0, -1, S(i % 3)}, place.max[1]}};
    const Span<const BasicPlane<S>> some(planes, i % 3);
    std::vector<std::size_t> before, expected;
    index.query_planes(some, [&](std::uint32_t box) {
      before.push_back(box);
      return true;
    });
    std::sort(before.begin(), before.end());
    for (std::size_t box = 0; box < boxes.size(); ++box)
      if (makes_sense(boxes[box]) &&
          std::none_of(some.begin(), some.end(), [&](const auto& plane) { return is_behind(boxes[box], plane); }))
        expected.push_back(box);
    ASSERT_EQ(before, expected);

    if (!makes_sense(place)) continue;
    std::size_t last = boxes.size();
    S least = inf;
    index.query_nearest_box(place, inf, [&](std::uint32_t box, S distance) {
      last = box;
      return least = distance;
    });
    ASSERT_EQ(last == boxes.size(), model.nearest(point, 1).empty());
    ASSERT_TRUE(touching.empty() || least == 0);
  }
  index.query_boxes(places, together);
  std::sort(together.begin(), together.end());
  std::sort(one_by_one.begin(), one_by_one.end());
  ASSERT_EQ(together, one_by_one);
}

}  // namespace boxstream::tests
