// SPDX-License-Identifier: MIT
// Allocations that fail, one after the other, and how much is allocated at all.
#include <algorithm>
#include <new>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/executors.hpp"
#include "heap_watch.hpp"
#include "model.hpp"
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
};

/// What becomes of a call that ran out of memory: it is made again at once, after a look at everything, or not at all.
enum class Then { again, look_and_again, give_up };

/// Two managers beside their models. Calls of the managers run out of memory where heap_watch::fail_at says so.
template <class S>
class FlakyHistory {
 public:
  FlakyHistory(unsigned seed, Executor* executor, Then then)
      : random_(seed + 1), then_(then), manager_(executor), other_(executor) {
    for (const FclBox<S>& box : random_cubes<S>(220, 8, boxes_)) scene_.add(box);
    put(300);
  }

  void step() {
    switch (pick(15)) {
      case 0:
        return put(30);
      case 1: {
        BoxObject<S>& object = any();
        if (call([&] { manager_.registerObject(&object); })) model_.put(object);
        break;
      }
      case 2: {
        const std::vector<BoxObject<S>*> few = some(3);
        const std::vector<Object<S>*> pointers(few.begin(), few.end());
        insist([&] { manager_.registerStaticObjects(pointers); });
        for (BoxObject<S>* object : few) model_.put_static(*object);
        break;
      }
      case 3:
        for (BoxObject<S>* object : some(pick(80)))
          if (call([&] { manager_.unregisterObject(object); })) model_.erase(*object);
        break;
      case 4:
        shift(some(6));
        if (call([&] { manager_.update(); })) model_.look();
        break;
      case 5: {
        const std::vector<BoxObject<S>*> few = some(4);
        shift(few);
        const std::vector<Object<S>*> pointers(few.begin(), few.end());
        insist([&] { manager_.update(pointers); });
        for (BoxObject<S>* object : few) model_.look(*object);
        break;
      }
      case 6: {
        BoxObject<S>& object = any();
        const boxstream::fcl::Groups groups{static_cast<std::uint16_t>(1 + pick(3)), 0xffff};
        if (call([&] { manager_.setGroups(&object, groups); })) model_.set_groups(object, groups);
        break;
      }
      case 7: {
        BoxObject<S>& object = any();
        const bool is_static = pick(2) == 0;
        if (call([&] { manager_.setStatic(&object, is_static); })) model_.set_static(object, is_static);
        break;
      }
      case 8:
        if (pick(4) == 0 && call([&] { manager_.clear(); })) model_.clear();
        return put(150);
      case 9: {
        BoxObject<S>& object = any();
        if (call([&] { other_.registerObject(&object); })) other_model_.put(object);
        break;
      }
      case 10:
        return compare_pairs();
      case 11:  // often enough for an index to pay
        for (int i = 0; i < 40; ++i) compare_pairs_of(any());
        return;
      case 12:
        return compare_distances();
      case 13:  // what is known of the nearest pair is of other places then
        compare_distances();
        for (auto* manager : {&manager_, &other_}) call([manager] { manager->shrink_to_fit(); });
        return compare_distances();
      default:
        return compare_objects();
    }
  }

  /// Every query of both managers, and of every object.
  void compare_all() {
    ASSERT_NO_THROW(manager_.validate());
    ASSERT_NO_THROW(other_.validate());
    compare_objects();
    compare_pairs();
    for (std::size_t i = 0; i < scene_.size(); ++i) compare_pairs_of(scene_[i]);
    compare_distances();
    compare_ray();
    ASSERT_NO_THROW(manager_.validate());
  }

  std::size_t failures() const { return failures_; }

