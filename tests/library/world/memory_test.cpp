// SPDX-License-Identifier: MIT
// Every allocation of this program is counted and can be made to fail.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <boxstream/world.hpp>

#include "flaky_world.hpp"
#include "heap_watch.hpp"
#include "player.hpp"
#include "sanitized.hpp"
#include "watched_world.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

namespace {

Aabb cube(float x, float y) {
  return {{x, y, 0}, {x + 1, y + 1, 1}};
}

/// Neighbours in a grid have numbers that are near each other, so that groups of boxes are compact and have something
/// to lose. Some numbers are boxes of another kind.
template <class S>
BasicAabb<S> box_in_grid(unsigned value, unsigned side) {
  if (value % 41 == 0) return box_from<S>(value);
  const S x = S(value % side), y = S(value / side % side), shift = S(value % 3) / 4;
  return {{x + shift, y, shift}, {x + shift + 1, y + S(1.25), 1}};
}

/// What happens to a World from its birth on: enough proxies for an index of several levels, then calls of all kinds.
std::vector<Op> history(unsigned seed) {
  constexpr Kind kinds[] = {Kind::create,   Kind::destroy,     Kind::destroy_many, Kind::destroy_many,
                            Kind::move_all, Kind::bulk_create, Kind::bulk_move,    Kind::filter,
                            Kind::release,  Kind::release,     Kind::begin_pairs,  Kind::distances,
                            Kind::query,    Kind::clear,       Kind::shrink_to_fit};
  std::minstd_rand random(seed + 1);
  const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() >> 8) % n; };
  std::vector<Op> ops = {{Kind::create_many, 20 + pick(20), pick(100000)}, {Kind::bulk_create, 30, pick(100000)}};
  for (int i = 0; i < 9; ++i) {
    ops.push_back({Kind::nudge_few, pick(100000), pick(100000)});
    if (pick(3) != 0) ops.push_back({i % 2 == 0 ? Kind::update : Kind::update_refusing, pick(100000), pick(100000)});
    const Kind kind = kinds[pick(std::size(kinds))];
    ops.push_back({kind, kind == Kind::bulk_create ? 20 + pick(30) : pick(100000), pick(100000)});
    if (kind == Kind::clear || kind == Kind::destroy_many)
      ops.push_back({Kind::bulk_create, 50 + pick(30), pick(100000)});
  }
  return ops;
}

/// Plays a history with failures. After each one, and at the end, everything is compared with the model. Returns how
/// many allocations there were to fail.
template <class S>
std::int64_t play(unsigned seed, detail::SearchMode mode, std::int64_t first, std::int64_t second, Then then) {
  const bool sticky = seed % 2 == 1;
  WorldOptions options;
  options.sticky_filters = sticky;
  FlakyWorld<S> world(options, mode, then);
  const unsigned side = seed % 2 == 0 ? 16 : 5;  // the smaller one has more pairs than there is room for at first
  Player<S, FlakyWorld<S>> player(world, sticky, [side](unsigned value) { return box_in_grid<S>(value, side); });
  world.look = [&] { player.compare_all(seed); };
  heap_watch::fail_at(first, second);
  {
    const heap_watch::Failures wait(false);
    std::size_t failures = 0;
    for (const Op& op : history(seed)) {
      if (::testing::Test::HasFailure()) break;
      std::ostringstream what;
      what << op;
      SCOPED_TRACE("operation " + what.str());
      try {
        player.play(op);
        if (world.failures() != failures) player.compare_all(op.value);
        failures = world.failures();
      } catch (const std::bad_alloc&) {
        EXPECT_EQ(then, Then::give_up);
      }
    }
  }
  heap_watch::stop_failing();
  player.compare_all(seed + 1);
  return heap_watch::tried();
}

