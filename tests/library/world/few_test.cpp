// SPDX-License-Identifier: MIT
// Worlds of few proxies go another way than larger ones, and back. Nothing else about them is different.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "base/thresholds.hpp"
#include "core/box_sets.hpp"
#include "core/random.hpp"
#include "simd_targets.hpp"
#include "watched_world.hpp"
#include "world/few_rows.hpp"
#include "world/state/few_boxes.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::tests {
namespace {

constexpr auto most = static_cast<std::uint32_t>(detail::thresholds.few_proxies);

/// By what a list says, and by changes of it.
TEST(FewRows, AreThePairs) {
  for (const std::uint32_t ranks : {2u, 64u, 65u, most}) {
    detail::PairLists pairs;
    pairs.reserve_ranks(ranks);
    detail::FewRows rows;
    std::set<detail::PairKey> in;
    Random random(ranks);
    for (std::uint64_t edition = 1; edition < 20; ++edition) {
      std::set<detail::PairKey> gone, added;
      for (std::uint32_t i = 0; i < ranks; ++i) {
        const auto a = static_cast<std::uint32_t>(random.integer(0, ranks - 1));
        const auto b = static_cast<std::uint32_t>(random.integer(0, ranks - 1));
        if (a != b) (in.count(detail::pair_key(a, b)) != 0 ? gone : added).insert(detail::pair_key(a, b));
      }
      const std::vector<detail::PairKey> less(gone.begin(), gone.end()), more(added.begin(), added.end());
      std::vector<std::uint32_t> places, arrived;
      pairs.find_places(less, places);
      pairs.exchange(places, more, arrived);
      for (const auto* keys : {&less, &more})
        for (const detail::PairKey key : *keys) {
          if (in.erase(key) == 0) in.insert(key);
          if (edition % 3 != 1) rows.flip(key);  // otherwise they are made again
        }
      if (edition % 3 != 1) rows.follow(edition);
      rows.follow(pairs, edition, ranks);
      for (std::uint32_t a = 0; a < ranks; ++a)
        for (std::uint32_t b = 0; b < ranks; ++b)
          EXPECT_EQ(rows.row(a)[b / 64] >> b % 64 & 1, a == b ? 0 : in.count(detail::pair_key(a, b)));
    }
  }
}

/// Boxes that touch, that are not valid, and that reach to infinity.
template <class S>
BasicAabb<S> odd_box(Random& random) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  BasicAabb<S> box;
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<S>(random.integer(0, 6)) - 3;
    box.max[d] = box.min[d] + static_cast<S>(random.integer(0, 3));
    if (random.integer(1, 40) == 1) box.min[d] = -inf;
    if (random.integer(1, 40) == 1) box.max[d] = inf;
    if (box.min[d] == 0 && random.integer(0, 1) == 0) box.min[d] = -S(0);
    if (random.integer(1, 60) == 1) box.max[d] = std::numeric_limits<S>::quiet_NaN();
    if (random.integer(1, 60) == 1) box.max[d] = box.min[d] - 1;
  }
  return box;
}

/// What a ray meets, and where, as boxes one by one say.
template <class S>
void compare_hits(const detail::FewBoxes<S>& few, const std::vector<BasicAabb<S>>& boxes, const BasicRay<S>& ray) {
  const std::size_t size = boxes.size(), words = detail::bit_words(size);
  const detail::RaySlabs<S> slabs(ray);
  std::vector<std::uint64_t> bits(words, ~std::uint64_t{0});
  S enter[detail::FewBoxes<S>::most_lanes];
  ASSERT_EQ(few.find_hits(slabs, size, enter, bits.data()), words);
  for (std::size_t j = 0; j < 64 * words; ++j) {
    detail::BoxBlock<S> block;
    S entry[detail::BoxBlock<S>::width] = {};
    if (j < size) block.set(0, boxes[j]);
    const bool hit = j < size && (block.hit(slabs, slabs.length, entry) & 1) != 0;
    ASSERT_EQ(bits[j / 64] >> j % 64 & 1, hit) << j;
    if (hit) {
      ASSERT_EQ(enter[j], entry[0]) << j;
    }
  }
}

