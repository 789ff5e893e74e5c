// SPDX-License-Identifier: MIT
// Worlds of few proxies go another way than larger ones, and back. Nothing else about them is different.
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "base/thresholds.hpp"
#include "core/box_sets.hpp"
#include "core/random.hpp"
#include "watched_world.hpp"
#include "world/few_rows.hpp"

namespace boxstream::tests {
namespace {

constexpr auto most = static_cast<std::uint32_t>(detail::thresholds.few_proxies);

TEST(FewRows, GivesPairsInOrder) {
  for (const std::uint32_t ranks : {2u, 64u, 65u, most}) {
    detail::FewRows rows(ranks);
    std::set<std::pair<std::uint32_t, std::uint32_t>> in;
    Random random(ranks);
    for (std::uint32_t i = 0; i < 4 * ranks; ++i) {
      const auto a = static_cast<std::uint32_t>(random.integer(0, ranks - 1));
      const auto b = static_cast<std::uint32_t>(random.integer(0, ranks - 1));
      if (a == b) continue;
      const auto pair = std::minmax(a, b);
      if (i % 3 == 0) {
        EXPECT_EQ(rows.take(pair.first, pair.second), in.erase(pair) != 0);
      } else {
        rows.put(pair.first, pair.second);
        in.insert(pair);
      }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
    rows.for_each([&](std::uint32_t a, std::uint32_t b) { out.push_back({a, b}); });
    EXPECT_TRUE(std::equal(in.begin(), in.end(), out.begin(), out.end()));
  }
}

template <class S>
class FewProxies : public testing::Test {
 protected:
  using Box = BasicAabb<S>;

  static Box any_box(Random& random) {
    Box box;
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<S>(random.integer(0, 12));
      box.max[d] = box.min[d] + static_cast<S>(random.integer(0, 3));
    }
    return box;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FewProxies, Scalars);

/// One box in `one_in` moves a little before each update.
template <class S>
void play(WatchedWorld<S>& watched, const std::vector<std::uint32_t>& live, Random& random, std::uint32_t one_in) {
  for (const std::uint32_t i : live) {
    if (random.integer(1, one_in) != 1) continue;
    auto box = watched.world().box(watched.id(i));
    const auto d = random.integer(0, 2);
    const S step = static_cast<S>(random.integer(-2, 2));
    box.min[d] += step;
    box.max[d] += step;
    watched.move(i, box);
  }
  watched.update();
}

TYPED_TEST(FewProxies, MayBecomeManyAndFewAgain) {
  Random random(3);
  WatchedWorld<TypeParam> watched;
  std::vector<std::uint32_t> live;
  std::uint32_t made = 0;
  const auto grow = [&](std::size_t size) {
    while (live.size() < size) {
      watched.create({this->any_box(random)});
      live.push_back(made++);
      if (live.size() % 16 == 0 || live.size() + 4 > most) play(watched, live, random, 1 + made % 5);
    }
  };
  const auto shrink = [&](std::size_t size) {
    while (live.size() > size) {
      const auto at = static_cast<std::ptrdiff_t>(random.integer(0, live.size() - 1));
      watched.destroy(live[static_cast<std::size_t>(at)]);
      live.erase(live.begin() + at);
      if (live.size() % 8 == 0) play(watched, live, random, 1 + live.size() % 5);
    }
  };
  for (int round = 0; round < 3; ++round) {
    grow(most + 8);
    for (int i = 0; i < 6; ++i) play(watched, live, random, 1);
    shrink(most / 2);
    for (int i = 0; i < 6; ++i) play(watched, live, random, i % 2 == 0 ? 1u : 40u);
  }
}

/// What has been refused is not asked about again on the way from few to many, nor on the way back.
TYPED_TEST(FewProxies, KeepRefusalsWhenTheyBecomeMany) {
  using S = TypeParam;
  for (const bool sticky : {false, true}) {
    WorldOptions options;
    options.sticky_filters = sticky;
    BasicWorld<S> world(options);
    const BasicAabb<S> crowd{{0, 0, 0}, {1, 1, 1}};
    const ProxyId a = world.create(crowd), b = world.create(crowd), c = world.create(crowd, {2, ~0u});
    std::size_t asked = 0;
    const auto refuse_first = [&](ProxyId x, ProxyId y) {
      ++asked;
      return !(x == a && y == b);
    };
    EXPECT_EQ(world.update(refuse_first).begun, 2u);
    EXPECT_EQ(asked, 3u);
    std::vector<ProxyId> more;
    const auto away = [](std::uint32_t i) -> BasicAabb<S> {
      const S x = static_cast<S>(10 + 2 * i);
      return {{x, 0, 0}, {x + 1, 1, 1}};
    };
    for (int round = 0; round < 2; ++round) {
      for (std::uint32_t i = 0; i < most; ++i) {
        more.push_back(world.create(away(i)));
        if (i > most - 6) world.update(refuse_first);
      }
      for (const ProxyId id : more) world.move(id, away(0));
      world.move(c, {{0, 0, 0}, {1, 1, round == 0 ? S(2) : S(1)}});  // a pair of it was never refused
      for (std::uint32_t i = 0; i < more.size(); ++i) world.move(more[i], away(i));
      world.update(refuse_first);
      EXPECT_EQ(asked, 3u) << "round " << round;
      EXPECT_EQ(world.pair_count(), 2u);
      world.destroy(more);
      more.clear();
      world.update(refuse_first);
    }
    EXPECT_EQ(asked, 3u);
    EXPECT_TRUE(world.release(a, b) == false);
    EXPECT_EQ(world.update(refuse_first).begun, 0u);
    EXPECT_EQ(asked, 4u);
    world.set_filter(c, {2, 0});
    EXPECT_EQ(world.update(refuse_first).ended, sticky ? 0u : 2u);
    ASSERT_NO_THROW(world.validate());
  }
}

TYPED_TEST(FewProxies, OfARunOfAnyLengthTheMovedAreFound) {
  Random random(5);
  for (const std::size_t size : {1u, 7u, 8u, 9u, 24u, 31u, 32u, 33u, 70u}) {
    WatchedWorld<TypeParam> watched;
    for (std::size_t i = 0; i < size; ++i) watched.create({this->any_box(random)});
    watched.update();
    for (const std::size_t stride : {1u, 3u, 8u}) {
      std::vector<ProxyId> ids;
      std::vector<BasicAabb<TypeParam>> boxes;
      std::uint64_t moved = 0;
      for (std::uint32_t i = 0; i < size; ++i) {
        ids.push_back(watched.id(i));
        boxes.push_back(watched.world().box(watched.id(i)));
        if (i % stride != 0) continue;
        boxes.back().max[1] += 1;
        ++moved;
      }
      EXPECT_EQ(watched.world().move(ids, boxes), size);
      for (std::uint32_t i = 0; i < size; ++i) {
        EXPECT_TRUE(watched.world().box(ids[i]) == boxes[i]);
        watched.move(i, boxes[i]);  // for the witness
      }
      EXPECT_EQ(watched.update().moved, moved);
    }
  }
}

}  // namespace
}  // namespace boxstream::tests
