// SPDX-License-Identifier: MIT
// What a user can do about a narrow phase that throws, dies or does not come back; the manager goes on.
#include <fcl/geometry/shape/box.h>

#include <boxstream/fcl.hpp>
#include <chrono>
#include <csignal>
#include <functional>
#include <stdexcept>

#include "every_pose.hpp"
#include "fcl_objects.hpp"
#include "process.hpp"

namespace boxstream::poses {
namespace {

using Object = ::fcl::CollisionObject<double>;
using Manager = boxstream::fcl::CollisionManager<double>;
using Clock = std::chrono::steady_clock;

/// The hard poses of two boxes whose bounds touch, each pair in a place of its own.
class AllBoxes {
 public:
  AllBoxes() {
    for (const HardPose& pose : all())
      if (pose.a.kind == Kind::box && pose.b.kind == Kind::box) add(pose);
    for (const auto& o : objects_) manager.registerObject(o.get());
  }

  std::size_t pairs() const { return objects_.size() / 2; }
  std::size_t index(const Object* o) const {
    return static_cast<std::size_t>(
        std::find_if(objects_.begin(), objects_.end(), [&](const auto& p) { return p.get() == o; }) - objects_.begin());
  }

  /// True if a query reports exactly the pairs, in order, each once.
  bool is_exact() const {
    struct Seen {
      const AllBoxes& boxes;
      std::vector<std::size_t> indices{};
    } seen{*this};
    manager.collide(&seen, [](Object* first, Object* second, void* data) {
      Seen& s = *static_cast<Seen*>(data);
      s.indices.push_back(s.boxes.index(first));
      s.indices.push_back(s.boxes.index(second));
      return false;
    });
    for (std::size_t i = 0; i < seen.indices.size(); ++i)
      if (seen.indices[i] != i) return false;
    return seen.indices.size() == objects_.size();
  }

  Manager manager;

 private:
  void add(const HardPose& pose) {
    Solid a = pose.a, b = pose.b;
    for (Solid* const solid : {&a, &b}) solid->translation.x() += 1e4 * static_cast<double>(pairs());
    auto first = object<double>(a), second = object<double>(b);
    if (!first->getAABB().overlap(second->getAABB())) return;
    objects_.push_back(std::move(first));
    objects_.push_back(std::move(second));
  }

  std::vector<std::unique_ptr<Object>> objects_;
};

/// A callback that is any function.
struct Callback {
  std::function<bool(Object*, Object*)> function;
  static bool call(Object* first, Object* second, void* data) {
    return static_cast<Callback*>(data)->function(first, second);
  }
};

TEST(Survival, OfAnExceptionAtEveryPair) {
  const AllBoxes boxes;
  ASSERT_GT(boxes.pairs(), 10U);
  ASSERT_TRUE(boxes.is_exact());
  for (std::size_t at = 0; at < boxes.pairs(); ++at) {
    std::size_t calls = 0;
    Callback callback{[&](Object*, Object*) -> bool {
      if (calls++ == at) throw std::logic_error("the origin is outside of the polytope");
      return false;
    }};
    EXPECT_THROW(boxes.manager.collide(&callback, Callback::call), std::logic_error);
    EXPECT_EQ(calls, at + 1);
    EXPECT_TRUE(boxes.is_exact()) << "after an exception at pair " << at;
  }
}

TEST(Survival, OfACallbackThatStopsWhenItsTimeIsOver) {
  const AllBoxes boxes;
  std::size_t calls = 0;
  Callback callback{[&](Object*, Object*) {
    ++calls;
    const auto end = Clock::now() + std::chrono::milliseconds(20);
    while (Clock::now() < end) {
    }
    return true;
  }};
  boxes.manager.collide(&callback, Callback::call);
  EXPECT_EQ(calls, 1U);
  EXPECT_TRUE(boxes.is_exact());
}

/// The narrow phase in a process of its own that uses up its time, killed from the callback; the query goes on.
TEST(Survival, OfANarrowPhaseThatDoesNotEnd) {
  const AllBoxes boxes;
  tool_test::RunOptions options;
  options.cpu_seconds = 1;
  std::size_t calls = 0;
  int ended = 0;
  Callback callback{[&](Object*, Object*) {
    if (calls++ == boxes.pairs() / 2)
      ended = tool_test::run_program("/bin/sh", {"-c", "while :; do :; done"}, options).exit_code;
    return false;
  }};
  boxes.manager.collide(&callback, Callback::call);
  EXPECT_EQ(ended, 128 + SIGXCPU);
  EXPECT_EQ(calls, boxes.pairs());
  EXPECT_TRUE(boxes.is_exact());
}

}  // namespace
}  // namespace boxstream::poses