/// The same as boxes one by one say, whatever has been set, cut, loaded and dropped before.
template <class S>
void compare_with_each(detail::FewBoxes<S>& few, const std::vector<BasicAabb<S>>& boxes, Random& random) {
  const std::size_t size = boxes.size(), words = detail::bit_words(size);
  const auto overlap = [&](const BasicAabb<S>& a, const BasicAabb<S>& b) {
    return is_valid(a) && is_valid(b) && detail::overlap_by_keys(a, b);
  };
  ASSERT_TRUE(few.are(boxes, [&](std::uint32_t rank) { return is_valid(boxes[rank]); }));
  std::vector<std::uint64_t> rows(size * words, ~std::uint64_t{0}), bits(words, ~std::uint64_t{0});
  few.find_rows(size, rows.data());
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j)
      ASSERT_EQ(rows[i * words + j / 64] >> j % 64 & 1, overlap(boxes[i], boxes[j])) << i << ' ' << j;
    few.find_row(static_cast<std::uint32_t>(i), size, bits.data());
    for (std::size_t j = 0; j < 64 * words; ++j)
      ASSERT_EQ(bits[j / 64] >> j % 64 & 1, j < size && overlap(boxes[i], boxes[j])) << i << ' ' << j;
    if (!is_valid(boxes[i])) continue;
    ASSERT_EQ(few.find_touching(detail::BoxKeys<S>(boxes[i]), size, bits.data()), words);
    for (std::size_t j = 0; j < 64 * words; ++j)
      ASSERT_EQ(bits[j / 64] >> j % 64 & 1, j < size && overlap(boxes[i], boxes[j])) << i << ' ' << j;
  }
  for (int i = 0; i < 20; ++i) {
    BasicRay<S> ray{};
    S direction[3];
    for (int d = 0; d < 3; ++d) {
      ray.origin[d] = static_cast<S>(random.integer(0, 12)) - 6;
      direction[d] = static_cast<S>(random.integer(0, 4)) - 2;
      ray.extent_max[d] = static_cast<S>(random.integer(0, 2)) / 2;
    }
    const BasicRay<S> along = BasicRay<S>::along(ray.origin, direction, static_cast<S>(random.integer(1, 4)));
    std::copy_n(along.inverse_direction, 3, ray.inverse_direction);
    ray.length = along.length;
    compare_hits(few, boxes, ray);
  }
}

/// A box that the swept one reaches on all axes but for one, on which it ends a few roundings before or behind it.
template <class S>
BasicAabb<S> grazed_box(const BasicRay<S>& ray, Random& random) {
  BasicAabb<S> box;
  for (int d = 0; d < 3; ++d) {
    const S way = ray.length / ray.inverse_direction[d];
    box.min[d] = std::min(ray.origin[d], ray.origin[d] + way) + ray.extent_min[d];
    box.max[d] = std::max(ray.origin[d], ray.origin[d] + way) + ray.extent_max[d];
  }
  const int side = random.integer(0, 2);
  const S size = std::max({std::abs(box.min[side]), std::abs(box.max[side]), S(1)});
  const S off = static_cast<S>(random.integer(-6, 6)) * std::numeric_limits<S>::epsilon() * size;
  if (random.chance(0.5)) {
    box.min[side] = box.max[side] + off;
    box.max[side] = box.min[side] + 1;
  } else {
    box.max[side] = box.min[side] + off;
    box.min[side] = box.max[side] - 1;
  }
  return box;
}

/// Near the origin and far from it.
template <class S>
void graze_a_swept_box() {
  Random random(23);
  const auto between = [&](double lo, double hi) { return static_cast<S>(random.between(lo, hi)); };
  for (int turn = 0; turn < 300; ++turn) {
    const S far = std::pow(S(10), static_cast<S>(random.integer(-1, 6)));
    S origin[3], direction[3];
    for (int d = 0; d < 3; ++d) {
      origin[d] = between(-1, 1) * far;
      direction[d] = random.chance(0.2) ? S(0) : between(-1, 1);
    }
    const S length = std::pow(S(10), static_cast<S>(random.integer(-2, 2)));
    BasicRay<S> ray = BasicRay<S>::along(origin, direction, length);
    for (int d = 0; d < 3; ++d) {
      ray.extent_min[d] = between(-1, 0);
      ray.extent_max[d] = between(0, 1);
    }
    std::vector<BasicAabb<S>> boxes;
    while (boxes.size() < 100) boxes.push_back(grazed_box(ray, random));
    detail::FewBoxes<S> few;
    few.keep(boxes, boxes.size());
    compare_hits(few, boxes, ray);
  }
}

