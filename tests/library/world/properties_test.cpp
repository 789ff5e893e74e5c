// SPDX-License-Identifier: MIT
// Laws of a World that hold whatever the truth is: what began and ended, frame by frame, before and after the boxes of
// all frames were mapped, renamed, doubled or joined by others.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/oracle.hpp"
#include "core/random.hpp"
#include "watched_world.hpp"

namespace boxstream::tests {
namespace {

template <class S>
using Frames = std::vector<Boxes<S>>;

/// Pairs of numbers of boxes that began and ended in each frame, sorted.
struct History {
  std::vector<Pairs> begun, ended;
};

/// On a grid of whole numbers from -200 to 200, where every map below is exact: in each frame some boxes have moved.
template <class S>
Frames<S> grid_frames() {
  const auto n = *rc::gen::inRange<std::size_t>(0, 300);
  const auto longest = *rc::gen::inRange(1, 60);
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  Frames<S> frames(3, Boxes<S>(n));
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t i = 0; i < n; ++i) {
      if (f > 0 && !random.chance(0.4)) {
        frames[f][i] = frames[f - 1][i];
        continue;
      }
      for (int d = 0; d < 3; ++d) {
        const int lo = random.integer(-50, 50);  // close together, so that there is much to begin and end
        frames[f][i].min[d] = static_cast<S>(lo);
        frames[f][i].max[d] = static_cast<S>(lo + random.integer(0, longest));
      }
    }
  return frames;
}

Pairs sorted(Pairs pairs) {
  for (Pair& pair : pairs) pair = {std::min(pair.a, pair.b), std::max(pair.a, pair.b)};
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Boxes are created in the order given, and named by their place in the frames.
template <class S>
History play(const Frames<S>& frames, detail::SearchMode mode, std::vector<std::uint32_t> order = {}) {
  const std::size_t n = frames[0].size();
  if (order.empty()) {
    order.resize(n);
    std::iota(order.begin(), order.end(), 0u);
  }
  detail::WorldCore<S> world({}, mode);
  std::vector<ProxyId> ids(n);
  for (const std::uint32_t i : order) ids[i] = world.create(frames[0][i], {}, i);
  const auto named = [&](Span<const ProxyPair> pairs) {
    Pairs all;
    for (const ProxyPair pair : pairs)
      all.push_back({static_cast<std::uint32_t>(world.user(pair.a)), static_cast<std::uint32_t>(world.user(pair.b))});
    return sorted(all);
  };
  History history;
  for (const auto& boxes : frames) {
    world.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes));
    world.update();
    world.validate();
    history.begun.push_back(named(world.begun()));
    history.ended.push_back(named(world.ended()));
  }
  return history;
}

detail::SearchMode any_mode() {
  return *rc::gen::elementOf(std::vector<detail::SearchMode>(std::begin(search_modes), std::end(search_modes)));
}

void require_same(const History& found, const History& expected) {
  RC_ASSERT(found.begun == expected.begun);
  RC_ASSERT(found.ended == expected.ended);
}

/// Boxes mapped one by one have the history that they had before.
template <class S, class Change>
void same_history_after(Change change) {
  const auto frames = grid_frames<S>();
  auto changed = frames;
  for (auto& boxes : changed)
    for (auto& box : boxes) change(box);
  const auto mode = any_mode();
  require_same(play(changed, mode), play(frames, mode));
}

template <class S>
void translate() {
  const int axis = *rc::gen::inRange(0, 3);
  const S by = std::ldexp(*rc::gen::element(S(1), S(-1)), *rc::gen::inRange(-2, 12));
  same_history_after<S>([=](BasicAabb<S>& box) {
    box.min[axis] += by;
    box.max[axis] += by;
  });
}

template <class S>
void scale() {
  constexpr int most = std::numeric_limits<S>::max_exponent - 10;
  const int exponent = *rc::gen::inRange(-most, most);
  same_history_after<S>([=](BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::ldexp(box.min[d], exponent);
      box.max[d] = std::ldexp(box.max[d], exponent);
    }
  });
}

template <class S>
void mirror() {
  const int axis = *rc::gen::inRange(0, 3);
  same_history_after<S>([=](BasicAabb<S>& box) {
    const S lo = box.min[axis];
    box.min[axis] = -box.max[axis];
    box.max[axis] = -lo;
  });
}

template <class S>
void permute_axes() {
  const int turn = *rc::gen::inRange(0, 3);
  const bool swap = *rc::gen::arbitrary<bool>();
  same_history_after<S>([=](BasicAabb<S>& box) {
    const BasicAabb<S> from = box;
    for (int d = 0; d < 3; ++d) {
      const int to = ((swap && d < 2 ? 1 - d : d) + turn) % 3;
      box.min[to] = from.min[d];
      box.max[to] = from.max[d];
    }
  });
}

/// Onto 401 increasing numbers from the whole range, other ones on each axis: only the order of bounds may matter.
template <class S>
void map_monotonically() {
  using Limits = std::numeric_limits<S>;
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  std::vector<S> table[3];
  for (auto& values : table) {
    values = {-Limits::infinity(), Limits::lowest(), S(0), Limits::denorm_min(), Limits::infinity()};
    while (values.size() < 401) {
      const S step = std::ldexp(static_cast<S>(random.between(1, 2)),
                                random.integer(Limits::min_exponent - 10, Limits::max_exponent - 1));
      values.push_back(random.chance(0.5) ? step : -step);
      if (values.size() < 401) continue;
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    }
  }
  same_history_after<S>([&](BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = table[d][static_cast<std::size_t>(box.min[d] + 200)];
      box.max[d] = table[d][static_cast<std::size_t>(box.max[d] + 200)];
    }
  });
}

