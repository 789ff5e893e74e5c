// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <boxstream/near.hpp>
#include <boxstream/span.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "inputs/random.hpp"

namespace boxstream::papers {

/// Where a set is split: at the median of a coordinate, or, as in the experiments of section 3, at that of a random
/// object.
enum class Pivot { median, random };

/// The divide and conquer algorithm of sections 2.2 and 2.3, for objects whose reference points have `D` coordinates,
/// and whose reference points differ by at most `reach` (the paper's 2 delta) in each of them where the objects
/// intersect. `Coordinate` is S(const Object&, std::size_t d), `Intersects` is bool(const Object&, const Object&) and
/// `Found` is void(std::uint32_t, std::uint32_t), the smaller number first.
template <std::size_t D, class S, class Object, class Coordinate, class Intersects, class Found>
class ThickSearch {
  static_assert(D >= 1);

 public:
  ThickSearch(Span<const Object> objects, S reach, Pivot pivot, const Coordinate& coordinate,
              const Intersects& intersects, Found& found)
      : reach_(reach), pivot_(pivot), coordinate_(coordinate), intersects_(intersects), found_(found) {
    if (objects.size() > std::numeric_limits<std::uint32_t>::max()) throw std::length_error("too many thick objects");
    if (!(reach >= 0)) throw std::invalid_argument("the diameter of thick objects must not be below 0");
    items_.reserve(objects.size());
    for (const Object& object : objects) {
      for (std::size_t d = 0; d < D; ++d)
        if (!std::isfinite(coordinate(object, d))) throw std::invalid_argument("a reference point is not finite");
      items_.push_back({object, static_cast<std::uint32_t>(items_.size())});
    }
    disjoint_ = items_;
  }

  void run() { search(items_.data(), items_.data() + items_.size(), D); }

 private:
  struct Item {
    Object object;
    std::uint32_t number;
  };

  /// The flag that the paper passes at recursive calls, for one coordinate: pairs of which both are <= below, or both
  /// >= above, have been reported with the neighbourhood of an earlier split. Those of all earlier splits lie within
  /// these two, of the nearest on either side.
  struct Done {
    S below = -std::numeric_limits<S>::infinity(), above = std::numeric_limits<S>::infinity();
  };

  S at(const Item& item, std::size_t d) const { return coordinate_(item.object, d); }

  void report(const Item& a, const Item& b) {
    for (std::size_t d = 1; d < D; ++d) {
      const S x = at(a, d), y = at(b, d);
      if (std::max(x, y) <= done_[d].below || std::min(x, y) >= done_[d].above) return;
    }
    found_(std::min(a.number, b.number), std::max(a.number, b.number));
  }

  /// Section 2.3.1, in the first `dimensions` coordinates; all objects of the range are within 2 reach in the others.
  ///
  /// All parts of the set are made in place: what is near the split lies in the middle, so that it is one range for the
  /// call in one dimension less, and is then parted in two for the calls on either side.
  ///
  /// Sums that are rounded lose nothing: if x >= y + r for a number x of the type, then x >= y + r as it is rounded.
  /// That is also why `top` below is made from `low` and not from the minimum. Equal coordinates: a set that Case 2
  /// hardly splits, since most of its coordinates are the median, is halved by whatever case comes next.
  void search(Item* first, Item* last, std::size_t dimensions) {
    if (last - first < 2) return;
    const std::size_t d = dimensions - 1;
    if (d == 0) return search_line(first, last);
    S min = at(*first, d), max = min;
    for (const Item* item = first + 1; item != last; ++item) {
      min = std::min(min, at(*item, d));
      max = std::max(max, at(*item, d));
    }
    if (max - min <= 2 * reach_) return search(first, last, d);  // Case 1

    const S split = choose(first, last, d), low = min + reach_, high = max - reach_;
    const auto part = [&](Item* begin, Item* end, const auto& is_first) {
      return std::partition(begin, end, [&](const Item& item) { return is_first(at(item, d)); });
    };
    const Done before = done_[d];
    if (split <= low) {  // Case 3
      const S top = low + reach_;
      Item* const beyond = part(first, last, [&](S x) { return x <= top; });
      search(first, beyond, d);
      Item* const upper = part(first, beyond, [&](S x) { return x <= low; });
      done_[d].below = top;
      search(upper, last, dimensions);
    } else if (split >= high) {  // Case 4
      const S bottom = high - reach_;
      Item* const near = part(first, last, [&](S x) { return x < bottom; });
      search(near, last, d);
      Item* const lower_end = part(near, last, [&](S x) { return x < high; });
      done_[d].above = bottom;
      search(first, lower_end, dimensions);
    } else {  // Case 2
      const S bottom = split - reach_, top = split + reach_;
      Item* const near = part(first, last, [&](S x) { return x < bottom; });
      Item* const beyond = part(near, last, [&](S x) { return x <= top; });
      search(near, beyond, d);
      Item* const upper = part(near, beyond, [&](S x) { return x < split; });
      done_[d].above = bottom;
      search(first, upper, dimensions);
      done_[d] = {top, before.above};
      search(upper, last, dimensions);
    }
    done_[d] = before;
  }

