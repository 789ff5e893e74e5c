// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: what an update finds, and how, does not depend on it.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "float_environment.hpp"
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
      // Denormal numbers next to each other, so that it matters whether they are told apart.
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
