// SPDX-License-Identifier: MIT
// Every allocation of this program is counted and can be made to fail.
#include <gtest/gtest.h>

#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <vector>

#include <boxstream/world.hpp>

#include "sanitized.hpp"
#include "world/core.hpp"

namespace {

std::size_t allocations = 0;
std::size_t fatal_allocation = 0;  // counted from 1; 0: none
std::int64_t bytes_now = 0;
std::int64_t bytes_most = 0;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (++allocations == fatal_allocation) throw std::bad_alloc();
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  bytes_now += static_cast<std::int64_t>(malloc_usable_size(memory));
  bytes_most = std::max(bytes_most, bytes_now);
  return memory;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  bytes_now -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocate(bytes == 0 ? 1 : bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes == 0 ? 1 : bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace boxstream::tests {

Aabb cube(float x, float y) {
  return {{x, y, 0}, {x + 1, y + 1, 1}};
}

/// A world that has lived for a while, with changes of every kind pending.
struct Inhabited {
  detail::WorldCore<float> world;
  std::vector<ProxyId> ids;

  explicit Inhabited(detail::SearchMode mode) : world({}, mode) {
    for (int i = 0; i < 200; ++i) ids.push_back(world.create(cube(float(i % 20) * 0.9f, float(i / 20) * 0.9f)));
    world.update([](ProxyId a, ProxyId b) { return (a.slot + b.slot) % 3 != 0; });
    for (std::size_t i = 0; i < ids.size(); i += 2) world.move(ids[i], cube(float(i % 7), float(i % 5)));
    for (std::size_t i = 1; i < ids.size(); i += 10) world.destroy(ids[i]);
    world.set_filter(ids[2], {1, 0});
  }

  std::vector<std::uint64_t> pairs() const {
    std::vector<std::uint64_t> all;
    world.for_each_pair([&](ProxyPair p) {
      all.push_back(std::uint64_t{p.a.slot} << 32 | p.b.slot);
      all.push_back(std::uint64_t{p.a.generation} << 32 | p.b.generation);
      return true;
    });
    return all;
  }
};

/// Lets the first, second, ... allocation of `operation` fail until it gets through. What fails must leave things as
/// they were, and must work when it is tried again.
void survives_bad_alloc(const std::function<void(Inhabited&)>& operation, detail::SearchMode mode) {
  Inhabited undisturbed(mode);
  const auto before = undisturbed.pairs();
  const std::size_t size_before = undisturbed.world.size();
  operation(undisturbed);
  const std::size_t size_after = undisturbed.world.size();
  const auto after = undisturbed.pairs();
  undisturbed.world.update();
  const auto later = undisturbed.pairs();

  for (std::size_t fatal = 1;; ++fatal) {
    Inhabited subject(mode);
    bool failed = false;
    allocations = 0;
    fatal_allocation = fatal;
    try {
      operation(subject);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    fatal_allocation = 0;
    if (!failed) {
      EXPECT_GT(fatal, 1u) << "nothing was put to the test";
      return;
    }
    ASSERT_EQ(subject.pairs(), before) << "allocation " << fatal;
    ASSERT_EQ(subject.world.size(), size_before);
    subject.world.validate();
    operation(subject);
    ASSERT_EQ(subject.world.size(), size_after);
    ASSERT_EQ(subject.pairs(), after) << "allocation " << fatal;
    subject.world.update();
    ASSERT_EQ(subject.pairs(), later) << "allocation " << fatal;
    subject.world.validate();
  }
}

void survives_bad_alloc(const std::function<void(Inhabited&)>& operation) {
  survives_bad_alloc(operation, detail::SearchMode::cheapest);
  survives_bad_alloc(operation, detail::SearchMode::fences);
}

// D2 row 27.
TEST(Memory, UpdateSurvivesEachFailedAllocation) {
  survives_bad_alloc([](Inhabited& in) {
    for (std::size_t i = 0; i < in.ids.size(); ++i) in.world.move(in.ids[i], cube(float(i % 13), float(i % 3)));
    in.world.update();
  });
}

TEST(Memory, UpdateOfFewSurvivesEachFailedAllocation) {
  survives_bad_alloc([](Inhabited& in) { in.world.update([](ProxyId a, ProxyId) { return a.slot % 2 == 0; }); });
}

TEST(Memory, QueriesSurviveEachFailedAllocation) {
  survives_bad_alloc([](Inhabited& in) {
    std::size_t found = 0;
    in.world.query_box(cube(3, 3), [&](ProxyId) { return ++found > 0; });
    EXPECT_GT(found, 0u);
  });
}

TEST(Memory, CreateSurvivesEachFailedAllocation) {
  for (std::size_t fatal = 1; fatal <= 16; ++fatal) {
    World world;
    std::size_t failed = 0;
    for (int i = 0; i < 300; ++i) {
      const std::size_t size = world.size();
      allocations = 0;
      fatal_allocation = fatal;
      try {
        world.create(cube(float(i), 0));
      } catch (const std::bad_alloc&) {
        fatal_allocation = 0;
        ++failed;
        ASSERT_EQ(world.size(), size);
        world.validate();
        world.create(cube(float(i), 0));
      }
      fatal_allocation = 0;
    }
    EXPECT_TRUE(failed > 0 || fatal > 8);
    EXPECT_EQ(world.update().pairs, 299u);
    world.validate();
  }
}

TEST(Memory, BulkCreateSurvivesEachFailedAllocation) {
  survives_bad_alloc([](Inhabited& in) {
    const std::vector<Aabb> boxes(300, cube(2, 2));
    std::vector<ProxyId> made(300);
    in.world.create(boxes, {}, made, {});
  });
}

// D2 row 27.
TEST(Memory, EagerPairsThatWereAnnouncedAreHeld) {
  Inhabited in(detail::SearchMode::fences);
  in.world.update();
  for (const ProxyId id : in.ids) {
    const auto before = in.pairs();
    std::size_t begun = 0;
    allocations = 0;
    fatal_allocation = 1;
    try {
      in.world.begin_pairs_of(
          id, [](ProxyId, ProxyId) { return true; }, [&](ProxyPair) { ++begun; });
    } catch (const std::bad_alloc&) {
    }
    fatal_allocation = 0;
    EXPECT_EQ(in.pairs().size(), before.size() + 2 * begun);
    in.world.validate();
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
    allocations = 0;
    for (int i = 0; i < warm_up; ++i) frame(i, stride);
    EXPECT_EQ(allocations, 0u) << "every " << stride << "th box moving";
  }
}

TEST(Memory, SteadyStateAllocatesNothing) {
  allocates_nothing_in_steady_state(detail::SearchMode::cheapest, 80);
}

// Fences count tombstones as well, which pile up for 750 of these frames before they are dropped.
TEST(Memory, SteadyStateWithFencesAllocatesNothing) {
  if (tests::sanitized) GTEST_SKIP() << "takes a minute, and counts the same without";
  allocates_nothing_in_steady_state(detail::SearchMode::fences, 1600);
}

// More pairs than 32 bits count begin at once: the limit is met in memory for the boxes, and nothing has changed.
TEST(Memory, MorePairsThanTheLimitTakeNoMemory) {
  constexpr std::size_t boxes = 65537, limit = 100000;
  for (const auto mode : {detail::SearchMode::all, detail::SearchMode::probe, detail::SearchMode::fences}) {
    detail::WorldCore<float> world({}, mode);
    std::vector<ProxyId> ids(boxes);
    bytes_now = bytes_most = 0;
    world.create(std::vector<Aabb>(boxes, cube(0, 0)), {}, ids, {});
    world.limit_begun(limit);
    for (int again = 0; again < 2; ++again) {
      EXPECT_THROW(world.update(), std::length_error);
      EXPECT_EQ(world.pair_count(), 0u);
    }
    ASSERT_NO_THROW(world.validate());
    EXPECT_LT(bytes_most, static_cast<std::int64_t>(1000 * boxes + 100 * limit)) << "mode " << int(mode);
    for (std::size_t i = 0; i < boxes; ++i) world.move(ids[i], cube(float(2 * i), 0));
    EXPECT_EQ(world.update().pairs, 0u);
  }
}

// Their fences all overlap, which would be four million candidates.
TEST(Memory, ThinPlatesCloseTogetherTakeNoMemoryForFences) {
  constexpr std::size_t plates = 3000;
  detail::WorldCore<float> world({}, detail::SearchMode::fences);
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
  bytes_now = bytes_most = 0;
  for (int frame = 0; frame < 30; ++frame) {
    shift(frame);
    world.move(ids, boxes);
    EXPECT_EQ(world.update().pairs, 0u);
    ASSERT_NO_THROW(world.validate());
  }
  EXPECT_LT(bytes_most, static_cast<std::int64_t>(8 * plates * 40 + plates * 2000));
}

}  // namespace boxstream::tests