/// Created in another order, so with other ids.
template <class S>
void permute_ids() {
  const auto frames = grid_frames<S>();
  std::vector<std::uint32_t> order(frames[0].size());
  std::iota(order.begin(), order.end(), 0u);
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  random.shuffle(order);
  const auto mode = any_mode();
  require_same(play(frames, mode, order), play(frames, mode));
}

template <class S>
Frames<S> joined(const Frames<S>& a, const Frames<S>& b) {
  Frames<S> all = a;
  for (std::size_t f = 0; f < all.size(); ++f) all[f].insert(all[f].end(), b[f].begin(), b[f].end());
  return all;
}

Pairs shifted(Pairs pairs, std::size_t by) {
  for (Pair& pair : pairs) pair = {pair.a + static_cast<std::uint32_t>(by), pair.b + static_cast<std::uint32_t>(by)};
  return pairs;
}

Pairs merged(Pairs pairs, const Pairs& more) {
  pairs.insert(pairs.end(), more.begin(), more.end());
  return sorted(pairs);
}

/// Every box twice: four events for one, and each box with its double, from the start to the end.
template <class S>
void duplicate() {
  const auto frames = grid_frames<S>();
  const auto n = static_cast<std::uint32_t>(frames[0].size());
  const auto mode = any_mode();
  History expected = play(frames, mode);
  for (auto* events : {&expected.begun, &expected.ended})
    for (Pairs& pairs : *events) {
      Pairs four;
      for (const Pair p : pairs) four.insert(four.end(), {p, {p.a, p.b + n}, {p.b, p.a + n}, {p.a + n, p.b + n}});
      pairs = sorted(four);
    }
  for (std::uint32_t i = 0; i < n; ++i) expected.begun[0].push_back({i, i + n});
  expected.begun[0] = sorted(expected.begun[0]);
  require_same(play(joined(frames, frames), mode), expected);
}

/// What two sets have in common beyond what each has alone is what a search between the two finds.
template <class S>
void split_in_two() {
  const auto a = grid_frames<S>(), b = grid_frames<S>();
  const auto mode = any_mode();
  const History of_a = play(a, mode), of_b = play(b, mode), of_all = play(joined(a, b), mode);
  const std::size_t n = a[0].size();
  Pairs between_before;
  for (std::size_t f = 0; f < a.size(); ++f) {
    const auto without_parts = [&](const std::vector<Pairs>& all, const Pairs& part_a, const Pairs& part_b) {
      const Pairs parts = merged(part_a, shifted(part_b, n));
      Pairs rest;
      std::set_difference(all[f].begin(), all[f].end(), parts.begin(), parts.end(), std::back_inserter(rest));
      RC_ASSERT(rest.size() + parts.size() == all[f].size());
      return rest;
    };
    Pairs between = find_pairs(Span<const BasicAabb<S>>(a[f]), Span<const BasicAabb<S>>(b[f]));
    for (Pair& pair : between) pair.b += static_cast<std::uint32_t>(n);
    between = sorted(between);
    Pairs begun, ended;
    std::set_difference(between.begin(), between.end(), between_before.begin(), between_before.end(),
                        std::back_inserter(begun));
    std::set_difference(between_before.begin(), between_before.end(), between.begin(), between.end(),
                        std::back_inserter(ended));
    RC_ASSERT(without_parts(of_all.begun, of_a.begun[f], of_b.begun[f]) == begun);
    RC_ASSERT(without_parts(of_all.ended, of_a.ended[f], of_b.ended[f]) == ended);
    between_before = between;
  }
}

template <class S>
void move_away(Frames<S>& frames) {
  const int axis = *rc::gen::inRange(0, 3);
  const S far = *rc::gen::element(S(1024), S(-65536), S(1048576));
  for (auto& boxes : frames)
    for (auto& box : boxes) {
      box.min[axis] += far;
      box.max[axis] += far;
    }
}

/// Another crowd far away has its own events, and none with this one.
template <class S>
void far_cluster() {
  const auto here = grid_frames<S>();
  auto there = grid_frames<S>();
  const auto mode = any_mode();
  History expected = play(here, mode);
  const History apart = play(there, mode);
  for (std::size_t f = 0; f < here.size(); ++f) {
    expected.begun[f] = merged(expected.begun[f], shifted(apart.begun[f], here[0].size()));
    expected.ended[f] = merged(expected.ended[f], shifted(apart.ended[f], here[0].size()));
  }
  move_away(there);
  require_same(play(joined(here, there), mode), expected);
}

template <class S>
void far_box() {
  const auto here = grid_frames<S>();
  Frames<S> one(here.size(), Boxes<S>{{{0, 0, 0}, {1, 1, 1}}});
  move_away(one);
  const auto mode = any_mode();
  require_same(play(joined(here, one), mode), play(here, mode));
}

#define LAW(Name, law)                            \
  RC_GTEST_PROP(Properties, Name##InFloat, ()) {  \
    law<float>();                                 \
  }                                               \
  RC_GTEST_PROP(Properties, Name##InDouble, ()) { \
    law<double>();                                \
  }
LAW(Translated, translate)
LAW(Scaled, scale)
LAW(Mirrored, mirror)
LAW(AxesPermuted, permute_axes)
LAW(MappedMonotonically, map_monotonically)
LAW(IdsPermuted, permute_ids)
LAW(Duplicated, duplicate)
LAW(SplitInTwoSets, split_in_two)
LAW(FarCluster, far_cluster)
LAW(FarBox, far_box)
#undef LAW

}  // namespace
}  // namespace boxstream::tests
