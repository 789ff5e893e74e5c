// SPDX-License-Identifier: MIT
// Large worlds in which one box comes, goes or moves at a time: neither the index nor the list of pairs is made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <boxstream/splice.hpp>
#include <boxstream/world.hpp>

#include "base/thresholds.hpp"
#include "bvh/bvh.hpp"
#include "world/core.hpp"

namespace boxstream {
namespace {

using Pairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

/// Boxes of a World in order of creation, with the list of pairs followed by its changes.
class OneByOne {
 public:
  explicit OneByOne(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) create();
    update();
  }

  void create() {
    boxes.push_back(random());
    ids.push_back(world.create(boxes.back()));
  }
  void destroy(std::size_t i) {
    world.destroy(ids[i]);
    boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(i));
    ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(i));
  }
  void move(std::size_t i, const Aabb& box) {
    boxes[i] = box;
    world.move(ids[i], box);
  }
  std::size_t any() { return engine() % boxes.size(); }
  Aabb random() { return box_at({place(), place(), place()}); }
  Aabb near(const Aabb& box) { return box_at({box.min[0] + step(), box.min[1] + step(), box.min[2] + step()}); }

  void update() {
    world.update();
    splice(followed, world.changes());
    for (std::size_t i = 0; i < world.begun().size(); ++i) {
      const ProxyPair pair = world.begun()[i];
      followed[world.changes().inserted[i]] = pair;
      ASSERT_EQ(world.pair_place(pair.a, pair.b), world.changes().inserted[i]);
    }
    std::size_t at = 0;
    world.stream_pairs([&](Span<const ProxyPair> some) {
      for (const ProxyPair pair : some) {
        EXPECT_TRUE(at < followed.size() && pair.a == followed[at].a && pair.b == followed[at].b);
        ++at;
      }
      return !::testing::Test::HasFailure();
    });
    ASSERT_EQ(at, followed.size());
    ASSERT_EQ(at, world.pair_count());
  }

  /// Followed pairs are in order of creation, as these are.
  void compare_with_all() {
    std::size_t at = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (!overlaps(boxes[i], boxes[j])) continue;
        ASSERT_LT(at, followed.size());
        ASSERT_TRUE(followed[at].a == ids[i] && followed[at].b == ids[j]);
        ++at;
      }
    ASSERT_EQ(at, followed.size());
    ASSERT_NO_THROW(world.validate());
  }

  std::mt19937 engine{5};
  detail::WorldCore<float> world;
  std::vector<Aabb> boxes;
  std::vector<ProxyId> ids;
  std::vector<ProxyPair> followed;

 private:
  float place() { return static_cast<float>(engine() % 1000) / 50; }
  float step() { return static_cast<float>(engine() % 21) / 20 - 0.5f; }
  static Aabb box_at(const float (&at)[3]) { return {{at[0], at[1], at[2]}, {at[0] + 1, at[1] + 1, at[2] + 1}}; }
};

TEST(OneByOne, IsWhatAllWithAllFinds) {
  OneByOne of(1500);
  for (int frame = 0; frame < 3000; ++frame) {
    switch (of.engine() % 8) {
      case 0:
      case 1:
      case 2:
        of.destroy(of.any());
        of.create();
        break;
      case 3:
        of.create();
        break;
      case 4:
        of.destroy(of.any());
        break;
      case 5:
        of.move(of.any(), of.random());
        break;
      default:
        for (int i = 0; i < 3; ++i) {
          const std::size_t one = of.any();
          of.move(one, of.near(of.boxes[one]));
        }
    }
    if (frame % 500 == 499)
      for (std::size_t i = 0; i < of.boxes.size(); ++i) of.move(i, of.near(of.boxes[i]));
    of.update();
    if (HasFatalFailure()) FAIL() << "in frame " << frame;
    if (frame % 100 < 2) of.compare_with_all();
    if (HasFatalFailure()) FAIL() << "in frame " << frame;
  }
}

TEST(OneByOne, PairsOfEditsStayWithThem) {
  OneByOne of(1000);
  for (int frame = 0; frame < 400; ++frame) {
    of.destroy(of.any());
    of.create();
    of.update();
    if (HasFatalFailure()) FAIL() << "in frame " << frame;
    const ProxyPair pair = of.followed[of.engine() % of.followed.size()];
    ASSERT_TRUE(of.world.release(pair.a, pair.b));
    ASSERT_FALSE(of.world.pair_place(pair.a, pair.b));
    if (frame % 2 == 0) {
      ASSERT_TRUE(of.world.begin_told(pair.a, pair.b));
    } else {
      const std::uint64_t before = of.world.pair_count();
      of.world.update();
      ASSERT_EQ(of.world.begun().size(), 1u);
      ASSERT_EQ(of.world.pair_count(), before + 1);
    }
  }
  of.compare_with_all();
}

/// A box at random in place of another one, over and over: a tree that has been made with room for some takes them in.
TEST(Index, BoxesThatComeTakeThePlacesOfThoseThatLeave) {
  std::mt19937 engine(3);
  constexpr std::uint32_t count = 4000;
  std::vector<Aabb> boxes(count);
  const auto random = [&] {
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(engine() % 3000) / 100;
      box.max[d] = box.min[d] + 1;
    }
    return box;
  };
  for (Aabb& box : boxes) box = random();
  const auto box_of = [&](std::uint32_t slot) { return boxes[slot]; };
  detail::Bvh<float> index;
  index.reserve_slots(count);
  index.begin_build(true);
  while (!index.build_part(1000, box_of)) {
  }
  ASSERT_NO_THROW(index.validate(box_of));
  ASSERT_GE(7 * index.tree_blocks(), count);
  const std::size_t blocks = index.tree_blocks();
  for (int i = 0; i < 1000; ++i) {
    const auto slot = static_cast<std::uint32_t>(engine() % count);
    boxes[slot] = random();
    index.mark(slot);
    index.refresh(box_of);
    ASSERT_FALSE(index.is_worn()) << i;
    if (i % 100 == 0) {
      ASSERT_NO_THROW(index.validate(box_of));
    }
  }
  EXPECT_EQ(index.tree_blocks(), blocks);
}

}  // namespace
}  // namespace boxstream
