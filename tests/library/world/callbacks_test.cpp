// SPDX-License-Identifier: MIT
// Callbacks that throw at each of their calls, for every function that takes one: what went before stands, what comes
// after is right.
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/box_sets.hpp"
#include "sanitized.hpp"
#include "watched_world.hpp"

namespace boxstream::tests {
namespace {

struct Thrown {};

/// Counts calls and throws at one of them.
class Fuse {
 public:
  explicit Fuse(std::size_t at) : at_(at) {}
  void burn() {
    if (++calls_ == at_) throw Thrown();
  }
  std::size_t calls() const { return calls_; }

 private:
  std::size_t at_;
  std::size_t calls_ = 0;
};

template <class S>
class Callbacks : public testing::Test {
 protected:
  using World = detail::WorldCore<S>;
  using Use = std::function<void(World&, Fuse&)>;

  /// A world with pairs, and with changes that the next update is to find: 20 boxes to one place.
  static void fill(World& world, std::vector<ProxyId>& ids) {
    const auto boxes = box_set<S>("dense").make(60, 2);
    ids.resize(boxes.size());
    world.create(boxes, {}, ids, {});
    world.update();
    for (std::size_t i = 0; i < ids.size(); i += 3) world.move(ids[i], boxes[0]);
    world.destroy(ids[7]);
  }

  static std::vector<std::uint32_t> held(const World& world) {
    std::vector<std::uint32_t> slots;
    world.for_each_pair([&](ProxyPair pair) {
      slots.insert(slots.end(), {pair.a.slot, pair.b.slot});
      return true;
    });
    return slots;
  }

  /// `keeps_pairs`: whether the pairs held must be those from before the call that threw.
  static void throw_at_each_call(const Use& use, bool keeps_pairs) {
    for (const auto mode : search_modes) {
      SCOPED_TRACE(int(mode));
      World undisturbed({}, mode);
      std::vector<ProxyId> ids;
      fill(undisturbed, ids);
      Fuse whole(0);
      use(undisturbed, whole);
      ASSERT_GT(whole.calls(), 5u) << "nothing was put to the test";
      undisturbed.update();
      const auto later = held(undisturbed);
      for (std::size_t at = 1; at <= whole.calls(); ++at) {
        World world({}, mode);
        fill(world, ids);
        const auto before = held(world);
        Fuse fuse(at);
        ASSERT_THROW(use(world, fuse), Thrown);
        EXPECT_EQ(fuse.calls(), at) << "called again after it threw";
        ASSERT_NO_THROW(world.validate());
        if (keeps_pairs) {
          ASSERT_EQ(held(world), before) << "call " << at;
        }
        world.update();
        ASSERT_EQ(held(world), later) << "call " << at;
        ASSERT_NO_THROW(world.validate());
      }
    }
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Callbacks, Scalars);

TYPED_TEST(Callbacks, UpdateThrowsAtEachPair) {
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.update([&](ProxyId, ProxyId) {
          fuse.burn();
          return true;
        });
      },
      true);
}

TYPED_TEST(Callbacks, EagerPairsThrowWhileTheyAreAccepted) {
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        ProxyId first;
        world.query_box(world.bounds(), [&](ProxyId id) {
          if (!first || id.slot < first.slot) first = id;
          return true;
        });
        world.begin_pairs_of(
            first,
            [&](ProxyId, ProxyId) {
              fuse.burn();
              return true;
            },
            [](ProxyPair) {});
      },
      false);  // those accepted by then are held
}

/// Those announced by then are held, and no later update announces them again.
TYPED_TEST(Callbacks, EagerPairsThrowWhileTheyAreAnnounced) {
  using S = TypeParam;
  for (std::size_t at = 1; at <= 29; ++at) {
    detail::WorldCore<S> world;
    std::vector<ProxyId> ids;
    for (int i = 0; i < 30; ++i) ids.push_back(world.create({{0, 0, 0}, {1, 1, 1}}));
    Fuse fuse(at);
    const auto accept = [](ProxyId, ProxyId) { return true; };
    EXPECT_THROW(world.begin_pairs_of(ids[4], accept, [&](ProxyPair) { fuse.burn(); }), Thrown);
    ASSERT_NO_THROW(world.validate());
    const std::uint64_t held = world.pair_count();
    EXPECT_GE(held, at);
    EXPECT_LE(held, 29u);
    EXPECT_EQ(world.update().begun, 30u * 29 / 2 - held);
    ASSERT_NO_THROW(world.validate());
  }
}

