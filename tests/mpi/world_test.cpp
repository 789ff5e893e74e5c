// SPDX-License-Identifier: MIT
// Frame by frame, the events and pairs of all ranks together are those of one machine's World.
#include <boxstream/world.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/box_sets.hpp"
#include "shares.hpp"

namespace boxstream::mpi_test {
namespace {

using WidePairs = std::vector<WidePair>;

WidePairs sorted(WidePairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

WidePairs all_of(Span<const WidePair> own) {
  WidePairs all;
  for (const auto& pairs : from_all(WidePairs(own.begin(), own.end())))
    all.insert(all.end(), pairs.begin(), pairs.end());
  return sorted(std::move(all));
}

/// On one machine. Boxes that are away are not in it.
template <class S>
class Reference {
 public:
  void update(const std::map<std::uint64_t, BasicAabb<S>>& boxes) {
    for (auto i = proxies_.begin(); i != proxies_.end();)
      i = boxes.count(i->first) == 0 ? (world_.destroy(i->second), proxies_.erase(i)) : std::next(i);
    for (const auto& [id, box] : boxes) {
      const auto found = proxies_.find(id);
      if (found == proxies_.end())
        proxies_[id] = world_.create(box, {}, id);
      else
        world_.move(found->second, box);
    }
    world_.update();
    const WidePairs before = pairs_;
    pairs_.clear();
    world_.for_each_pair([&](ProxyPair pair) {
      const auto [a, b] = std::minmax({world_.user(pair.a), world_.user(pair.b)});
      pairs_.push_back({a, b});
      return true;
    });
    pairs_ = sorted(std::move(pairs_));
    begun = without(pairs_, before);
    ended = without(before, pairs_);
  }

  const WidePairs& pairs() const { return pairs_; }
  WidePairs begun, ended;

 private:
  static WidePairs without(const WidePairs& these, const WidePairs& those) {
    WidePairs left;
    std::set_difference(these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(left));
    return left;
  }

  boxstream::BasicWorld<S> world_;
  std::map<std::uint64_t, ProxyId> proxies_;
  WidePairs pairs_;
};

/// Boxes that all ranks make in the same way, and each gives its share of.
template <class S>
class Frames {
 public:
  explicit Frames(std::uint64_t seed) : random_(seed) {
    const auto boxes = tests::box_set<S>("dense").make(300, seed);
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[id_of(i)] = boxes[i];
  }

  const std::map<std::uint64_t, BasicAabb<S>>& boxes() const { return boxes_; }
  std::mt19937_64& random() { return random_; }
  auto& any() { return *std::next(boxes_.begin(), static_cast<std::ptrdiff_t>(random_() % boxes_.size())); }
  S up_to(S most) { return most * static_cast<S>(random_() % 1001) / 1000; }

  void tremble(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) shift(any().second, up_to(2) - 1, up_to(2) - 1, up_to(2) - 1);
  }
  void drift(S step) {
    for (auto& [id, box] : boxes_) shift(box, step * static_cast<S>(id >> 40), 0, 0);
  }
  void teleport(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) std::swap(any().second, any().second);
  }
  void grow(std::size_t count) {
    constexpr S inf = std::numeric_limits<S>::infinity();
    for (std::size_t i = 0; i < count; ++i) any().second.max[random_() % 3] = inf;
  }
  void spoil(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) any().second.min[1] = std::numeric_limits<S>::quiet_NaN();
  }
  void come_and_go(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const BasicAabb<S> box = any().second;
      boxes_.erase(any().first);
      boxes_[id_of(1000 + random_() % 100)] = box;
    }
  }
  void gather() {
    for (auto& [id, box] : boxes_) box = {{0, 0, 0}, {1, 1, 1}};
  }
  void scatter() {
    for (auto& [id, box] : boxes_) {
      box = {{0, 0, 0}, {1, 1, 1}};
      shift(box, up_to(9), up_to(9), up_to(9));
    }
  }

 private:
  static void shift(BasicAabb<S>& box, S x, S y, S z) {
    const S by[] = {x, y, z};
    for (int d = 0; d < 3; ++d) {
      box.min[d] += by[d];
      box.max[d] += by[d];
    }
  }

  std::map<std::uint64_t, BasicAabb<S>> boxes_;
  std::mt19937_64 random_;
};