 private:
  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() >> 8) % n; }
  BoxObject<S>& any() { return scene_[pick(static_cast<unsigned>(scene_.size()))]; }
  std::vector<BoxObject<S>*> some(std::size_t count) {
    std::vector<BoxObject<S>*> objects;
    for (std::size_t i = 0; i < count; ++i) objects.push_back(&any());
    return objects;
  }
  void shift(const std::vector<BoxObject<S>*>& objects) {
    const std::vector<FclBox<S>> to = random_cubes<S>(20, 8, boxes_);
    for (BoxObject<S>* object : objects) object->set(to[pick(20)]);
  }
  void put(std::size_t count) {
    const std::vector<BoxObject<S>*> objects = some(count);
    const std::vector<Object<S>*> pointers(objects.begin(), objects.end());
    insist([&] { manager_.registerObjects(pointers); });
    for (BoxObject<S>* object : objects) model_.put(*object);
  }

  /// False if it was given up: then nothing has changed.
  template <class Call>
  bool call(Call&& make, bool may_give_up = true) {
    for (;;) {
      try {
        const heap_watch::Failures come(!is_looked_at_);
        make();
        return true;
      } catch (const std::bad_alloc&) {
        ++failures_;
      }
      if (may_give_up && then_ == Then::give_up) return false;
      // Of several objects a part may be known already.
      if (!may_give_up || then_ != Then::look_and_again) continue;
      is_looked_at_ = true;
      compare_all();
      is_looked_at_ = false;
    }
  }
  template <class Call>
  void insist(Call&& make) {
    call(make, false);
  }

  static bool write_down(Object<S>* a, Object<S>* b, void* calls) {
    const heap_watch::Failures wait(false);
    return record(a, b, calls);
  }
  static bool write_down_distance(Object<S>* a, Object<S>* b, void* calls, S&) { return write_down(a, b, calls); }

  template <class Query>
  void compare(const char* what, const Calls& ought, Query&& query, bool in_order = true) {
    Calls calls;
    const bool finished = call([&] {
      calls.clear();
      query(calls);
    });
    if (!finished) return;
    if (in_order)
      ASSERT_CALLS(calls, ought) << what;
    else
      ASSERT_CALLS(in_any_order(calls), in_any_order(ought)) << what;
  }

  void compare_pairs() {
    compare("collide", model_.collide(), [&](Calls& calls) { manager_.collide(&calls, write_down); });
    compare(
        "collide with a manager", model_.collide(other_model_),
        [&](Calls& calls) { manager_.collide(&other_, &calls, write_down); }, false);
    compare(
        "collide with this manager", other_model_.collide(model_),
        [&](Calls& calls) { other_.collide(&manager_, &calls, write_down); }, false);
  }
  void compare_pairs_of(BoxObject<S>& object) {
    compare(
        "collide with an object", model_.collide(object),
        [&](Calls& calls) { manager_.collide(&object, &calls, write_down); }, false);
  }
  void compare_distances() {
    BoxObject<S>& object = any();
    compare(
        "distance", model_.all_pairs().all, [&](Calls& calls) { manager_.distance(&calls, write_down_distance); },
        false);
    compare(
        "distance of an object", model_.all_pairs(object).all,
        [&](Calls& calls) { manager_.distance(&object, &calls, write_down_distance); }, false);
    compare(
        "distance of a manager", model_.all_pairs(other_model_).all,
        [&](Calls& calls) { manager_.distance(&other_, &calls, write_down_distance); }, false);
  }
  /// Through all boxes along an axis, so that exact arithmetic is no matter.
  void compare_ray() {
    const FclBox<S> at = any().getAABB();
    const ::fcl::Vector3<S> middle = (at.min_ + at.max_) / 2;
    const FclBox<S> line = make_box<S>(-100, middle[1], middle[2], 100, middle[1], middle[2]);
    BoxObject<S> segment(line, -2);
    Calls hits;
    if (!call([&] {
          hits.clear();
          manager_.rayCast({-100, middle[1], middle[2]}, {100, middle[1], middle[2]}, [&](Object<S>* hit, S) {
            const heap_watch::Failures wait(false);
            hits.push_back({name_of(hit), -2});
            return false;
          });
        }))
      return;
    Calls ought;
    for (Object<S>* object : model_.objects())
      if (touch(seen(object), line)) ought.push_back({name_of(object), -2});
    ASSERT_CALLS(in_any_order(hits), in_any_order(ought)) << "rayCast";
  }
  /// The box that the manager read last.
  FclBox<S> seen(Object<S>* object) const { return model_.box(*static_cast<BoxObject<S>*>(object)); }

  void compare_objects() {
    std::vector<Object<S>*> objects;
    if (!call([&] { manager_.getObjects(objects); })) return;
    ASSERT_EQ(objects, model_.objects());
    ASSERT_EQ(manager_.size(), model_.objects().size());
  }

  std::mt19937 boxes_{41};
  std::minstd_rand random_;
  const Then then_;
  Scene<S> scene_;
  Manager<S> manager_, other_;
  Model<S> model_, other_model_;
  std::size_t failures_ = 0;
  bool is_looked_at_ = false;
};

