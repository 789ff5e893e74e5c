// SPDX-License-Identifier: MIT
// RapidCheck: inputs that it can shrink to the smallest that fails, and laws that hold whatever the truth is.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "box_sets.hpp"
#include "fast_oracle.hpp"
#include "oracle.hpp"
#include "random.hpp"

namespace boxstream {
// Found by argument-dependent look-up when RapidCheck prints a counterexample.
template <class S>
void showValue(const BasicAabb<S>& box, std::ostream& out) {
  out << "{" << tests::describe(box) << "}";
}
}  // namespace boxstream

namespace boxstream::tests {
namespace {

/// Few values, so that most comparisons are ties, and among them those that break arithmetic.
template <class S>
rc::Gen<S> special_number() {
  using Limits = std::numeric_limits<S>;
  return rc::gen::weightedElement<S>({{8, S(0)},
                                      {8, S(1)},
                                      {8, S(2)},
                                      {8, S(3)},
                                      {4, -S(0)},
                                      {4, S(-1)},
                                      {4, std::nextafter(S(1), S(2))},
                                      {2, Limits::denorm_min()},
                                      {2, -Limits::denorm_min()},
                                      {2, Limits::max()},
                                      {2, Limits::lowest()},
                                      {2, Limits::infinity()},
                                      {2, -Limits::infinity()},
                                      {1, Limits::quiet_NaN()}});
}

/// Usually valid: an inverted interval is turned round, but for one box in 32.
template <class S>
rc::Gen<BasicAabb<S>> special_box() {
  return rc::gen::map(
      rc::gen::pair(rc::gen::container<std::vector<S>>(6, special_number<S>()), rc::gen::inRange(0, 32)),
      [](const std::pair<std::vector<S>, int>& from) {
        BasicAabb<S> box{};
        for (std::size_t d = 0; d < 3; ++d) {
          S lo = from.first[2 * d], hi = from.first[2 * d + 1];
          if (lo > hi && from.second != 31) std::swap(lo, hi);
          box.min[d] = lo;
          box.max[d] = hi;
        }
        return box;
      });
}

template <class S>
rc::Gen<Boxes<S>> special_boxes() {
  return rc::gen::scale(2.0, rc::gen::container<Boxes<S>>(special_box<S>()));
}

/// A counterexample shows the boxes (shrunk) and, by this, the first pair that differs.
template <class S>
void require_same(Pairs found, const Pairs& expected, const Boxes<S>& a, const Boxes<S>& b) {
  const std::string difference = first_difference(std::move(found), expected, a, b);
  RC_ASSERT(difference == std::string());
}

template <class S>
Pairs search(const Boxes<S>& boxes) {
  return find_pairs(Span<const BasicAabb<S>>(boxes));
}
template <class S>
Pairs search(const Boxes<S>& a, const Boxes<S>& b) {
  return find_pairs(Span<const BasicAabb<S>>(a), Span<const BasicAabb<S>>(b));
}

template <class S>
void equals_truth() {
  const auto a = *special_boxes<S>(), b = *special_boxes<S>();
  require_same(search(a), brute_force(a), a, a);
  require_same(search(a, b), brute_force(a, b), a, b);
}

RC_GTEST_PROP(Properties, SpecialNumbersEqualTruthInFloat, ()) {
  equals_truth<float>();
}
RC_GTEST_PROP(Properties, SpecialNumbersEqualTruthInDouble, ()) {
  equals_truth<double>();
}

/// A batch on a grid of whole numbers from -200 to 200, where every map below is exact. Shrinks towards few boxes, and
/// large enough for a tree when it is not shrunk.
template <class S>
Boxes<S> grid_boxes() {
  const auto n = *rc::gen::inRange<std::size_t>(0, 1500);
  const auto longest = *rc::gen::inRange(0, 60);
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  const int long_axis = random.integer(0, 2);
  Boxes<S> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const int lo = random.integer(-200, 200 - longest);
      const int length = random.integer(0, d == long_axis ? longest : longest / 8 + 8);
      box.min[d] = static_cast<S>(lo);
      box.max[d] = static_cast<S>(std::min(lo + length, 200));
    }
  return boxes;
}

/// What is found after `change` was made to every box must be what was found before.
template <class S, class Change>
void same_pairs_after(Change change) {
  const auto boxes = grid_boxes<S>();
  auto changed = boxes;
  for (auto& box : changed) change(box);
  Pairs before = search(boxes);
  std::sort(before.begin(), before.end());
  require_same(search(changed), before, changed, changed);
}

template <class S>
void translate() {
  const int exponent = *rc::gen::inRange(-2, 12), axis = *rc::gen::inRange(0, 3);
  const S by = std::ldexp(*rc::gen::element(S(1), S(-1)), exponent);
  same_pairs_after<S>([=](BasicAabb<S>& box) {
    box.min[axis] += by;
    box.max[axis] += by;
  });
}
RC_GTEST_PROP(Properties, TranslatedInFloat, ()) {
  translate<float>();
}
RC_GTEST_PROP(Properties, TranslatedInDouble, ()) {
  translate<double>();
}

template <class S>
void scale() {
  constexpr int most = std::numeric_limits<S>::max_exponent - 10;
  const int exponent = *rc::gen::inRange(-most, most);
  same_pairs_after<S>([=](BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::ldexp(box.min[d], exponent);
      box.max[d] = std::ldexp(box.max[d], exponent);
    }
  });
}
RC_GTEST_PROP(Properties, ScaledInFloat, ()) {
  scale<float>();
}
RC_GTEST_PROP(Properties, ScaledInDouble, ()) {
  scale<double>();
}