class FailingMemory : public ::testing::TestWithParam<detail::SearchMode> {
 protected:
  template <class S>
  void fail_all(unsigned seed) {
    const detail::SearchMode mode = GetParam();
    const std::int64_t allocations = play<S>(seed, mode, heap_watch::never, heap_watch::never, Then::again);
    EXPECT_GT(allocations, 50) << "hardly anything was put to the test";
    for (std::int64_t first = 0; first < allocations && !HasFailure(); ++first)
      for (const Then then : {Then::again, Then::look_and_again, Then::give_up}) {
        // Of calls that are made again, the next allocation or one of those after it.
        const std::int64_t second = then == Then::look_and_again ? heap_watch::never : first * 7 % 11;
        SCOPED_TRACE("seed " + std::to_string(seed) + ", allocation " + std::to_string(first) + ", then " +
                     std::to_string(second) + ", way " + std::to_string(int(then)));
        play<S>(seed, mode, first, second, then);
        if (HasFailure()) return;
      }
  }
};

TEST_P(FailingMemory, FloatWorldAgreesWithTheModel) {
  for (unsigned seed = 0; seed < (sanitized ? 1 : 2); ++seed) fail_all<float>(seed);
}
TEST_P(FailingMemory, DoubleWorldAgreesWithTheModel) {
  fail_all<double>(2);
}

std::string mode_name(const ::testing::TestParamInfo<detail::SearchMode>& test) {
  const char* const modes[] = {"None", "Probe", "All", "Candidates", "Cheapest", "Beside"};
  return modes[int(test.param)];
}

INSTANTIATE_TEST_SUITE_P(World, FailingMemory,
                         ::testing::Values(detail::SearchMode::probe, detail::SearchMode::all,
                                           detail::SearchMode::candidates, detail::SearchMode::cheapest,
                                           detail::SearchMode::beside),
                         mode_name);

/// However they are searched for, the first time and when one half or all of their boxes have moved.
TEST(Memory, PairsThatAreRefusedTakeNone) {
  constexpr std::uint64_t boxes = 1700;  // their scratch is less than a byte for each pair
  for (const auto mode : search_modes) {
    SCOPED_TRACE("mode " + std::to_string(int(mode)));
    detail::WorldCore<float> world(WorldOptions{}, mode);
    std::vector<ProxyId> ids;
    for (std::uint64_t i = 0; i < boxes; ++i) ids.push_back(world.create(cube(float(i) / boxes, 0)));
    std::uint64_t asked = 0;
    const auto accept = [&](ProxyId a, ProxyId b) {
      ++asked;
      return b.slot == a.slot + 700;
    };
    for (int frame = 0; frame < 4; ++frame) {
      for (std::uint64_t i = 0; frame > 0 && i < (frame == 2 ? boxes : boxes / 2); ++i)
        world.move(ids[i], cube(float(i) / boxes, float(frame) / 10));
      heap_watch::reset_peak();
      const std::int64_t before = heap_watch::live_bytes();
      asked = 0;
      world.update(accept);
      EXPECT_EQ(world.pair_count(), boxes - 700);
      const std::uint64_t pairs = boxes * (boxes - 1) / 2, at_rest = boxes / 2 * (boxes / 2 - 1) / 2;
      const bool some_rest = frame % 2 != 0;
      EXPECT_GT(asked, (some_rest ? pairs - at_rest : pairs) - boxes);
      EXPECT_LT(heap_watch::peak_bytes() - before, std::int64_t(pairs)) << "less than a byte for each";
    }
    world.validate();
  }
}