/// Returns how many allocations there were to fail.
template <class S>
std::int64_t play(unsigned seed, std::int64_t first, std::int64_t second, Then then) {
  tests::InlineExecutor four(4);
  const std::int64_t live_before = heap_watch::live_allocations();
  {
    heap_watch::fail_at(first, second);
    const heap_watch::Failures wait(false);
    FlakyHistory<S> history(seed, seed % 2 == 0 ? nullptr : &four, then);
    std::size_t failures = 0;
    for (int i = 0; i < 15 && !::testing::Test::HasFailure(); ++i) {
      history.step();
      if (history.failures() != failures) history.compare_all();
      failures = history.failures();
    }
    history.compare_all();
  }
  heap_watch::stop_failing();
  const bool leaks = heap_watch::live_allocations() != live_before;
  EXPECT_FALSE(leaks && first != heap_watch::never);  // the first time, there are static objects
  return heap_watch::tried();
}

/// What fails must throw std::bad_alloc and leave the managers in order; tried again, it works; nothing leaks.
TYPED_TEST(Memory, EachAllocationMayFail) {
  using S = TypeParam;
  const unsigned seed = sizeof(S) == 4 ? 4 : 9;  // with an executor and without
  const std::int64_t allocations = play<S>(seed, heap_watch::never, heap_watch::never, Then::again);
  ASSERT_GT(allocations, 50) << "hardly anything was put to the test";
  for (std::int64_t first = 0; first < allocations; first += tests::sanitized ? 19 : 1)
    for (const Then then : {Then::again, Then::look_and_again, Then::give_up}) {
      // Of calls that are made again, the next allocation or one of those after it.
      const std::int64_t second = then == Then::look_and_again ? heap_watch::never : first * 7 % 11;
      SCOPED_TRACE("allocation " + std::to_string(first) + ", then " + std::to_string(second) + ", way " +
                   std::to_string(int(then)));
      play<S>(seed, first, second, then);
      if (this->HasFailure()) return;
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

/// Bytes an object, as the header states them.
TYPED_TEST(Memory, BytesOfAnObject) {
  using S = TypeParam;
  for (const std::size_t n : {1000, 10000, 20000}) {
    std::mt19937 random(8);
    Scene<S> scene(random_cubes<S>(n, 2 * std::cbrt(double(n)), random));
    const std::int64_t none = heap_watch::live_bytes();
    Manager<S> manager;
    const auto bytes = [&] { return double(heap_watch::live_bytes() - none) / double(n); };
    for (auto* const object : scene.pointers()) manager.registerObject(object);
    const double one_by_one = bytes();
    manager.shrink_to_fit();
    const double registered = bytes();
    Count count;
    manager.distance(scene.pointers()[0], &count, [](auto*, auto*, void*, S& limit) {
      limit = S(0.1);
      return false;
    });
    const double indexed = bytes();
    manager.collide(&count, Count::pair<S>);
    EXPECT_GT(bytes(), indexed);
    const bool is_wide = sizeof(S) == 8;
    EXPECT_LT(bytes(), indexed + (is_wide ? 125 : 100) + 8 * double(count.calls) / double(n));
    manager.shrink_to_fit();
    EXPECT_LT(bytes(), registered + 1);
    EXPECT_LT(registered, is_wide ? 90 : 66);
    EXPECT_LT(one_by_one, is_wide ? 135 : 99);
    EXPECT_LT(indexed, is_wide ? 165 : 110);
    manager.clear();
    manager.shrink_to_fit();
    EXPECT_EQ(heap_watch::live_bytes(), none);
  }
}

/// Once they have been asked, queries need no more memory, in order of registration neither.
TYPED_TEST(Memory, QueriesAskedAgainAllocateNothing) {
  using S = TypeParam;
  for (const std::size_t n : {5, 60, 600}) {
    Scene<S> scene(std::vector<FclBox<S>>(n, cube<S>(1, 2, 3))), others(std::vector<FclBox<S>>(n, cube<S>(1, 2, 3)));
    Manager<S> manager, other;
    manager.registerObjects(scene.pointers());
    other.registerObjects(others.pointers());
    manager.setRegistrationOrder(true);
    std::uint64_t before = 0;
    Count count;
    for (int again = 0; again < 3; ++again) {
      before = heap_watch::allocations();
      manager.collide(others.pointers()[0], &count, Count::pair<S>);
      manager.collide(&count, Count::pair<S>);
      manager.distance(others.pointers()[0], &count, [](auto*, auto*, void*, S&) { return false; });
      manager.distance(&count, [](auto*, auto*, void*, S&) { return false; });
    }
    EXPECT_EQ(heap_watch::allocations(), before) << n;
  }
}

}  // namespace
}  // namespace boxstream::fcl_test
