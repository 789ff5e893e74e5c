// SPDX-License-Identifier: MIT
// Frame after frame of a few thousand boxes, set in bulk, on every SIMD target: worlds that search in different ways
// against each other and against all pairs looked at one by one.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/oracle.hpp"
#include "sanitized.hpp"
#include "simd_targets.hpp"
#include "values.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

namespace {

using Frames = EachSimdTarget;
INSTANTIATE_TEST_SUITE_P(Targets, Frames, testing::ValuesIn(simd_targets()), simd_target_name);

enum class Motion { nowhere, a_little, some, together, nearly_together, anywhere, three, count };

/// Boxes of sizes over three decades, with a few that are invalid, infinite or larger than all others together: those
/// have more partners than a vector has lanes.
template <class S>
class Crowd {
 public:
  using Box = BasicAabb<S>;

  explicit Crowd(unsigned seed) : random_(seed) {}

  Box box() {
    const unsigned kind = pick(200);
    if (kind < 2) return box_from<S>(random_());
    const double size = kind < 6 ? edge / 2 : 0.01 * std::pow(1000.0, real(0, 1));
    Box made{};
    for (int d = 0; d < 3; ++d) {
      made.min[d] = static_cast<S>(real(-edge / 2, edge / 2));
      made.max[d] = static_cast<S>(static_cast<double>(made.min[d]) + size * real(0.5, 1.5));
    }
    return made;
  }

  void move(Motion motion, std::vector<Box>& boxes) {
    const std::size_t three = pick(static_cast<unsigned>(boxes.size()));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (motion == Motion::anywhere) boxes[i] = box();
      if (motion == Motion::a_little || (motion == Motion::some && i % 20 == 7) ||
          (motion == Motion::three && (i + three) % boxes.size() < 3))
        shift(boxes[i], -0.1, 0.1);
      if (motion == Motion::together)
        for (S* bound : {&boxes[i].min[1], &boxes[i].max[1]}) *bound -= S(0.25);
      if (motion == Motion::nearly_together)
        for (S* bound : {&boxes[i].min[2], &boxes[i].max[2]}) *bound += S(0.3) + S(i % 16) / 1000;
    }
  }

  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }

 private:
  static constexpr double edge = 24;

  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void shift(Box& box, double low, double high) {
    for (int d = 0; d < 3; ++d) {
      const S by = (box.max[d] - box.min[d]) * static_cast<S>(real(low, high));
      if (!std::isfinite(by)) continue;
      box.min[d] += by;
      box.max[d] += by;
    }
  }

  std::mt19937 random_;
};

/// The same history in worlds that search in different ways.
template <class S>
class Worlds {
 public:
  using World = detail::WorldCore<S>;
  using Box = BasicAabb<S>;

  Worlds()
      : worlds_{World({}, detail::SearchMode::probe), World({}, detail::SearchMode::all),
                World({}, detail::SearchMode::candidates), World()} {}

  void create(Crowd<S>& crowd, std::size_t count) {
    std::vector<Box> made(count);
    for (Box& box : made) box = crowd.box();
    std::vector<ProxyId> ids(count);
    for (World& world : worlds_) world.create(made, {}, ids, {});
    ids_.insert(ids_.end(), ids.begin(), ids.end());
    boxes_.insert(boxes_.end(), made.begin(), made.end());
  }

  void destroy(Crowd<S>& crowd, std::size_t count) {
    std::vector<ProxyId> leaving;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = crowd.pick(static_cast<unsigned>(ids_.size()));
      leaving.push_back(ids_[at]);
      ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(at));
      boxes_.erase(boxes_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    for (World& world : worlds_) EXPECT_EQ(world.destroy(Span<const ProxyId>(leaving)), count);
  }

  void move(Crowd<S>& crowd, Motion motion) {
    crowd.move(motion, boxes_);
    for (World& world : worlds_) EXPECT_EQ(world.move(Span<const ProxyId>(ids_), Span<const Box>(boxes_)), ids_.size());
  }

  void update() {
    const std::vector<ProxyPair> before = held_;
    held_ = pairs_one_by_one();
    std::vector<ProxyPair> begun, ended;
    for (World& world : worlds_) {
      world.update();
      ASSERT_NO_THROW(world.validate());
      std::vector<ProxyPair> streamed;
      world.stream_pairs([&](Span<const ProxyPair> pairs) {
        streamed.insert(streamed.end(), pairs.begin(), pairs.end());
        return true;
      });
      ASSERT_TRUE(equal(streamed, held_)) << streamed.size() << " pairs for " << held_.size();
      if (&world == worlds_) {
        begun.assign(world.begun().begin(), world.begun().end());
        ended.assign(world.ended().begin(), world.ended().end());
        EXPECT_EQ(held_.size(), before.size() + begun.size() - ended.size());
      }
      ASSERT_TRUE(equal(begun, world.begun()));
      ASSERT_TRUE(equal(ended, world.ended()));
    }
  }

  std::size_t pairs() const { return held_.size(); }