/// Many pairs begin at once and end at once, and then nothing happens or little.
TEST(Memory, OfPairsGoesBackOnceTheyAreGone) {
  for (const bool some_move : {false, true}) {
    World world;
    std::vector<ProxyId> ids;
    for (int i = 0; i < 600; ++i) ids.push_back(world.create(cube(float(i) / 600, 0)));
    const std::int64_t before = heap_watch::live_bytes();
    EXPECT_EQ(world.update().pairs, 600u * 599 / 2);
    const std::int64_t with_pairs = heap_watch::live_bytes() - before;
    for (int i = 0; i < 600; ++i) world.move(ids[std::size_t(i)], cube(float(3 * i), 0));
    EXPECT_EQ(world.update().pairs, 0u);
    for (int frame = 0; frame < 10; ++frame) {
      if (some_move) world.move(ids[0], cube(-2, float(frame)));
      world.update();
    }
    EXPECT_LT(5 * (heap_watch::live_bytes() - before), with_pairs);
    world.validate();
    for (int i = 0; i < 600; ++i) world.move(ids[std::size_t(i)], cube(float(i) / 600, 0));
    EXPECT_EQ(world.update().pairs, 600u * 599 / 2);
    world.validate();
  }
}

/// The same where callers say which.
TEST(Memory, OfPairsThatAreToldGoesBack) {
  for (const bool searches_then : {false, true}) {
    World world;
    std::vector<ProxyId> ids;
    for (int i = 0; i < 500; ++i) ids.push_back(world.create(cube(float(2 * i), 0)));
    world.update();
    const std::int64_t before = heap_watch::live_bytes();
    const auto accept = [](ProxyId, ProxyId) { return true; };
    {
      std::vector<ProxyPair> all;
      for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) all.push_back({ids[j], ids[i]});
      EXPECT_EQ(world.update_told(all, {}, accept).begun, all.size());
      EXPECT_EQ(world.update_told({}, all, accept).ended, all.size());
    }
    const std::int64_t most = heap_watch::live_bytes() - before;
    for (int frame = 0; frame < 10; ++frame) {
      const ProxyPair one{ids[3], ids[std::size_t(4 + frame)]};
      searches_then ? world.update() : world.update_told(Span<const ProxyPair>(&one, 1), {}, accept);
    }
    EXPECT_LT(5 * (heap_watch::live_bytes() - before), most);
  }
}

/// A grid in which each box touches `reach` others to the right of it.
template <class S>
BasicAabb<S> box_of_row(int i, int reach, int frame) {
  const S x = S(i % 100) + S(frame % 2) / 8, y = S(2 * (i / 100));
  return {{x, y, 0}, {x + S(reach) + S(0.5), y + 1, 1}};
}

/// Bytes of a box and of a pair, as the header states them: after `shrink_to_fit`, and at most while boxes move.
template <class S>
void takes_what_the_header_says(detail::SearchMode mode) {
  constexpr double bytes_of_box = sizeof(S) == 4 ? 74 : 98, bytes_of_pair = 8.1;
  constexpr double used_of_box = sizeof(S) == 4 ? 450 : 660, used_of_pair = 66;
  constexpr int boxes = 20000;
  for (const int reach : {0, 1, 6}) {
    SCOPED_TRACE("mode " + std::to_string(int(mode)) + ", reach " + std::to_string(reach));
    std::vector<ProxyId> ids(boxes);
    const std::int64_t none = heap_watch::live_bytes();
    const auto bytes = [&] { return double(heap_watch::live_bytes() - none); };
    detail::WorldCore<S> world({}, mode);
    for (int i = 0; i < boxes; ++i) ids[std::size_t(i)] = world.create(box_of_row<S>(i, reach, 0));
    for (int frame = 0; frame < 20; ++frame) {
      for (int i = 0; i < boxes; i += 1 + frame % 3 * 50)
        world.move(ids[std::size_t(i)], box_of_row<S>(i, reach, frame));
      world.update();
      world.query_box({{1, 1, 0}, {2, 2, 1}}, [](ProxyId) { return true; });
    }
    const auto pairs = double(world.pair_count());
    const double in_use = bytes();
    world.shrink_to_fit();
    const bool is_usual = mode != detail::SearchMode::beside;  // which is for few that move
    EXPECT_LT(in_use, (is_usual ? used_of_box : 1000) * boxes + used_of_pair * pairs);
    EXPECT_LT(bytes(), bytes_of_box * boxes + bytes_of_pair * pairs + 8192);
    world.validate();
    EXPECT_EQ(double(world.pair_count()), pairs);
    world.move(ids[0], box_of_row<S>(0, reach, 5));
    world.update();
    world.validate();
    world.destroy(ids);
    for (int update = 0; update < 2; ++update) world.update();  // the first has the events
    world.shrink_to_fit();
    EXPECT_LT(bytes(), 12 * boxes + 8192) << "of ids, which do not come again";
  }
}

