// SPDX-License-Identifier: MIT
// Few boxes that move in their rooms, and disturbances, beside a World that searches all boxes in each update.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "world/core.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Rooms : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Rooms, Scalars);

bool operator==(ProxyPair x, ProxyPair y) {
  return x.a == y.a && x.b == y.b;
}
bool are_equal(Span<const ProxyPair> x, Span<const ProxyPair> y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](ProxyPair p, ProxyPair q) { return p == q; });
}

/// Two Worlds that are told the same, and must say the same, also to their filters.
template <class S>
class Twins {
 public:
  using Box = BasicAabb<S>;

  explicit Twins(bool sticky) : world_(options(sticky)), plain_(options(sticky), detail::SearchMode::all) {}

  template <class Call>
  auto both(Call&& call) {
    call(plain_);
    return call(world_);
  }
  void update(unsigned refuse) {
    std::vector<ProxyPair> asked[2];
    const auto update_one = [&](auto& world, std::vector<ProxyPair>& questions) {
      world.update([&](ProxyId a, ProxyId b) {
        questions.push_back({a, b});
        return (a.slot + b.slot) % 5 >= refuse;
      });
    };
    update_one(world_, asked[0]);
    update_one(plain_, asked[1]);
    EXPECT_TRUE(are_equal(asked[0], asked[1]));
    EXPECT_TRUE(are_equal(world_.begun(), plain_.begun()));
    EXPECT_TRUE(are_equal(world_.ended(), plain_.ended()));
    EXPECT_EQ(world_.pair_count(), plain_.pair_count());
    updates_in_rooms_ += world_.rooms() != 0;
  }
  detail::WorldCore<S>& world() { return world_; }
  int updates_in_rooms() const { return updates_in_rooms_; }

 private:
  static WorldOptions options(bool sticky) {
    WorldOptions options;
    options.sticky_filters = sticky;
    return options;
  }

  detail::WorldCore<S> world_, plain_;
  int updates_in_rooms_ = 0;
};

template <class S>
int play(unsigned seed, int boxes, int movers) {
  std::mt19937 random(seed);
  const auto number = [&](double least, double most) {
    return static_cast<S>(std::uniform_real_distribution<double>(least, most)(random));
  };
  const auto pick = [&](std::size_t n) { return random() % n; };
  const double side = 1.6 * std::cbrt(boxes);
  const auto somewhere = [&] {
    const S x = number(0, side), y = number(0, side), z = number(0, side);
    return BasicAabb<S>{{x, y, z}, {x + number(0.2, 1.5), y + number(0.2, 1.5), z + number(0.2, 1.5)}};
  };
  const unsigned refuse = seed % 3 == 0 ? 1 : 0;
  Twins<S> twins(seed % 2 == 1);
  std::vector<ProxyId> ids;
  std::vector<BasicAabb<S>> at;
  const auto create = [&] {
    at.push_back(somewhere());
    const Filter filter = pick(4) == 0 ? Filter{3, 4} : Filter{3, ~0u};  // the former are refused by all
    ids.push_back(twins.both([&](auto& world) { return world.create(at.back(), filter); }));
  };
  for (int i = 0; i < boxes; ++i) create();
  twins.update(refuse);
  double steps[8][3] = {};
  for (int frame = 0; frame < 500; ++frame) {
    if (frame % 40 == 0)
      for (auto& step : steps)
        for (double& along : step) along = static_cast<double>(number(-0.02, 0.02));
    for (int i = 0; i < movers; ++i) {
      auto& box = at[std::size_t(i)];
      for (int d = 0; d < 3; ++d) {
        box.min[d] += static_cast<S>(steps[i][d]);
        box.max[d] += static_cast<S>(steps[i][d]);
      }
      if (pick(60) == 0) box = somewhere();
      twins.both([&](auto& world) { return world.move(ids[std::size_t(i)], box); });
    }
    const std::size_t other = pick(ids.size()), another = pick(ids.size());
    switch (pick(40)) {
      case 0:
        at[other] = somewhere();
        twins.both([&](auto& world) { return world.move(ids[other], at[other]); });
        break;
      case 1:
        twins.both([&](auto& world) { return world.set_filter(ids[other], {1, 3}); });
        break;
      case 2:
        twins.both([&](auto& world) { return world.destroy(ids[other]); });
        break;
      case 3:
        create();
        break;
      case 4:
        twins.both([&](auto& world) { return world.release(ids[0], ids[other]); });
        break;
      case 5:
        twins.both([&](auto& world) { return world.refilter(ids[other]); });
        break;
      case 6:
        twins.both([&](auto& world) {
          // Without sticky filters a pair that they refuse ends in an update of all sooner than in others.
          const bool alone = seed % 2 == 1;
          world.begin_pairs_of(
              ids[frame % 2 == 0 ? 0 : other], [](ProxyId, ProxyId) { return true; }, [](ProxyPair) {}, alone);
          return 0;
        });
        break;
      case 7:
        twins.both([&](auto& world) {
          world.shrink_to_fit();
          return 0;
        });
        break;
      case 8:
        at[0].max[0] = at[0].min[0] - 1;  // mended by the next leap
        twins.both([&](auto& world) { return world.move(ids[0], at[0]); });
        break;
      case 9:
        twins.both([&](auto& world) {
          int found = 0;
          world.query_box(at[other], [&](ProxyId) { return ++found > 0; });
          return found;
        });
        break;
      default:
        twins.both([&](auto& world) { return world.contains(ids[another]); });
    }
    twins.update(refuse);
    if (frame % 16 == 0) {
      EXPECT_NO_THROW(twins.world().validate());
    }
    if (::testing::Test::HasFailure()) break;
  }
  return twins.updates_in_rooms();
}

