// SPDX-License-Identifier: MIT
// Queries by planes: what is behind one, against sums in integers as wide as it takes; what a World finds, against
// asking box by box.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <boxstream/plane.hpp>
#include <boxstream/world.hpp>

#include "core/oracle.hpp"
#include "float_environment.hpp"
#include "values.hpp"

namespace boxstream::tests {

namespace {

/// A sum of products of doubles without any rounding, in bits from 2^-2400 to 2^2400.
class ExactSum {
 public:
  void add(double x, double y, int exponent = 0) {
    if (x == 0 || y == 0) return;
    int of_x, of_y;
    const auto a = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &of_x)), 53));
    const auto b = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(y, &of_y)), 53));
    Bits& sum = (x < 0) == (y < 0) ? positive_ : negative_;
    const int at = of_x + of_y + exponent - 106 + 2400;
    for (unsigned i = 0; i < 2; ++i)
      for (unsigned k = 0; k < 2; ++k) add(sum, half(a, i) * half(b, k), static_cast<unsigned>(at) + 32 * (i + k));
  }
  bool is_negative() const {
    return std::lexicographical_compare(positive_.rbegin(), positive_.rend(), negative_.rbegin(), negative_.rend());
  }

 private:
  using Bits = std::array<std::uint32_t, 150>;

  static std::uint64_t half(std::uint64_t x, unsigned i) { return i == 0 ? x & 0xffffffff : x >> 32; }
  static void add(Bits& sum, std::uint64_t part, unsigned at) {
    const unsigned shift = at % 32;
    const std::uint64_t words[] = {part << shift & 0xffffffff, (part << shift) >> 32,
                                   shift == 0 ? 0 : part >> (64 - shift)};
    std::uint64_t carry = 0;
    for (unsigned i = at / 32, k = 0; k < 3 || carry != 0; ++i, ++k) {
      carry += sum.at(i) + (k < 3 ? words[k] : 0);
      sum[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }

  Bits positive_{}, negative_{};
};

enum class Side { behind, hardly_behind, before };

/// What `is_behind` may say, by its contract.
template <class S>
Side side_of(const BasicAabb<S>& box, const BasicPlane<S>& plane) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double least = sizeof(S) == 4 ? 0x1p-126 : 0x1p-300;
  const double offset = plane.offset;
  double normal[3], corner[3], largest = 0;
  bool unbounded = false, at_infinity = false, rounded = false;
  for (int d = 0; d < 3; ++d) {
    normal[d] = plane.normal[d];
    if (std::isnan(normal[d]) || std::isinf(normal[d])) return Side::before;
    corner[d] = normal[d] > 0 ? box.max[d] : box.min[d];
    if (normal[d] == 0) corner[d] = 0;
    unbounded = unbounded || corner[d] == (normal[d] > 0 ? inf : -inf);
    at_infinity = at_infinity || std::isinf(corner[d]);
    rounded = rounded || (normal[d] != 0 && std::abs(corner[d]) < least);
    largest = std::max(largest, std::abs(normal[d]));
  }
  for (const double n : normal) rounded = rounded || (n != 0 && std::abs(n) * 0x1p300 < largest);
  if (std::isnan(offset) || offset == inf || unbounded) return Side::before;
  if (offset == -inf) return Side::behind;
  if (at_infinity) return Side::hardly_behind;
  ExactSum exact;
  ExactSum relaxed;
  exact.add(offset, 1);
  relaxed.add(offset, 1);
  relaxed.add(std::abs(offset), 1, -45);
  for (int d = 0; d < 3; ++d) {
    exact.add(normal[d], corner[d]);
    relaxed.add(normal[d], corner[d]);
    relaxed.add(std::abs(normal[d]), std::abs(corner[d]), -45);
  }
  if (!exact.is_negative()) return Side::before;
  return rounded || !relaxed.is_negative() ? Side::hardly_behind : Side::behind;
}

template <class S>
S any_number(std::mt19937& random) {
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() >> 8) % n; };
  if (pick(4) == 0) return hard_number<S>(pick(18));
  const int range = std::numeric_limits<S>::max_exponent;
  const int exponent = pick(3) == 0 ? int(pick(2 * unsigned(range))) - range - 20 : int(pick(8)) - 4;
  const S whole = pick(2) == 0 ? S(pick(9)) : S(random());
  return std::ldexp(pick(2) == 0 ? whole : -whole, exponent - (whole > 9 ? 32 : 0));
}

template <class S>
BasicPlane<S> any_plane(std::mt19937& random) {
  BasicPlane<S> plane{};
  for (S& n : plane.normal) n = random() % 4 == 0 ? S(0) : any_number<S>(random);
  plane.offset = any_number<S>(random);
  return plane;
}

template <class S>
BasicAabb<S> any_box(std::mt19937& random) {
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    do {
      box.min[d] = any_number<S>(random);
      box.max[d] = any_number<S>(random);
    } while (std::isnan(box.min[d]) || std::isnan(box.max[d]));
    if (box.max[d] < box.min[d]) std::swap(box.min[d], box.max[d]);
    constexpr S inf = std::numeric_limits<S>::infinity();
    if (random() % 16 == 0) box.min[d] = box.max[d] = random() % 2 == 0 ? inf : -inf;
    if (random() % 16 == 0) box.max[d] = inf;
  }
  return box;
}

template <class S>
struct Case {
  BasicAabb<S> box;
  BasicPlane<S> plane;
};