TEST(Memory, OfBoxesAndPairs) {
  for (const auto mode : search_modes) {
    takes_what_the_header_says<float>(mode);
    takes_what_the_header_says<double>(mode);
  }
}

// Ranks mean other proxies after the proxies of an update that failed are gone.
TEST(Memory, AnUpdateThatFailsAndIsGivenUpLeavesNothingBehind) {
  for (const auto mode : search_modes) {
    int failed = 0;
    for (std::int64_t first = 0; first < 12; ++first) {
      SCOPED_TRACE("mode " + std::to_string(int(mode)) + ", allocation " + std::to_string(first));
      WatchedWorld<float> watched(mode);
      std::vector<Aabb> boxes;
      for (int i = 0; i < 100; ++i) boxes.push_back(cube(float(3 * i), 9));
      boxes.insert(boxes.end(), 60, cube(0, 0));
      for (int i = 0; i < 60; ++i) boxes.push_back(cube(float(i), 5));
      for (int i = 0; boxes.size() <= detail::thresholds.few_proxies + 100; ++i) boxes.push_back(cube(float(i), 40));
      watched.create(boxes);
      watched.update();
      for (std::uint32_t i = 60; i < 100; ++i) watched.move(i, cube(float(3 * i), 8));
      heap_watch::fail_at(first);
      try {
        watched.world().update();
      } catch (const std::bad_alloc&) {
      }
      failed += heap_watch::stop_failing() ? 1 : 0;
      for (std::uint32_t i = 0; i < 100; ++i) watched.destroy(i);
      for (int i = 0; i < 40; ++i) watched.create({cube(float(2 * i), 20)});  // more than are looked up one by one
      watched.update();
      if (HasFailure()) return;
    }
    EXPECT_GT(failed, 0) << "mode " << int(mode);
  }
}

TEST(Memory, FewThatShrinkMayFail) {
  for (const std::size_t count : {2u, 5u, 16u, 17u, 40u}) {
    int failed = 0;
    for (std::int64_t first = 0; first < 12; ++first) {
      SCOPED_TRACE(std::to_string(count) + " boxes, allocation " + std::to_string(first));
      World world;
      std::vector<ProxyId> ids;
      for (std::size_t i = 0; i < count; ++i) ids.push_back(world.create(cube(float(i) / 2, 0)));
      world.update();
      world.destroy(ids[0]);
      if (count > 16) world.update();
      heap_watch::fail_at(first);
      try {
        world.shrink_to_fit();
      } catch (const std::bad_alloc&) {
      }
      failed += heap_watch::stop_failing() ? 1 : 0;
      ASSERT_NO_THROW(world.validate());
      world.update();
      ASSERT_NO_THROW(world.validate());
      ASSERT_EQ(world.pair_count(), count == 2 ? 0 : 2 * count - 5);
    }
    EXPECT_GT(failed, 0) << count << " boxes";
  }
}