 private:
  static bool equal(Span<const ProxyPair> x, Span<const ProxyPair> y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const ProxyPair& p, const ProxyPair& q) { return p.a == q.a && p.b == q.b; });
  }

  std::vector<ProxyPair> pairs_one_by_one() const {
    std::vector<ProxyPair> pairs;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!makes_sense(boxes_[i])) continue;
      for (std::size_t j = i + 1; j < boxes_.size(); ++j)
        if (touch(boxes_[i], boxes_[j]) && makes_sense(boxes_[j])) pairs.push_back({ids_[i], ids_[j]});
    }
    return pairs;
  }

  World worlds_[4];
  std::vector<ProxyId> ids_;  // in order of creation
  std::vector<Box> boxes_;
  std::vector<ProxyPair> held_;
};

template <class S>
void frames_agree(unsigned seed) {
  Crowd<S> crowd(seed);
  Worlds<S> worlds;
  worlds.create(crowd, 1500);
  worlds.update();
  const std::size_t pairs = worlds.pairs();
  EXPECT_GT(pairs, 2000u);
  Motion motion = Motion::nowhere;
  for (unsigned frame = 0; frame < (sanitized ? 12 : 40); ++frame) {
    SCOPED_TRACE(frame);
    if (frame % 5 == 2) worlds.destroy(crowd, 1 + frame * 3);
    if (frame % 5 == 4) worlds.create(crowd, 1 + frame * 3);
    if (crowd.pick(3) != 0) motion = Motion(crowd.pick(unsigned(Motion::count)));  // else as in the last one
    worlds.move(crowd, motion);
    worlds.update();
    if (::testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace

TEST_P(Frames, FloatWorldsAgree) {
  frames_agree<float>(1);
}

TEST_P(Frames, DoubleWorldsAgree) {
  frames_agree<double>(2);
}

namespace {

/// Boxes that tremble until it pays to keep candidates; then, between times of that, a few that go somewhere else,
/// come, leave and change their filters, which other searches deal with.
template <class S>
void candidates_outlive_other_searches(bool sticky) {
  WorldOptions options;
  options.sticky_filters = sticky;
  detail::WorldCore<S> worlds[] = {detail::WorldCore<S>(options),
                                   detail::WorldCore<S>(options, detail::SearchMode::all)};
  std::mt19937 random(5);
  const auto real = [&](double low, double high) {
    return static_cast<S>(std::uniform_real_distribution<double>(low, high)(random));
  };
  const auto somewhere = [&] {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = real(0, 9);
      box.max[d] = box.min[d] + 1;
    }
    return box;
  };
  std::vector<BasicAabb<S>> homes(1000), boxes(1000);
  for (auto& home : homes) home = somewhere();
  std::vector<ProxyId> ids(homes.size());
  for (auto& world : worlds) world.create(homes, {}, ids, {});

  for (int frame = 0; frame < 400; ++frame) {
    SCOPED_TRACE(frame);
    const bool quiet = frame > 100 && frame % 10 < 5;
    const auto tremble = [&](std::size_t i) {
      for (int d = 0; d < 3; ++d) {
        const S by = real(-0.002, 0.002);
        boxes[i].min[d] = homes[i].min[d] + by;
        boxes[i].max[d] = homes[i].max[d] + by;
      }
    };
    if (!quiet)
      for (std::size_t i = 0; i < homes.size(); ++i) tremble(i);
    for (int change = 0; quiet && change < 8; ++change) {
      const std::size_t i = random() % 40 * 25;
      homes[i] = somewhere();
      tremble(i);
      if (random() % 8 == 0) boxes[i].min[1] = std::numeric_limits<S>::quiet_NaN();
      const std::size_t j = random() % 40 * 25;
      const Filter filter{1u << random() % 2, random() % 3 == 0 ? 1u : ~0u};
      const std::size_t k = random() % 40 * 25;
      for (auto& world : worlds) {
        EXPECT_TRUE(world.set_filter(ids[j], filter));
        EXPECT_TRUE(world.destroy(ids[k]));
      }
      for (auto& world : worlds) ids[k] = world.create(boxes[k]);
    }
    std::vector<ProxyPair> begun, ended;
    for (auto& world : worlds) {
      world.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes));
      world.update();
      if (frame % 20 == 5) {
        ASSERT_NO_THROW(world.validate());
      }
      if (&world == worlds) {
        begun.assign(world.begun().begin(), world.begun().end());
        ended.assign(world.ended().begin(), world.ended().end());
      }
    }
    const auto same = [](Span<const ProxyPair> x, Span<const ProxyPair> y) {
      return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                        [](const ProxyPair& p, const ProxyPair& q) { return p.a == q.a && p.b == q.b; });
    };
    ASSERT_TRUE(same(begun, worlds[1].begun()));
    ASSERT_TRUE(same(ended, worlds[1].ended()));
  }
}

}  // namespace

TEST(Candidates, OutliveOtherSearches) {
  candidates_outlive_other_searches<float>(false);
  candidates_outlive_other_searches<double>(false);
}

TEST(Candidates, OutliveOtherSearchesWithStickyFilters) {
  candidates_outlive_other_searches<float>(true);
  candidates_outlive_other_searches<double>(true);
}

}  // namespace boxstream::tests
