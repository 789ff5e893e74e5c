// SPDX-License-Identifier: MIT
// Frame by frame, the events and pairs of all ranks together are those of one machine's World.
#include <cstdint>
#include <string>
#include <vector>

#include "world_frames.hpp"

namespace boxstream::mpi_test {
namespace {

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