void allocates_nothing_in_steady_state(detail::SearchMode mode, int warm_up) {
  detail::WorldCore<float> world({}, mode);
  std::vector<ProxyId> ids;
  for (int i = 0; i < 3000; ++i) ids.push_back(world.create(cube(float(i % 60) * 0.9f, float(i / 60) * 0.9f)));
  const auto frame = [&](int number, std::size_t stride) {
    for (std::size_t i = 0; i < ids.size(); i += stride) {
      const auto column = static_cast<int>(i) % 60;
      const auto row = static_cast<int>(i) / 60;
      world.move(ids[i], cube(float(column) * 0.9f + float(number % 2) * 0.2f, float(row) * 0.9f));
    }
    world.update();
    std::size_t found = 0;
    world.query_box(cube(5, 5), [&](ProxyId) { return ++found > 0; });
    ProxyId near[8];
    found += world.query_nearest({1, 2, 3}, near);
    const ProxyId last = ids.back();
    world.destroy(last);
    ids.back() = world.create(cube(1, 1));
    EXPECT_GT(found, 8u);
  };
  for (const std::size_t stride : {std::size_t{1}, std::size_t{7}, std::size_t{500}}) {
    for (int i = 0; i < warm_up; ++i) frame(i, stride);
    const std::uint64_t before = heap_watch::allocations();
    for (int i = 0; i < warm_up; ++i) frame(i, stride);
    EXPECT_EQ(heap_watch::allocations(), before) << "every " << stride << "th box moving";
  }
}

TEST(Memory, SteadyStateAllocatesNothing) {
  allocates_nothing_in_steady_state(detail::SearchMode::cheapest, 80);
}

// Candidates count tombstones as well, which pile up for 750 of these frames before they are dropped.
TEST(Memory, SteadyStateWithCandidatesAllocatesNothing) {
  if (tests::sanitized) GTEST_SKIP() << "takes a minute, and counts the same without";
  allocates_nothing_in_steady_state(detail::SearchMode::candidates, 1600);
}

// More pairs than 32 bits count begin at once: the limit is met in memory for the boxes, and nothing has changed.
TEST(Memory, MorePairsThanTheLimitTakeNoMemory) {
  constexpr std::size_t boxes = 65537, limit = 100000;
  for (const auto mode : {detail::SearchMode::all, detail::SearchMode::probe, detail::SearchMode::candidates}) {
    detail::WorldCore<float> world({}, mode);
    std::vector<ProxyId> ids(boxes);
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    world.create(std::vector<Aabb>(boxes, cube(0, 0)), {}, ids, {});
    world.set_max_begun(limit);
    for (int again = 0; again < 2; ++again) {
      EXPECT_THROW(world.update(), std::length_error);
      EXPECT_EQ(world.pair_count(), 0u);
    }
    ASSERT_NO_THROW(world.validate());
    EXPECT_LT(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(1000 * boxes + 100 * limit))
        << "mode " << int(mode);
    for (std::size_t i = 0; i < boxes; ++i) world.move(ids[i], cube(float(2 * i), 0));
    EXPECT_EQ(world.update().pairs, 0u);
  }
}

// Their fat boxes all overlap, which would be four million candidates.
TEST(Memory, ThinPlatesCloseTogetherTakeNoMemoryForCandidates) {
  constexpr std::size_t plates = 3000;
  detail::WorldCore<float> world({}, detail::SearchMode::candidates);
  std::vector<Aabb> boxes(plates);
  std::vector<ProxyId> ids(plates);
  const auto shift = [&](int frame) {
    for (std::size_t i = 0; i < plates; ++i) {
      const float z = static_cast<float>(i) * 0.002f + static_cast<float>(frame % 2) * 0.0001f;
      boxes[i] = {{0, 0, z}, {1000, 1000, z + 0.001f}};
    }
  };
  shift(0);
  world.create(boxes, {}, ids, {});
  heap_watch::reset_peak();
  const std::int64_t before = heap_watch::live_bytes();
  for (int frame = 0; frame < 30; ++frame) {
    shift(frame);
    world.move(ids, boxes);
    EXPECT_EQ(world.update().pairs, 0u);
    ASSERT_NO_THROW(world.validate());
  }
  EXPECT_LT(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(8 * plates * 40 + plates * 2000));
}

}  // namespace

}  // namespace boxstream::tests