template <class S>
class Worlds : public testing::Test {
 protected:
  mpi::WorldStats update(bool shuffled = false) {
    Boxes<S> boxes;
    std::vector<std::uint64_t> ids;
    for (const auto& [id, box] : frames.boxes())
      if (static_cast<int>((id >> 40) % static_cast<std::uint64_t>(size())) == rank()) {
        boxes.push_back(box);
        ids.push_back(id);
      }
    if (shuffled) {
      std::reverse(boxes.begin(), boxes.end());
      std::reverse(ids.begin(), ids.end());
    }
    return world.update(boxes, ids);
  }

  void expect_truth(const std::string& what) {
    if (HasFailure()) return;
    WidePairs own;
    world.for_each_pair([&](WidePair pair) {
      own.push_back(pair);
      return true;
    });
    reference.update(frames.boxes());
    EXPECT_TRUE(all_of(world.begun()) == reference.begun) << what;
    EXPECT_TRUE(all_of(world.ended()) == reference.ended) << what;
    EXPECT_TRUE(all_of(own) == reference.pairs()) << what;
  }

  static bool HasFailure() {
    int failed = testing::Test::HasFailure() ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return failed != 0;
  }

  Frames<S> frames{1};
  mpi::BasicWorld<S> world{MPI_COMM_WORLD};
  Reference<S> reference;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Worlds, Scalars);

TYPED_TEST(Worlds, HaveTheEventsOfOneMachine) {
  std::size_t divided = 0;
  for (int frame = 0; frame < 60; ++frame) {
    if (frame % 3 != 0) this->frames.tremble(40);
    if (frame % 5 == 2) this->frames.teleport(30);
    if (frame % 7 == 3) this->frames.come_and_go(10);
    if (frame % 11 == 4) this->frames.grow(5);
    if (frame % 13 == 5) this->frames.spoil(5);
    if (frame > 30 && frame < 40) this->frames.drift(TypeParam(0.05));
    if (frame == 45) this->frames.gather();
    if (frame == 47) this->frames.scatter();
    divided += this->update(frame % 4 == 1).divided ? 1 : 0;
    this->expect_truth("frame " + std::to_string(frame));
  }
  EXPECT_GE(divided, size() > 1 ? 2u : 1u);
}

TYPED_TEST(Worlds, SendNothingWhereNothingMoves) {
  this->update();
  const mpi::WorldStats still = this->update();
  EXPECT_EQ(still.changed + still.received + still.bytes_sent + still.messages_sent + still.begun + still.ended, 0u);
  EXPECT_GT(still.held, 0u);
  EXPECT_FALSE(still.divided);
  this->update(true);  // in another order
  EXPECT_TRUE(this->world.begun().empty());
}

TYPED_TEST(Worlds, SendWhatHasChangedToThoseWhomItConcerns) {
  this->update();
  auto& [id, box] = this->frames.any();
  box.max[0] += TypeParam(0.25);
  const mpi::WorldStats stats = this->update();
  const bool gives = static_cast<int>((id >> 40) % static_cast<std::uint64_t>(size())) == rank();
  EXPECT_EQ(stats.changed, gives ? 1u : 0u);
  EXPECT_EQ(stats.bytes_sent == 0, stats.messages_sent == 0);
  EXPECT_TRUE(gives || stats.bytes_sent == 0);
}

TYPED_TEST(Worlds, BeginAnewAfterAnErrorOfAnyRank) {
  this->update();
  const std::vector<std::uint64_t> one{1};
  const Boxes<TypeParam> none;
  EXPECT_THROW(this->world.update(none, Span<const std::uint64_t>(one).subspan(0, rank() == size() - 1 ? 1 : 0)),
               mpi::Error);
  EXPECT_TRUE(this->world.begun().empty());
  this->update();
  this->expect_truth("after the error");
}

}  // namespace
}  // namespace boxstream::mpi_test