TEST(FewBoxes, ASweptBoxIsGrazedAsByOneBox) {
  graze_a_swept_box<float>();
  graze_a_swept_box<double>();
}

/// Of the flags only inexact and denormal operand stay while the caller's code runs; to take others back takes longer
/// than to test a few boxes.
TEST(RaySlabs, RaiseNoFlagForAnOrdinaryRay) {
  for (const float slope : {1.0F, 0.3F, 0.1F, 1e-3F, 1e-9F}) {
    const float origin[3] = {1, 2, 3}, direction[3] = {1, -slope, slope * slope};
    const auto ray = BasicRay<float>::along(origin, direction, 9);
    std::feclearexcept(FE_ALL_EXCEPT);
    const detail::RaySlabs<float> slabs(ray);
    EXPECT_EQ(std::fetestexcept(FE_OVERFLOW | FE_UNDERFLOW | FE_INVALID | FE_DIVBYZERO), 0) << slope;
    EXPECT_FALSE(slabs.hits_nothing || slabs.is_long[0] || slabs.is_long[1] || slabs.is_long[2]);
  }
}

template <class S>
void follow_changes() {
  Random random(11);
  detail::FewBoxes<S> few;
  std::vector<BasicAabb<S>> boxes;
  const auto set = [&](std::size_t i) {
    const auto rank = static_cast<std::uint32_t>(i);
    is_valid(boxes[i]) ? few.set(rank, detail::BoxKeys<S>(boxes[i])) : few.set_inert(rank);
  };
  for (const std::size_t size : {1u, 7u, 8u, 9u, 17u, 63u, 64u, 65u, most - 1, most}) {
    while (boxes.size() < size) {
      few.keep(boxes, boxes.size() + 1);
      boxes.push_back(odd_box<S>(random));
      set(boxes.size() - 1);
    }
    compare_with_each(few, boxes, random);
    const auto first = static_cast<std::size_t>(random.integer(0, size - 1));
    const auto end = first + static_cast<std::size_t>(random.integer(0, size - first));
    for (std::size_t i = first; i < end; ++i) boxes[i] = odd_box<S>(random);
    few.load(boxes, first, end);
    compare_with_each(few, boxes, random);
    boxes.resize(size - size / 4);
    few.cut(boxes.size());
    compare_with_each(few, boxes, random);
    few.shrink_to_fit(boxes);
    compare_with_each(few, boxes, random);
    few.drop();
    EXPECT_FALSE(few.is_kept());
    few.keep(boxes, boxes.size());
    compare_with_each(few, boxes, random);
  }
}

using FewBoxesOn = EachSimdTarget;
TEST_P(FewBoxesOn, FollowChanges) {
  follow_changes<float>();
  follow_changes<double>();
}

INSTANTIATE_TEST_SUITE_P(Targets, FewBoxesOn, testing::ValuesIn(simd_targets()), simd_target_name);

/// Where some come and go, their places are given up before these make proxies many.
TEST(FewProxiesTable, PlacesOfThoseThatAreGoneDoNotMakeProxiesMany) {
  detail::ProxyTable<float> table;
  const auto add = [&] {
    if (table.needs_compaction() || table.crowds_few(1)) {
      table.reserve_to_compact();
      table.compact([](std::uint32_t) { return false; });
    }
    table.reserve(1);
    return table.create({{0, 0, 0}, {1, 1, 1}}, {}, 0);
  };
  const std::size_t lasting = most - most / 8 - 1;
  for (std::size_t i = 0; i < lasting; ++i) add();
  for (std::size_t i = 0; i < 3 * most; ++i) {
    const ProxyId id = add();
    table.settle();
    table.destroy(table.rank(id));
    ASSERT_TRUE(table.few().is_kept()) << i;
  }
  EXPECT_EQ(table.live(), lasting);
  while (table.live() <= most) add();
  EXPECT_FALSE(table.few().is_kept());
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
    for (std::uint32_t i = 0; i < 4; ++i) more.push_back(world.create(away(i)));
    world.update(refuse_first);  // most are dirty, not those two
    EXPECT_EQ(asked, 3u);
    world.destroy(more);
    more.clear();
    world.update(refuse_first);
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