/// Half of them with a corner of the box on the plane, as exactly as numbers allow.
template <class S>
std::vector<Case<S>> cases(unsigned count) {
  std::mt19937 random(3);
  std::vector<Case<S>> all(count);
  for (auto& [box, plane] : all) {
    box = any_box<S>(random);
    plane = any_plane<S>(random);
    if (random() % 2 == 0) continue;
    S sum = 0;
    for (int d = 0; d < 3; ++d) sum += plane.normal[d] * (plane.normal[d] > 0 ? box.max[d] : box.min[d]);
    plane.offset = random() % 3 == 0 ? std::nextafter(-sum, S(0)) : -sum;
  }
  return all;
}

template <class S>
std::vector<bool> answers(const std::vector<Case<S>>& all) {
  std::vector<bool> behind(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) behind[i] = is_behind(all[i].box, all[i].plane);
  return behind;
}

template <class S>
void check(const std::vector<Case<S>>& all, const std::vector<bool>& behind) {
  unsigned seen[3] = {};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [box, plane] = all[i];
    const Side side = side_of(box, plane);
    ++seen[static_cast<int>(side)];
    if (side == Side::hardly_behind) continue;
    ASSERT_EQ(behind[i], side == Side::behind)
        << "case " << i << ": " << box.min[0] << ' ' << box.min[1] << ' ' << box.min[2] << " to " << box.max[0] << ' '
        << box.max[1] << ' ' << box.max[2] << ", " << plane.normal[0] << ' ' << plane.normal[1] << ' '
        << plane.normal[2] << ' ' << plane.offset;
  }
  for (const unsigned count : seen) EXPECT_GT(count, all.size() / 100);
}

}  // namespace

template <class S>
class Planes : public ::testing::Test {};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Planes, Numbers);

TYPED_TEST(Planes, NoBoxIsLostAndFewAreKept) {
  const auto all = cases<TypeParam>(100000);
  check(all, answers(all));
}

TYPED_TEST(Planes, TheEnvironmentLosesNoBox) {
  const auto all = cases<TypeParam>(30000);
  std::vector<bool> behind;
  for (const int mode : rounding_modes) {
    with_rounding(mode, [&] { behind = answers(all); });
    check(all, behind);
  }
#ifdef BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS
  with_denormals_flushed([&] { behind = answers(all); });
  check(all, behind);
#endif
}

#ifdef BOXSTREAM_TESTS_CAN_TRAP
TYPED_TEST(Planes, NothingTraps) {
  using S = TypeParam;
  const auto all = cases<S>(30000);
  BasicWorld<S> world;
  for (std::size_t i = 0; i < 1000; ++i) world.create(all[i].box);
  world.bounds();  // the index is built before
  std::vector<bool> behind;
  std::size_t found = 0;
  with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW, [&] {
    behind = answers(all);
    for (const auto& each : all)
      world.query_planes(Span<const BasicPlane<S>>(&each.plane, 1), [&](ProxyId) { return ++found % 50 != 0; });
  });
  check(all, behind);
  EXPECT_GT(found, all.size());
}
#endif

/// A World beside the boxes that it was given.
template <class S>
struct Shadowed {
  BasicWorld<S> world;
  std::vector<std::pair<ProxyId, BasicAabb<S>>> boxes;

  void compare(const std::vector<BasicPlane<S>>& planes) const {
    std::vector<std::uint32_t> found, wanted;
    world.query_planes(Span<const BasicPlane<S>>(planes), [&](ProxyId id) {
      found.push_back(id.slot);
      return true;
    });
    for (const auto& [id, box] : boxes) {
      const auto rejects = [&, &b = box](const BasicPlane<S>& plane) { return is_behind(b, plane); };
      if (makes_sense(box) && std::none_of(planes.begin(), planes.end(), rejects)) wanted.push_back(id.slot);
    }
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    ASSERT_EQ(found, wanted);
  }
};

TYPED_TEST(Planes, AWorldFindsWhatNoPlaneHasBehindIt) {
  using S = TypeParam;
  std::mt19937 random(8);
  Shadowed<S> shadowed;
  const auto place = [&] { return S(int(random() % 4001) - 2000) / 16; };
  const auto next_box = [&] {
    if (random() % 10 == 0) return box_from<S>(random());
    const S x = place(), y = place(), z = place();
    return BasicAabb<S>{{x, y, z}, {x + 1, y + S(random() % 3), z + 1}};
  };
  for (int i = 0; i < 3000; ++i) {
    const auto box = next_box();
    shadowed.boxes.emplace_back(shadowed.world.create(box), box);
  }
  for (int round = 0; round < 40; ++round) {
    for (int change = 0; change < 60; ++change) {
      auto& [id, box] = shadowed.boxes[random() % shadowed.boxes.size()];
      box = next_box();
      shadowed.world.move(id, box);
      if (change % 20 == 0) {
        shadowed.world.destroy(id);
        id = shadowed.world.create(box);
      }
    }
    // Past 16 planes they are kept elsewhere, past 64 they are all asked everywhere; most of these reject nothing.
    const unsigned count = round < 20 ? round / 2 : random() % 90;
    std::vector<BasicPlane<S>> planes(count);
    for (auto& plane : planes) {
      plane = random() % 20 == 0 ? any_plane<S>(random) : BasicPlane<S>{{place(), place(), place()}, 0};
      if (random() % 20 != 0) plane.offset = std::abs(place()) * (count < 10 ? 50 : 500);
    }
    shadowed.compare(planes);
  }
}

TYPED_TEST(Planes, TheVisitorStopsTheQuery) {
  BasicWorld<TypeParam> world;
  for (int i = 0; i < 5000; ++i) world.create({{TypeParam(i), 0, 0}, {TypeParam(i + 1), 1, 1}});
  for (const int wanted : {1, 17, 3000}) {
    int visits = 0;
    world.query_planes({}, [&](ProxyId) { return ++visits < wanted; });
    EXPECT_EQ(visits, wanted);
  }
}

}  // namespace boxstream::tests