TYPED_TEST(Callbacks, VisitorsOfPairsThrowAtEach) {
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.for_each_pair([&](ProxyPair) {
          fuse.burn();
          return true;
        });
      },
      true);
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.stream_pairs([&](Span<const ProxyPair> pairs) {
          for (std::size_t i = 0; i < pairs.size(); ++i) fuse.burn();
          return true;
        });
      },
      true);
}

TYPED_TEST(Callbacks, VisitorsOfQueriesThrowAtEach) {
  using S = TypeParam;
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.query_box(world.bounds(), [&](ProxyId) {
          fuse.burn();
          return true;
        });
      },
      true);
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.query_ray(BasicRay<S>::sweep(world.bounds(), {0, 0, 0}), [&](ProxyId, S, S length) {
          fuse.burn();
          return length;
        });
      },
      true);
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        world.query_nearest_box({{0, 0, 0}, {1, 1, 1}}, S(1e6), [&](ProxyId, S) {
          fuse.burn();
          return S(1e6);
        });
      },
      true);
}

TYPED_TEST(Callbacks, VisitorsOfNearPairsThrowAtEach) {
  using S = TypeParam;
  this->throw_at_each_call(
      [](auto& world, Fuse& fuse) {
        // As far as some two hundred pairs.
        std::size_t pairs = 0;
        world.nearest_pairs(world, S(1e6), [&](ProxyPair, S) {
          fuse.burn();
          return ++pairs < 200 ? S(1e6) : S(-1);
        });
      },
      true);
}

/// Claims four threads that start at once, and throws where the fuse burns: before, between or after its tasks.
class BurningExecutor final : public Executor {
 public:
  enum class Where { before, between, after };

  explicit BurningExecutor(Where where) : where_(where) {}
  Fuse fuse{0};

  unsigned concurrency() const override { return 4; }
  std::uint32_t start_nanoseconds() override { return 0; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    if (where_ == Where::before) fuse.burn();
    for (std::size_t i = 0; i < count; ++i) {
      if (where_ == Where::between && i == count / 2) fuse.burn();
      task(i);
    }
    if (where_ == Where::after) fuse.burn();
  }

 private:
  Where where_;
};

/// So many that every phase of an update runs on threads.
Boxes<float> crowd() {
  Boxes<float> boxes(9000);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0, 22);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = place(random);
      box.max[d] = box.min[d] + 1;
    }
  return boxes;
}

// All boxes drift and tremble, some leave, and now and then some stay where they are.
TEST(Executors, ThrowAtEachCallOfAnUpdate) {
  for (const auto where :
       {BurningExecutor::Where::before, BurningExecutor::Where::between, BurningExecutor::Where::after})
    for (const auto mode : {detail::SearchMode::all, detail::SearchMode::probe, detail::SearchMode::candidates}) {
      SCOPED_TRACE("mode " + std::to_string(int(mode)) + ", where " + std::to_string(int(where)));
      BurningExecutor executor(where);
      WatchedWorld<float> watched(mode, WorldOptions{&executor});
      auto boxes = crowd();
      watched.create(boxes);
      std::size_t thrown = 0;
      for (std::size_t frame = 0; frame < (sanitized ? 6 : 12); ++frame) {
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
          if (frame % 5 == 4 && i % 9 != 0) continue;
          const float step = i % 50 == 0 ? 0.7f : 0.02f + 0.001f * static_cast<float>((i + frame) % 7);
          for (float* bound : {&boxes[i].min[0], &boxes[i].max[0]}) *bound += step;
          watched.move(i, boxes[i]);
        }
        executor.fuse = Fuse(1 + frame / 2 % 3);
        try {
          watched.update();
        } catch (const Thrown&) {
          ++thrown;
          watched.update();
        }
        if (HasFailure()) return;
      }
      EXPECT_GE(thrown, 4u) << "hardly anything was put to the test";
    }
}

}  // namespace
}  // namespace boxstream::tests
