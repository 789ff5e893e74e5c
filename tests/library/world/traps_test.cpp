// SPDX-License-Identifier: MIT
// Hosts that trap: every call of a World with every special value at every place. A trap kills the process.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "float_environment.hpp"
#include "watched_world.hpp"
#include "world/core.hpp"

#if defined(BOXSTREAM_TESTS_CAN_TRAP)

namespace boxstream::tests {
namespace {

template <class S>
const std::vector<S>& special_values() {
  using Limits = std::numeric_limits<S>;
  static const std::vector<S> all = {0,
                                     -S(0),
                                     Limits::denorm_min(),
                                     -Limits::denorm_min(),
                                     Limits::min(),
                                     -Limits::min(),
                                     S(1e18),
                                     S(-1e30),
                                     Limits::max() / 2,
                                     Limits::max(),
                                     -Limits::max(),
                                     Limits::infinity(),
                                     -Limits::infinity(),
                                     Limits::quiet_NaN(),
                                     Limits::signaling_NaN()};
  return all;
}

/// Boxes in a row that touch, a few of them with special values. Made before traps are set.
template <class S>
std::vector<BasicAabb<S>> boxes_in_a_row(unsigned count) {
  std::vector<BasicAabb<S>> boxes;
  for (unsigned i = 0; i < count; ++i) {
    boxes.push_back({{S(i), S(i % 7), S(i % 11)}, {S(i + 1), S(i % 7 + 1), S(i % 11 + 2)}});
    if (i % 5 == 4) (i % 2 == 0 ? boxes[i].min : boxes[i].max)[i % 3] = special_values<S>()[i % 15];
  }
  return boxes;
}

template <class S>
struct Calls {
  using World = detail::WorldCore<S>;
  static constexpr S inf = std::numeric_limits<S>::infinity();

  World& world;
  World& other;
  S special;  // what visitors answer now and then
  unsigned visits = 0;

  S answer(S usual) { return ++visits % 5 == 0 ? special : usual; }

  void query(const BasicAabb<S>& box, S limit) {
    world.query_box(box, [](ProxyId) { return true; });
    ProxyId near[9];
    world.query_nearest(box.min, near);
    world.query_nearest(box.max, near);
    world.query_nearest_box(box, limit, [&](ProxyId, S) { return answer(++visits < 500 ? inf : S(0)); });
    world.bounds();
  }
  void ray(const BasicRay<S>& ray) {
    world.query_ray(ray, [&](ProxyId, S enter, S length) { return answer(visits % 2 == 0 ? length : enter); });
  }
  void pairs(S limit) {
    visits = 0;
    world.nearest_pairs(world, limit, [&](ProxyPair, S) { return answer(visits < 500 ? inf : S(0)); });
    visits = 0;
    world.nearest_pairs(other, limit, [&](ProxyPair, S) { return answer(visits < 500 ? inf : S(0)); });
  }
  void update() {
    world.update();
    other.update([](ProxyId, ProxyId) { return true; });
  }
};

/// What was seen, in one number.
template <class S>
std::uint64_t call_all(detail::SearchMode mode, unsigned count, const std::vector<BasicAabb<S>>& boxes) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  std::uint64_t seen = 0;
  for (const S& special : special_values<S>()) {
    detail::WorldCore<S> world({}, mode), other({}, mode);
    Calls<S> calls{world, other, special};
    std::vector<ProxyId> ids(count), others(3);
    world.create(Span<const BasicAabb<S>>(boxes), {}, Span<ProxyId>(ids), {});
    other.create(Span<const BasicAabb<S>>(boxes.data(), 3), {}, Span<ProxyId>(others), {});
    calls.update();
    for (unsigned place = 0; place < 6; ++place) {
      BasicAabb<S> box{{1, 1, 1}, {2, 2, 2}};
      (place < 3 ? box.min : box.max)[place % 3] = special;
      BasicAabb<S> thin{{special, special, special}, {special, special, special}};
      const unsigned at = (place * 37) % count;
      for (const BasicAabb<S>& to : {box, boxes[at], thin, box}) {  // away, back, and again
        world.move(ids[at], to);
        world.move(Span<const ProxyId>(ids.data(), 3), Span<const BasicAabb<S>>(&boxes[0], 3));
        other.move(others[0], to);
        calls.update();
        world.begin_pairs_of(
            ids[at], [](ProxyId, ProxyId) { return true; }, [](ProxyPair) {});
      }
      calls.query(box, inf);
      calls.query(box, special);
    }
    for (unsigned field = 0; field < 13; ++field) {
      BasicRay<S> ray{{0, 1, 1}, {1, inf, S(0.25)}, 9};
      S* const fields[] = {&ray.origin[0],
                           &ray.origin[1],
                           &ray.origin[2],
                           &ray.inverse_direction[0],
                           &ray.inverse_direction[1],
                           &ray.inverse_direction[2],
                           &ray.length,
                           &ray.extent_min[0],
                           &ray.extent_min[1],
                           &ray.extent_min[2],
                           &ray.extent_max[0],
                           &ray.extent_max[1],
                           &ray.extent_max[2]};
      *fields[field] = special;
      calls.ray(ray);
    }
    calls.pairs(inf);
    calls.pairs(special);
    world.validate();
    seen = 31 * seen + 7 * world.pair_count() + calls.visits;
    world.destroy(Span<const ProxyId>(ids.data(), count / 2));
    calls.update();
    world.clear();
  }
  return seen;
}

template <class S>
class Traps : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Traps, Scalars);

TYPED_TEST(Traps, NoCallHasAnyForSpecialValues) {
  for (const unsigned count : {3u, 20u, 90u, 700u}) {
    const auto boxes = boxes_in_a_row<TypeParam>(count);
    for (const auto mode : search_modes) {
      const auto expected = call_all<TypeParam>(mode, count, boxes);
      std::uint64_t seen = 0;
      with_traps(FE_ALL_EXCEPT, [&] { seen = call_all<TypeParam>(mode, count, boxes); });
      EXPECT_EQ(seen, expected) << count << " boxes, mode " << int(mode);
    }
  }
}

/// Nor does a call leave a flag behind, for hosts that look at them now and then.
TYPED_TEST(Traps, NoCallRaisesAFlag) {
  const auto boxes = boxes_in_a_row<TypeParam>(90);
  for (const auto mode : search_modes) {
    std::feclearexcept(FE_ALL_EXCEPT);
    call_all<TypeParam>(mode, 90, boxes);
    EXPECT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
  }
}

/// Few move, and have infinite boxes or the largest ones; half-spaces that move a second time.
TYPED_TEST(Traps, HalfSpacesThatMove) {
  using S = TypeParam;
  constexpr S inf = std::numeric_limits<S>::infinity(), most = std::numeric_limits<S>::max();
  for (const S far : {inf, most}) {
    BasicWorld<S> world;
    with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, [&] {
      std::vector<ProxyId> ids;
      for (unsigned i = 0; i < 2000; ++i) ids.push_back(world.create({{S(i), 0, 0}, {S(i) + 1, 1, 1}}));
      world.update();
      for (unsigned frame = 1; frame < 20; ++frame) {
        for (unsigned i = 0; i < 8; ++i) world.move(ids[i * 200], {{-far, -far, -far}, {far, S(frame), far}});
        world.update();
      }
    });
    // Of the row 1992 are left, which touch the next one if it is not one of the eight; these touch all.
    EXPECT_EQ(world.pair_count(), 1984u + 8 * 1992 + 28);
  }
}

}  // namespace
}  // namespace boxstream::tests

#endif