  S choose(Item* first, Item* last, std::size_t d) {
    if (pivot_ == Pivot::random) return at(first[random_.integer(0, last - first - 1)], d);
    Item* const middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](const Item& a, const Item& b) { return at(a, d) < at(b, d); });
    return at(*middle, d);
  }

  /// Section 2.2. Each round walks along the line and moves those that intersect nothing moved before to `disjoint_`, a
  /// maximal set of disjoint objects. Few of these are within reach of one place, so looking at all that are costs
  /// little. Then those that are left, in order, are searched in the same way.
  void search_line(Item* first, Item* last) {
    std::sort(first, last, [this](const Item& a, const Item& b) { return comes_before(a, b); });
    while (last - first > 1) {
      Item *const separated = disjoint_.data(), *disjoint_end = separated, *rest = first;
      for (const Item* item = first; item != last; ++item) {
        const S least = at(*item, 0) - reach_;
        bool disjoint = true;
        for (const Item* other = disjoint_end; other != separated && at(*(other - 1), 0) >= least; --other)
          if (intersects_(item->object, (other - 1)->object)) {
            disjoint = false;
            report(*item, *(other - 1));
          }
        *(disjoint ? disjoint_end++ : rest++) = *item;
      }
      // The other way round, for those of `disjoint_` that came later.
      const Item* next = separated;
      for (const Item* item = first; item != rest; ++item) {
        while (next != disjoint_end && comes_before(*next, *item)) ++next;
        const S most = at(*item, 0) + reach_;
        for (const Item* other = next; other != disjoint_end && at(*other, 0) <= most; ++other)
          if (intersects_(item->object, other->object)) report(*item, *other);
      }
      // They have been dealt with here, but belong to sets of more dimensions.
      std::copy(separated, disjoint_end, rest);
      last = rest;
    }
  }

  bool comes_before(const Item& a, const Item& b) const {
    const S x = at(a, 0), y = at(b, 0);
    return x != y ? x < y : a.number < b.number;
  }

  S reach_;
  Pivot pivot_;
  const Coordinate& coordinate_;
  const Intersects& intersects_;
  Found& found_;
  std::vector<Item> items_, disjoint_;
  std::array<Done, D> done_{};
  batches::Random random_{1};
};

/// Reports all pairs of objects that intersect, each exactly once, as found(i, j) with i < j.
///
/// `coordinate(object, d)`, d < D, is that of a point of the object, its reference point; finite, in a floating type.
/// `diameter` is at least that of every object, in the unit of the coordinates. `intersects(a, b)` is the caller's
/// predicate; it is called once or a few times for a pair that can be near, in either order.
/// Time: O(n log n + c (n + k)) for k pairs, where c is how many disjoint objects can have their reference points in a
/// cube of edge 4 `diameter`: few for thick objects of about one size. It is right, but slow, for others.
/// Memory: two copies of each object with a number, whatever k is; recursion to a depth of O(D log n).
/// Errors: std::invalid_argument, std::length_error (2^32 objects), and what the functions throw.
/// Source: "Reporting intersections among thick objects", where the type of the numbers is that of the predicates: only
/// coordinates are compared, so that the degree of the algorithm is that of `intersects`.
template <std::size_t D, class Object, class S, class Coordinate, class Intersects, class Found>
void report_intersections(Span<const Object> objects, S diameter, const Coordinate& coordinate,
                          const Intersects& intersects, Found&& found, Pivot pivot = Pivot::median) {
  ThickSearch<D, S, Object, Coordinate, Intersects, Found>(objects, 2 * diameter, pivot, coordinate, intersects, found)
      .run();
}

/// The same with a bound of the caller's own: where two objects intersect, no coordinate of their reference points
/// differs by more than `reach`. That is `diameter` in place of twice as much where reference points are centres.
template <std::size_t D, class Object, class S, class Coordinate, class Intersects, class Found>
void report_within_reach(Span<const Object> objects, S reach, const Coordinate& coordinate,
                         const Intersects& intersects, Found&& found, Pivot pivot = Pivot::median) {
  ThickSearch<D, S, Object, Coordinate, Intersects, Found>(objects, reach, pivot, coordinate, intersects, found).run();
}

/// Fixed-radius near neighbours, the paper's instance of the algorithm: what `boxstream::find_near_pairs` finds, for
/// points, disks (D = 2: z is 0, or the same for all) and balls (D = 3). `found(i, j)`, i < j, for each pair once.
///
/// The objects are the balls, each grown by half of `distance`. Their centres are the reference points, which cannot
/// differ by more than the largest diameter. The predicate is `is_near`, of degree two and exact; the algorithm adds
/// comparisons of coordinates only, so all of it is.
/// Errors: std::invalid_argument for an invalid ball, and for a distance that is not finite and >= 0.
template <std::size_t D, class S, class Found>
void thick_near_pairs(Span<const BasicBall<S>> balls, S distance, Found&& found, Pivot pivot = Pivot::median) {
  if (!(std::isfinite(distance) && distance >= 0)) throw std::invalid_argument("a distance must be finite and >= 0");
  S largest = 0;
  for (const BasicBall<S>& ball : balls) {
    if (!(std::isfinite(ball.radius) && ball.radius >= 0))
      throw std::invalid_argument("a radius is not finite and >= 0");
    largest = std::max(largest, ball.radius);
  }
  // Two roundings, and half a ulp is made up for by more than one.
  constexpr S more = 1 + 4 * std::numeric_limits<S>::epsilon();
  const S reach = (2 * largest + distance) * more + std::numeric_limits<S>::denorm_min();
  report_within_reach<D>(
      balls, reach, [](const BasicBall<S>& ball, std::size_t d) { return ball.centre[d]; },
      [distance](const BasicBall<S>& a, const BasicBall<S>& b) { return is_near(a, b, distance); }, found, pivot);
}

}  // namespace boxstream::papers
