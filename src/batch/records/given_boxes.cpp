// SPDX-License-Identifier: MIT
#include "batch/records/given_boxes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "base/tolerance.hpp"
#include "batch/records/raise_ends.hpp"

namespace boxstream::detail {

namespace {

using Coordinates = BoxSpan::Coordinates;

// An integer becomes the float of which it is the key; no float has the key -1. Some keys are left for tolerances.
constexpr std::int64_t most_as_key = infinity_key<float> - 4;
// Integers that doubles tell from their neighbours.
constexpr std::int64_t most_as_double = std::int64_t{1} << 53;

bool is_integer(Coordinates coordinates) {
  return coordinates == Coordinates::int32 || coordinates == Coordinates::int64;
}

template <class I>
std::uint64_t largest_magnitude(Span<const BasicAabb<I>> boxes) {
  std::uint64_t largest = 0;
  const auto add = [&](I x) {
    const auto wide = static_cast<std::uint64_t>(std::int64_t{x});
    largest = std::max(largest, x < 0 ? 0 - wide : wide);
  };
  for (const BasicAabb<I>& box : boxes)
    for (int d = 0; d < 3; ++d) {
      add(box.min[d]);
      add(box.max[d]);
    }
  return largest;
}

std::uint64_t largest_magnitude(BoxSpan boxes) {
  switch (boxes.coordinates()) {
    case Coordinates::int32:
      return largest_magnitude(boxes.of<std::int32_t>());
    case Coordinates::int64:
      return largest_magnitude(boxes.of<std::int64_t>());
    default:
      return 0;
  }
}

std::int64_t raised(std::int64_t high, double tolerance, Faces faces) {
  const double whole = faces == Faces::open ? std::ceil(tolerance) : std::floor(tolerance);
  constexpr double most = 0x1p60;  // more than integers can be apart
  return high + static_cast<std::int64_t>(std::min(whole, most));
}

/// Of an integer as a key.
float float_of_key(std::int64_t integer) {
  const auto key = static_cast<std::int32_t>(integer < 0 ? integer - 1 : integer);
  return std::bit_cast<float>(key ^ ((key >> 31) & INT32_MAX));
}

template <class To, class From>
struct Converted {
  double tolerance;
  Faces faces;

  To low(From x) const {
    if constexpr (std::is_floating_point_v<From>)
      return static_cast<To>(x);
    else if constexpr (sizeof(To) == 4)
      return float_of_key(x);
    else
      return static_cast<To>(x);
  }

  To high(From x) const {
    if (tolerance == 0) return low(x);
    if constexpr (std::is_floating_point_v<From> || sizeof(To) == 8)
      return raised(static_cast<To>(x), tolerance, faces);
    else  // compared with integers alone
      return float_of_key(std::min(raised(std::int64_t{x}, tolerance, faces), most_as_key + 1));
  }

  Span<const BasicAabb<To>> operator()(Span<const BasicAabb<From>> boxes, Arena& arena) const {
    auto* const out = arena.allocate<BasicAabb<To>>(boxes.size());
    if constexpr (std::is_same_v<To, float> && std::is_same_v<From, float>) {
      raise_ends(boxes, tolerance, faces, out);
    } else {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const BasicAabb<From>& box = boxes[i];
        const bool is_valid = box.min[0] <= box.max[0] && box.min[1] <= box.max[1] && box.min[2] <= box.max[2];
        for (int d = 0; d < 3; ++d) {
          out[i].min[d] = low(box.min[d]);
          out[i].max[d] = is_valid ? high(box.max[d]) : low(box.max[d]);
        }
      }
    }
    return {out, boxes.size()};
  }
};

}  // namespace

void check(const GivenSets& sets, const PairRules& rules) {
  const auto check_one = [](BoxSpan boxes, Span<const Filter> filters) {
    if (boxes.size() >= UINT32_MAX) throw std::length_error("boxstream: more than 2^32 - 2 boxes in a set");
    if (!filters.empty() && filters.size() != boxes.size())
      throw std::invalid_argument("boxstream: there must be no filters, or one for each box");
  };
  check_one(sets.a, rules.filters);
  if (!sets.self) check_one(sets.b, rules.filters_b);
  const bool has_ids = !rules.ids.empty() || (!sets.self && !rules.ids_b.empty());
  if (has_ids && (rules.ids.size() != sets.a.size() || (!sets.self && rules.ids_b.size() != sets.b.size())))
    throw std::invalid_argument("boxstream: there must be no ids, or one for each box");
  check_tolerance(rules.tolerance);
}

Comparison comparison_of(const GivenSets& sets) {
  const Coordinates a = sets.a.coordinates(), b = sets.b.coordinates();
  const bool has_integers = is_integer(a) || is_integer(b);
  if (!has_integers) return a == b && a == Coordinates::float32 ? Comparison::in_float : Comparison::in_double;
  const std::uint64_t largest = std::max(largest_magnitude(sets.a), sets.self ? 0 : largest_magnitude(sets.b));
  if (largest > std::uint64_t{most_as_double})
    throw std::invalid_argument(
        "boxstream: integers must be within +-2^53; less the least of all, they make the same pairs");
  return is_integer(a) && is_integer(b) && largest <= std::uint64_t{most_as_key} ? Comparison::in_keys
                                                                                 : Comparison::in_double;
}

template <class S>
Span<const BasicAabb<S>> boxes_in(BoxSpan boxes, const PairRules& rules, Arena& arena) {
  const Coordinates same = sizeof(S) == 4 ? Coordinates::float32 : Coordinates::float64;
  if (boxes.coordinates() == same && is_zero(rules.tolerance)) return boxes.of<S>();
  const DefaultFloatEnvironment environment;
  const Faces faces = rules.touching ? Faces::closed : Faces::open;
  switch (boxes.coordinates()) {
    case Coordinates::float32:
      return Converted<S, float>{rules.tolerance, faces}(boxes.of<float>(), arena);
    case Coordinates::float64:
      return Converted<S, double>{rules.tolerance, faces}(boxes.of<double>(), arena);
    case Coordinates::int32:
      return Converted<S, std::int32_t>{rules.tolerance, faces}(boxes.of<std::int32_t>(), arena);
    default:
      return Converted<S, std::int64_t>{rules.tolerance, faces}(boxes.of<std::int64_t>(), arena);
  }
}

template Span<const Aabb> boxes_in(BoxSpan, const PairRules&, Arena&);
template Span<const Aabb64> boxes_in(BoxSpan, const PairRules&, Arena&);

}  // namespace boxstream::detail