template <class S>
void mirror() {
  const int axis = *rc::gen::inRange(0, 3);
  same_pairs_after<S>([=](BasicAabb<S>& box) {
    const S lo = box.min[axis];
    box.min[axis] = -box.max[axis];
    box.max[axis] = -lo;
  });
}
RC_GTEST_PROP(Properties, MirroredInFloat, ()) {
  mirror<float>();
}
RC_GTEST_PROP(Properties, MirroredInDouble, ()) {
  mirror<double>();
}

template <class S>
void permute_axes() {
  const int turn = *rc::gen::inRange(1, 3);
  const bool swap = *rc::gen::arbitrary<bool>();
  same_pairs_after<S>([=](BasicAabb<S>& box) {
    const BasicAabb<S> from = box;
    for (int d = 0; d < 3; ++d) {
      const int to = (swap && d < 2 ? 1 - d : d);
      box.min[(to + turn) % 3] = from.min[d];
      box.max[(to + turn) % 3] = from.max[d];
    }
  });
}
RC_GTEST_PROP(Properties, AxesPermutedInFloat, ()) {
  permute_axes<float>();
}
RC_GTEST_PROP(Properties, AxesPermutedInDouble, ()) {
  permute_axes<double>();
}

/// Any strictly increasing map of the coordinates, a different one on each axis, here onto 401 random numbers from the
/// whole range of the scalar: only the order of bounds may matter.
template <class S>
void map_monotonically() {
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  using Limits = std::numeric_limits<S>;
  std::vector<S> table[3];
  for (auto& values : table) {
    values = {-Limits::infinity(), Limits::lowest(), S(0), Limits::denorm_min(), Limits::infinity()};
    while (values.size() < 401) {
      const double mantissa = random.between(1, 2) * (random.chance(0.5) ? 1 : -1);
      const S value =
          std::ldexp(static_cast<S>(mantissa), random.integer(Limits::min_exponent - 10, Limits::max_exponent - 1));
      values.push_back(random.chance(0.3) ? std::nextafter(values.back(), S(0)) : value);
      if (values.size() == 401) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
      }
    }
    std::sort(values.begin(), values.end());
  }
  same_pairs_after<S>([&](BasicAabb<S>& box) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = table[d][static_cast<std::size_t>(box.min[d] + 200)];
      box.max[d] = table[d][static_cast<std::size_t>(box.max[d] + 200)];
    }
  });
}
RC_GTEST_PROP(Properties, MappedMonotonicallyInFloat, ()) {
  map_monotonically<float>();
}
RC_GTEST_PROP(Properties, MappedMonotonicallyInDouble, ()) {
  map_monotonically<double>();
}

/// pairs(A and B) = pairs(A) + pairs(B) + pairs between A and B.
template <class S>
void split_in_two() {
  const auto all = grid_boxes<S>();
  const auto cut = *rc::gen::inRange<std::size_t>(0, all.size() + 1);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(cut);
  const Boxes<S> a(all.begin(), middle), b(middle, all.end());
  const auto offset = static_cast<std::uint32_t>(cut);
  Pairs parts = search(a);
  for (const Pair pair : search(b)) parts.push_back({pair.a + offset, pair.b + offset});
  for (const Pair pair : search(a, b)) parts.push_back({pair.a, pair.b + offset});
  std::sort(parts.begin(), parts.end());
  require_same(search(all), parts, all, all);
}
RC_GTEST_PROP(Properties, SplitInTwoSetsInFloat, ()) {
  split_in_two<float>();
}
RC_GTEST_PROP(Properties, SplitInTwoSetsInDouble, ()) {
  split_in_two<double>();
}

/// Which set is called the first changes nothing but the order within pairs.
template <class S>
void swap_sets() {
  const auto a = grid_boxes<S>(), b = grid_boxes<S>();
  Pairs swapped = search(b, a);
  for (Pair& pair : swapped) std::swap(pair.a, pair.b);
  std::sort(swapped.begin(), swapped.end());
  require_same(search(a, b), swapped, a, b);
}
RC_GTEST_PROP(Properties, SetsSwappedInFloat, ()) {
  swap_sets<float>();
}
RC_GTEST_PROP(Properties, SetsSwappedInDouble, ()) {
  swap_sets<double>();
}

