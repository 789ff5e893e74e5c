// SPDX-License-Identifier: MIT
// Allocations that fail, one after the other, and how much is allocated at all.
#include <functional>
#include <new>

#include "heap_watch.hpp"
#include "sanitized.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

namespace heap_watch = tests::heap_watch;

template <class S>
struct Memory : ::testing::Test {};
TYPED_TEST_SUITE(Memory, Scalars);

/// Does not allocate itself.
struct Count {
  std::size_t calls = 0;
  template <class S>
  static bool pair(Object<S>*, Object<S>*, void* data) {
    ++static_cast<Count*>(data)->calls;
    return false;
  }
  template <class S>
  static bool near(Object<S>*, Object<S>*, void* data, S&) {
    return ++static_cast<Count*>(data)->calls == 100;
  }
};

/// A manager that has lived for a while, with changes pending, and what to do with it when memory runs out.
template <class S>
struct Setting {
  explicit Setting(std::size_t size) {
    std::mt19937 random(41);
    for (const FclBox<S>& box : random_cubes<S>(size, 5, random)) scene.add(box);
    for (const FclBox<S>& box : random_cubes<S>(size / 2, 5, random)) others.add(box);
    for (const FclBox<S>& box : random_cubes<S>(size, 5, random)) newcomers.add(box);
    manager.registerObjects(scene.pointers());
    other.registerObjects(others.pointers());
    collide<S>(manager);
    for (int i = 0; i < 50; ++i) collide<S>(manager, scene[1]);
    for (std::size_t i = 0; i < size; i += 2) scene[i].set(scene[(i + 1) % size].getAABB());
    manager.update();
    manager.unregisterObject(&scene[3]);
  }

  /// All that a manager says.
  std::vector<Calls> answers() {
    std::vector<Calls> all = {collide<S>(manager), collide<S>(manager, scene[5]), collide<S>(manager, other)};
    manager.distance(&scene[5], &all.emplace_back(), record_distance<S>);
    return all;
  }

  Scene<S> scene, others, newcomers;
  Manager<S> manager, other;
  Count count;
};

template <class S>
using Operation = std::function<void(Setting<S>&)>;

/// What fails must throw std::bad_alloc and leave the managers in order; tried again, it works; nothing leaks.
template <class S>
void fail_each_allocation(const char* name, std::size_t size, const Operation<S>& operation) {
  SCOPED_TRACE(std::string(name) + " with " + std::to_string(size) + " objects");
  std::vector<Calls> expected;
  {
    Setting<S> undisturbed(size);
    operation(undisturbed);
    expected = undisturbed.answers();
  }
  const std::int64_t live_before = heap_watch::live_allocations();
  bool failed = true;
  for (std::int64_t allowed = 0; failed; ++allowed) {
    ASSERT_LT(allowed, 3000) << "never finishes";
    {
      Setting<S> setting(size);
      bool threw = false;
      heap_watch::fail_after(allowed);
      try {
        operation(setting);
      } catch (const std::bad_alloc&) {
        threw = true;
      }
      failed = heap_watch::stop_failing();
      ASSERT_TRUE(failed || !threw);
      ASSERT_NO_THROW(setting.manager.validate()) << "after allocation " << allowed;
      ASSERT_NO_THROW(setting.other.validate()) << "after allocation " << allowed;
      if (threw) operation(setting);
      const std::vector<Calls> answers = setting.answers();
      for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_CALLS(answers[i], expected[i]) << "query " << i << " after allocation " << allowed;
      ASSERT_NO_THROW(setting.manager.validate()) << "after allocation " << allowed;
    }
    ASSERT_EQ(heap_watch::live_allocations(), live_before) << "after allocation " << allowed;
  }
}

TYPED_TEST(Memory, EachAllocationMayFail) {
  using S = TypeParam;
  using Case = Setting<S>;
  for (const std::size_t size : {30, tests::sanitized ? 100 : 300}) {
    fail_each_allocation<S>("collide", size, [](Case& s) { s.manager.collide(&s.count, Count::pair<S>); });
    fail_each_allocation<S>("collide with an object", size, [](Case& s) {
      for (int i = 0; i < 60; ++i) s.manager.collide(&s.scene[5], &s.count, Count::pair<S>);
    });
    fail_each_allocation<S>("collide with a manager", size,
                            [](Case& s) { s.manager.collide(&s.other, &s.count, Count::pair<S>); });
    fail_each_allocation<S>("distance", size, [](Case& s) { s.manager.distance(&s.count, Count::near<S>); });
    fail_each_allocation<S>("distance of an object", size,
                            [](Case& s) { s.manager.distance(&s.scene[5], &s.count, Count::near<S>); });
    fail_each_allocation<S>("distance of a manager", size,
                            [](Case& s) { s.manager.distance(&s.other, &s.count, Count::near<S>); });
    fail_each_allocation<S>("registerObjects", size,
                            [](Case& s) { s.manager.registerObjects(s.newcomers.pointers()); });
    fail_each_allocation<S>("registerObject", size, [](Case& s) {
      for (Object<S>* object : s.newcomers.pointers()) s.manager.registerObject(object);
    });
    fail_each_allocation<S>("unregisterObject", size, [](Case& s) {
      for (std::size_t i = 10; i < s.scene.size(); ++i) s.manager.unregisterObject(&s.scene[i]);
      s.manager.registerObjects(s.newcomers.pointers());
      s.manager.collide(&s.count, Count::pair<S>);
    });
  }
}

/// More pairs than are held: found row by row, in memory for the boxes.
TYPED_TEST(Memory, MillionsOfPairsTakeMemoryForTheBoxesAlone) {
  using S = TypeParam;
  const std::size_t n = tests::sanitized ? 1700 : 4000;
  Scene<S> scene(std::vector<FclBox<S>>(n, cube<S>(1, 2, 3)));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  for (int again = 0; again < 2; ++again) {
    Count count;
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    manager.collide(&count, Count::pair<S>);
    EXPECT_EQ(count.calls, n * (n - 1) / 2);
    // The search for them stops at 2^20 + 32 n that would be held, of which the World has 8 bytes each.
    const std::size_t tried = (std::size_t{1} << 20) + 32 * n;
    EXPECT_LT(heap_watch::peak_bytes() - before, static_cast<std::int64_t>(2000 * n + 24 * tried));
  }
  ASSERT_NO_THROW(manager.validate());
}

}  // namespace
}  // namespace boxstream::fcl_test
