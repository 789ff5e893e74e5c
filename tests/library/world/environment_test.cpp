// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: what an update finds, and how, does not depend on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "float_environment.hpp"
#include "moody_world.hpp"
#include "player.hpp"
#include "values.hpp"
#include "watched_world.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

namespace {

constexpr std::size_t proxies = 300;
constexpr unsigned frames = 12;

/// Hard numbers, invalid boxes included, for each frame. Made in the default environment.
template <class S>
std::vector<std::vector<BasicAabb<S>>> boxes_of_frames() {
  constexpr S tiny = std::numeric_limits<S>::denorm_min();
  std::mt19937 random(9);
  std::vector<BasicAabb<S>> boxes(proxies);
  std::vector<std::vector<BasicAabb<S>>> all;
  for (unsigned frame = 0; frame < frames; ++frame) {
    for (auto& box : boxes) {
      if (frame != 0 && random() % 4 != 0) continue;
      box = box_from<S>(random(), 8);
      // Denormal numbers next to each other, so that it matters whether they are distinguished.
      if (random() % 3 == 0)
        for (int d = 0; d < 3; ++d) {
          box.min[d] = tiny * static_cast<S>(random() % 5);
          box.max[d] = box.min[d] + tiny * static_cast<S>(random() % 2);
        }
    }
    all.push_back(boxes);
  }
  return all;
}

/// Everything that a World says of these frames.
template <class S>
std::vector<std::uint32_t> history(const std::vector<std::vector<BasicAabb<S>>>& all, detail::SearchMode mode) {
  std::vector<std::uint32_t> log;
  detail::WorldCore<S> world({}, mode);
  std::vector<ProxyId> ids(proxies);
  world.create(all[0], {}, ids, {});
  for (const auto& boxes : all) {
    world.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes));
    const WorldStats stats = world.update();
    log.push_back(static_cast<std::uint32_t>(stats.invalid));
    log.push_back(static_cast<std::uint32_t>(stats.moved));
    world.for_each_pair([&](ProxyPair pair) {
      log.insert(log.end(), {pair.a.slot, pair.b.slot});
      return true;
    });
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < proxies; i += 10)
      world.query_box(boxes[i], [&](ProxyId id) {
        found.push_back(id.slot);
        return true;
      });
    std::sort(found.begin(), found.end());
    log.insert(log.end(), found.begin(), found.end());
    for (std::size_t i = 1; i < proxies; ++i) log.push_back(world.release(ids[0], ids[i]));
    world.begin_pairs_of(
        ids[0], [](ProxyId, ProxyId) { return true; }, [&](ProxyPair pair) { log.push_back(pair.b.slot); });
  }
  return log;
}

/// `environment(work)` runs nothing but a history.
template <class S>
void expect_same_within(const std::function<void(const std::function<void()>&)>& environment) {
  const auto boxes = boxes_of_frames<S>();
  const auto expected = history(boxes, detail::SearchMode::all);
  for (const auto mode : search_modes) {
    std::vector<std::uint32_t> found;
    environment([&] { found = history(boxes, mode); });
    EXPECT_TRUE(found == expected) << "mode " << int(mode);
  }
}

template <class S>
class Environment : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Environment, Scalars);

}  // namespace

/// Boxes at denormal coordinates for the most part: many levels of an index whose bounds all flush to zero.
template <class S>
BasicAabb<S> mostly_denormal(unsigned value) {
  if (value % 4 == 0) return box_from<S>(value, 8);
  constexpr S tiny = std::numeric_limits<S>::denorm_min();
  std::minstd_rand random(value + 1);
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    const int least = static_cast<int>(random() % 40) - 20;
    box.min[d] = tiny * static_cast<S>(least);
    box.max[d] = tiny * static_cast<S>(least + static_cast<int>(random() % 6));
  }
  return box;
}

/// Each call in an environment of its own, whole histories through: all that can be seen is what the model says.
TYPED_TEST(Environment, SwitchedFromCallToCallAndThreadToThread) {
  using S = TypeParam;
  constexpr Kind kinds[] = {Kind::create_many, Kind::bulk_create,  Kind::move,   Kind::move_many, Kind::bulk_move,
                            Kind::move_all,    Kind::destroy_many, Kind::update, Kind::update,    Kind::update_refusing,
                            Kind::release,     Kind::begin_pairs,  Kind::query,  Kind::query,     Kind::query};
  for (const auto mode : search_modes)
    for (unsigned seed = 1; seed <= 12; ++seed) {
      std::mt19937 random(seed);
      MoodyWorld<S> world({}, mode, seed);
      Player<S, MoodyWorld<S>> player(world, false, mostly_denormal<S>);
      for (int i = 0; i < 40; ++i) {
        Op op{kinds[random() % std::size(kinds)], static_cast<unsigned>(random() % 100000),
              static_cast<unsigned>(random() % 100000)};
        if (player.size() > 250 && (op.kind == Kind::create_many || op.kind == Kind::bulk_create))
          op.kind = Kind::update;
        player.play(op);
        ASSERT_FALSE(this->HasFailure()) << "mode " << int(mode) << ", seed " << seed << ", operation " << i << ' '
                                         << op;
      }
    }
}

/// Distances too, and visitors find the environment of their caller.
TYPED_TEST(Environment, DistancesAreTheSameInAll) {
  using S = TypeParam;
  constexpr S inf = std::numeric_limits<S>::infinity();
  std::mt19937 random(3);
  MoodyWorld<S> moody({}, detail::SearchMode::cheapest, 1);
  detail::WorldCore<S> plain;
  for (unsigned i = 0; i < 300; ++i) {
    const auto box = mostly_denormal<S>(random() % 100000);
    moody.create(box);
    plain.create(box);
  }
  using Seen = std::vector<std::pair<std::uint32_t, S>>;
  for (unsigned i = 0; i < 40; ++i) {
    const auto box = mostly_denormal<S>(random() % 100000);
    const S limits[] = {inf, std::numeric_limits<S>::max(), 3, std::numeric_limits<S>::quiet_NaN()};
    Seen seen, expected, pairs, expected_pairs;
    const auto into = [&](Seen& all) {
      return [&all](ProxyId id, S distance) {
        all.push_back({id.slot, distance});
        return inf;
      };
    };
    moody.query_nearest_box(box, limits[i % 4], into(seen));
    plain.query_nearest_box(box, limits[i % 4], into(expected));
    EXPECT_TRUE(seen == expected) << i;
    const auto pairs_into = [&](Seen& all) {
      return [&all](ProxyPair pair, S distance) {
        all.push_back({pair.a.slot * 1000 + pair.b.slot, distance});
        return all.size() < 3000 ? inf : S(0);
      };
    };
    moody.nearest_pairs(moody, limits[i % 4], pairs_into(pairs));
    plain.nearest_pairs(plain, limits[i % 4], pairs_into(expected_pairs));
    EXPECT_TRUE(pairs == expected_pairs) << i;
  }
}

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : rounding_modes)
    expect_same_within<TypeParam>([=](const auto& work) { with_rounding(mode, work); });
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  expect_same_within<TypeParam>(with_denormals_flushed);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  expect_same_within<TypeParam>([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); });
}
#endif

}  // namespace boxstream::tests
