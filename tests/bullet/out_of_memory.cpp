// SPDX-License-Identifier: MIT
// The first, second, ... allocation fails. Bullet's interface has no way to say so: one line on stderr, and abort;
// never a wrong answer, or a crash somewhere else. Each case is a process of its own.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <boxstream/bullet.hpp>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "heap_watch.hpp"
#include "support.hpp"

namespace bullet_tests {
namespace {

namespace heap_watch = boxstream::tests::heap_watch;

/// A broad-phase in which things have happened and others are due, and what to do with it when memory runs out.
struct Setting {
  explicit Setting(bool borrowed) {
    rig.broadphase = std::make_unique<boxstream::bullet::Broadphase>(borrowed ? &cache : nullptr);
    for (int i = 0; i < 150; ++i) proxies.push_back(rig.create(cube(btScalar(i), 0, 0)));
    rig.calculate();
    for (std::size_t i = 0; i < proxies.size(); ++i) rig.move(proxies[i], cube(btScalar(i / 4), 0, 0));
  }
  btHashedOverlappingPairCache cache;
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies;
};

struct Operation {
  const char* name;
  std::function<void(Setting&)> run;
  std::function<bool(Setting&)> is_right;
};

/// 150 cubes at 38 places, each of which meets its own place and the next ones.
int pairs_of_crowd() {
  int pairs = 0;
  for (int i = 0; i < 150; ++i)
    for (int j = i + 1; j < 150; ++j) pairs += j / 4 - i / 4 <= 1;
  return pairs;
}

const Operation operations[] = {
    {"calculate", [](Setting& s) { s.rig.calculate(); },
     [](Setting& s) { return s.rig.pair_count() == pairs_of_crowd(); }},
    {"query",
     [](Setting& s) {
       struct Count : btBroadphaseAabbCallback {
         bool process(const btBroadphaseProxy*) override { return true; }
       } count;
       s.rig.broadphase->aabbTest(btVector3(0, 0, 0), btVector3(1, 1, 1), count);
       FoundOnRay ray(btVector3(-9, 9, 9), btVector3(9, 9, 9));
       s.rig.broadphase->rayTest(btVector3(-9, 9, 9), btVector3(9, 9, 9), ray);
       btVector3 lo, hi;
       s.rig.broadphase->getBroadphaseAabb(lo, hi);
     },
     [](Setting& s) { return s.rig.in_box(cube(0, 0, 0, btScalar(0.25))).size() == 4; }},
    {"create",
     [](Setting& s) {
       for (int i = 0; i < 300; ++i)
         s.proxies.push_back(s.rig.broadphase->createProxy(btVector3(0, 9, 0), btVector3(1, 10, 1), 0, nullptr, 1, -1,
                                                           &s.rig.dispatcher));
     },
     [](Setting& s) {
       const bool found = s.rig.in_box(cube(0, 9, 0)).size() == 300;
       for (std::size_t i = 150; i < s.proxies.size(); ++i)
         s.rig.broadphase->destroyProxy(s.proxies[i], &s.rig.dispatcher);
       return found;
     }},
    {"destroy",
     [](Setting& s) {
       s.rig.calculate();
       for (std::size_t i = 0; i < 20; ++i) s.rig.broadphase->destroyProxy(s.proxies[i], &s.rig.dispatcher);
     },
     [](Setting& s) { return s.rig.in_box(cube(0, 0, 0, btScalar(0.25))).empty(); }},
};

bool aborted_or_finished(int status) {
  return (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT) || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

/// Some allocations are only for later calls, and may fail without harm; then the outcome must be right.
void run_with_failure(const Operation& operation, bool borrowed, std::int64_t allowed) {
  Setting setting(borrowed);
  setting.proxies.reserve(1000);
  heap_watch::fail_after(allowed);
  operation.run(setting);
  heap_watch::stop_failing();
  std::fprintf(stderr, operation.is_right(setting) ? "finished\n" : "wrong\n");
  std::_Exit(0);
}

void fail_each_allocation(const Operation& operation, bool borrowed) {
  SCOPED_TRACE(std::string(operation.name) + (borrowed ? ", borrowed cache" : ", own cache"));
  std::int64_t allocations = 0;
  {
    Setting setting(borrowed);
    setting.proxies.reserve(1000);
    const std::uint64_t before = heap_watch::allocations();
    operation.run(setting);
    allocations = static_cast<std::int64_t>(heap_watch::allocations() - before);
    ASSERT_TRUE(operation.is_right(setting));
  }
  ASSERT_GT(allocations, 0) << "nothing was put to the test";
  for (std::int64_t allowed = 0; allowed < allocations; ++allowed)
    EXPECT_EXIT(run_with_failure(operation, borrowed, allowed), aborted_or_finished,
                "^boxstream::bullet: out of memory\n$|^finished\n$")
        << "allocation " << allowed;
}

TEST(BulletOutOfMemory, EachAllocationMayFail) {
  for (const Operation& operation : operations) fail_each_allocation(operation, false);
}

TEST(BulletOutOfMemory, EachAllocationMayFailWithABorrowedCache) {
  for (const Operation& operation : operations) fail_each_allocation(operation, true);
}

/// Bullet's arrays take their memory from a function of Bullet's, and do not look at what they get. Here that has a
/// ceiling.
std::size_t aligned_left = ~std::size_t{0};

void* allocate_aligned(std::size_t bytes, int alignment) {
  if (bytes > aligned_left) return nullptr;
  const auto step = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(step, (bytes + step - 1) / step * step);
  aligned_left -= malloc_usable_size(memory);
  return memory;
}

void free_aligned(void* memory) {
  if (memory != nullptr) aligned_left += malloc_usable_size(memory);
  std::free(memory);
}

void grow_below_ceiling(std::size_t bytes) {
  btAlignedAllocSetCustomAligned(allocate_aligned, free_aligned);
  Setting setting(false);
  aligned_left = bytes;
  setting.rig.calculate();
  aligned_left = ~std::size_t{0};
  std::fprintf(stderr, setting.rig.pair_count() == pairs_of_crowd() ? "finished\n" : "wrong\n");
  std::_Exit(0);
}

TEST(BulletOutOfMemory, ThePairArrayMayNotGrow) {
  EXPECT_EXIT(grow_below_ceiling(0), testing::KilledBySignal(SIGABRT), "^boxstream::bullet: out of memory\n$");
  for (std::size_t bytes = 1000; bytes < 200000; bytes += bytes / 2)
    EXPECT_EXIT(grow_below_ceiling(bytes), aborted_or_finished, "^boxstream::bullet: out of memory\n$|^finished\n$")
        << bytes << " bytes";
  EXPECT_EXIT(grow_below_ceiling(1 << 20), testing::ExitedWithCode(0), "^finished\n$");
}

}  // namespace
}  // namespace bullet_tests