/// Every box twice: four pairs for one, and each box with its double.
template <class S>
void duplicate() {
  const auto once = grid_boxes<S>();
  auto twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  const auto n = static_cast<std::uint32_t>(once.size());
  Pairs expected;
  for (std::uint32_t i = 0; i < n; ++i) expected.push_back({i, n + i});
  for (const Pair pair : search(once))
    expected.insert(expected.end(), {pair, {pair.a, pair.b + n}, {pair.b, pair.a + n}, {pair.a + n, pair.b + n}});
  std::sort(expected.begin(), expected.end());
  require_same(search(twice), expected, twice, twice);
}
RC_GTEST_PROP(Properties, DuplicatedInFloat, ()) {
  duplicate<float>();
}
RC_GTEST_PROP(Properties, DuplicatedInDouble, ()) {
  duplicate<double>();
}

/// Another batch far away adds its own pairs and no others.
template <class S>
void far_cluster() {
  const auto here = grid_boxes<S>();
  auto all = here, there = grid_boxes<S>();
  Pairs expected = search(here);
  const auto offset = static_cast<std::uint32_t>(here.size());
  for (const Pair pair : search(there)) expected.push_back({pair.a + offset, pair.b + offset});
  std::sort(expected.begin(), expected.end());
  const int axis = *rc::gen::inRange(0, 3);
  const S far = *rc::gen::element(S(1024), S(-65536), S(1048576));
  for (auto& box : there) {
    box.min[axis] += far;
    box.max[axis] += far;
  }
  all.insert(all.end(), there.begin(), there.end());
  require_same(search(all), expected, all, all);
}
RC_GTEST_PROP(Properties, FarClusterInFloat, ()) {
  far_cluster<float>();
}
RC_GTEST_PROP(Properties, FarClusterInDouble, ()) {
  far_cluster<double>();
}

/// A box far from all others adds no pair, wherever in the input it stands.
template <class S>
void far_box() {
  auto boxes = grid_boxes<S>();
  Pairs expected = search(boxes);
  const auto at = *rc::gen::inRange<std::size_t>(0, boxes.size() + 1);
  const auto renamed = [&](std::uint32_t i) { return i < at ? i : i + 1; };
  for (Pair& pair : expected) pair = {renamed(pair.a), renamed(pair.b)};
  std::sort(expected.begin(), expected.end());
  BasicAabb<S> box{{-1, -1, -1}, {1, 1, 1}};
  const int axis = *rc::gen::inRange(0, 3);
  const S far =
      *rc::gen::element(S(1024), S(-65536), std::numeric_limits<S>::max(), -std::numeric_limits<S>::infinity());
  box.min[axis] = box.max[axis] = far;
  boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(at), box);
  require_same(search(boxes), expected, boxes, boxes);
}
RC_GTEST_PROP(Properties, FarBoxInFloat, ()) {
  far_box<float>();
}
RC_GTEST_PROP(Properties, FarBoxInDouble, ()) {
  far_box<double>();
}

/// Indices permuted: the same pairs under their new names.
template <class S>
void permute_ids() {
  const auto boxes = grid_boxes<S>();
  Random random(*rc::gen::inRange<std::uint64_t>(0, 1000000));
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  random.shuffle(order);
  Boxes<S> permuted;
  for (const std::uint32_t i : order) permuted.push_back(boxes[i]);
  Pairs renamed = search(permuted);
  for (Pair& pair : renamed) {
    pair = {order[pair.a], order[pair.b]};
    if (pair.b < pair.a) std::swap(pair.a, pair.b);
  }
  Pairs before = search(boxes);
  std::sort(before.begin(), before.end());
  require_same(renamed, before, boxes, boxes);
}
RC_GTEST_PROP(Properties, IdsPermutedInFloat, ()) {
  permute_ids<float>();
}
RC_GTEST_PROP(Properties, IdsPermutedInDouble, ()) {
  permute_ids<double>();
}

/// The laws above compare searches with each other; this ties their input to the truth.
template <class S>
void grid_equals_truth() {
  const auto a = grid_boxes<S>(), b = grid_boxes<S>();
  require_same(search(a), sweep(a), a, a);
  require_same(search(a, b), sweep(a, b), a, b);
}
RC_GTEST_PROP(Properties, GridEqualsTruthInFloat, ()) {
  grid_equals_truth<float>();
}
RC_GTEST_PROP(Properties, GridEqualsTruthInDouble, ()) {
  grid_equals_truth<double>();
}

}  // namespace
}  // namespace boxstream::tests