TYPED_TEST(Rooms, ChangeNothingThatShows) {
  int in_rooms = 0, updates = 0;
  for (unsigned seed = 0; seed < 24 && !this->HasFailure(); ++seed)
    for (const int boxes : {12, 150, 240, 600})
      for (const int movers : {1, 2, 7}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", boxes " + std::to_string(boxes) + ", movers " +
                     std::to_string(movers));
        in_rooms += play<TypeParam>(seed, boxes, movers);
        updates += 500;
      }
  EXPECT_GT(20 * in_rooms, updates) << "hardly any room is ever there";
}

/// Both bounds of each number: a box that goes on touching, and one that stays apart, up to the last step.
TYPED_TEST(Rooms, EndWhereAPairBeginsOrEnds) {
  using S = TypeParam;
  for (int d = 0; d < 3; ++d)
    for (const bool from_below : {false, true}) {
      Twins<S> twins(false);
      const auto box_at = [&](S at) {
        BasicAabb<S> box{{0, 0, 0}, {1, 1, 1}};
        box.min[d] = from_below ? at : -1 - at;
        box.max[d] = box.min[d] + 1;
        return box;
      };
      std::vector<ProxyId> ids;
      for (const S at : {S(0), S(0.75), S(2.5)})
        ids.push_back(twins.both([&](auto& world) { return world.create(box_at(at)); }));
      for (int step = 0; step < 130; ++step) {
        const S at = S(0.5) + S(step) / 128;  // ends with the first at 1, begins with the last at 1.5
        twins.both([&](auto& world) { return world.move(ids[1], box_at(at)); });
        twins.update(0);
      }
      EXPECT_GT(twins.updates_in_rooms(), 60);
      EXPECT_EQ(twins.world().pair_count(), 1u);
    }
}

/// A pair that is released, held or refused, begins at the next update, so that no room can promise that nothing will.
TEST(Rooms, AreNotLentWhileAPairIsReleased) {
  World world;
  const auto at = [](float x) { return Aabb{{x, 0, 0}, {x + 1, 1, 1}}; };
  const ProxyId still = world.create(at(0)), mover = world.create(at(0.5f));
  const ProxyId refused = world.create(at(7)), other = world.create(at(7.5f));
  world.update([&](ProxyId a, ProxyId) { return a != refused; });
  Aabb outer, inner;
  const auto tremble_until_lent = [&] {
    for (int step = 0; step < 100; ++step) {
      world.move(mover, at(step % 2 == 0 ? 0.5f : 0.51f));
      world.update();
      if (world.room(mover, outer, inner)) return true;
    }
    return false;
  };
  ASSERT_TRUE(tremble_until_lent());
  ASSERT_TRUE(world.release(still, mover));
  EXPECT_FALSE(world.room(mover, outer, inner));
  EXPECT_EQ(world.update().begun, 1u);
  ASSERT_TRUE(tremble_until_lent());
  EXPECT_FALSE(world.release(refused, other));
  EXPECT_FALSE(world.room(mover, outer, inner));
  EXPECT_EQ(world.update().begun, 1u);
  EXPECT_TRUE(tremble_until_lent());
}

}  // namespace
}  // namespace boxstream::tests
