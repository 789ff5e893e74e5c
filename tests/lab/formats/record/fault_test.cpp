// SPDX-License-Identifier: MIT
// Replay finds what it is for: broad-phases with planted faults, and recordings made on them.
#include <gtest/gtest.h>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <sstream>

#include "drops_one_pair.hpp"
#include "formats/record/expected_pairs.hpp"
#include "formats/record/recorder.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "scenes/shipped.hpp"
#include "simulation/run/simulation.hpp"
#include "streams.hpp"

namespace boxstream::record_test {
namespace {

using namespace record;
using tests::DropsOnePair;

/// Reports every proxy but the first to box queries.
class DropsOneHit final : public ForwardingBroadphase {
 public:
  using ForwardingBroadphase::ForwardingBroadphase;

  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override {
    struct AllButFirst final : btBroadphaseAabbCallback {
      explicit AllButFirst(btBroadphaseAabbCallback& given) : next(given) {}
      bool process(const btBroadphaseProxy* proxy) override {
        return std::exchange(first, false) || next.process(proxy);
      }
      btBroadphaseAabbCallback& next;
      bool first = true;
    } all_but_first(callback);
    inner().aabbTest(lo, hi, all_but_first);
  }
};

struct AcceptsAll final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

/// A scene whose boxes all move, recorded on boxstream, or on a wrapped one.
Bytes record_pile(int steps, int dropping_batch) {
  std::ostringstream out;
  Writer writer(out, {});
  scenes::Simulation simulation(scenes::scaled(scenes::load_scene(scenes_test::file_of("pile")), 0.02), "boxstream",
                                [&](std::unique_ptr<btBroadphaseInterface> inner) {
                                  auto faulty = std::make_unique<DropsOnePair>(std::move(inner), dropping_batch);
                                  return std::make_unique<Recorder>(std::move(faulty), writer);
                                });
  for (int i = 0; i < steps; ++i) simulation.step();
  writer.finish();
  const std::string text = out.str();
  return {text.begin(), text.end()};
}

std::vector<std::unique_ptr<Player>> players(std::unique_ptr<btBroadphaseInterface> faulty) {
  std::vector<std::unique_ptr<Player>> both;
  both.push_back(std::make_unique<Player>("right", make("dbvt")));
  both.push_back(std::make_unique<Player>("faulty", std::move(faulty)));
  return both;
}

/// The boxes and filters at the end of batch number `batch`.
ExpectedPairs state_at(const Bytes& bytes, std::uint64_t batch) {
  ExpectedPairs search;
  for (const Op& op : read(bytes)) {
    search.apply(op);
    if (!std::holds_alternative<Batch>(op)) continue;
    search.pairs();
    if (--batch == 0) break;
  }
  return search;
}

TEST(Fault, ADroppedPairIsFoundAtItsBatch) {
  const Bytes bytes = record_pile(120, 0);
  for (const int batch : {60, 97, 120}) {
    const auto both = players(std::make_unique<DropsOnePair>(make("boxstream"), batch));
    const ReplayResult result = replay(bytes, both);
    ASSERT_TRUE(result.difference) << "batch " << batch;
    const Difference& difference = *result.difference;
    EXPECT_EQ(difference.batch, static_cast<std::uint64_t>(batch));
    EXPECT_EQ(result.batches, difference.batch);
    EXPECT_EQ(difference.query, 0u);
    EXPECT_EQ(difference.party, "faulty");
    EXPECT_TRUE(difference.missing);
    ASSERT_EQ(difference.proxies.size(), 2u);
    ASSERT_EQ(difference.boxes.size(), 2u);
    EXPECT_LT(difference.proxies[0], difference.proxies[1]);
    EXPECT_TRUE(overlaps(difference.boxes[0], difference.boxes[1]));
    const ExpectedPairs search = state_at(bytes, difference.batch);
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(search.box(difference.proxies[static_cast<std::size_t>(i)]),
                difference.boxes[static_cast<std::size_t>(i)]);
    ASSERT_EQ(difference.counts.size(), 4u);
    const std::uint64_t owed = difference.counts[3].second;
    const std::vector<std::pair<std::string, std::uint64_t>> counts{
        {"recording", owed}, {"right", owed}, {"faulty", owed - 1}, {"search", owed}};
    EXPECT_EQ(difference.counts, counts);
    const std::string text = describe(difference, Scalar::float32);
    EXPECT_TRUE(text.starts_with("batch " + std::to_string(batch) + ": recording ")) << text;
    EXPECT_NE(text.find("; faulty lacks the pair of proxies "), std::string::npos) << text;
  }
}

TEST(Fault, APairThatFiltersForbidIsFound) {
  const Aabb64 box{{0, 0, 0}, {1, 1, 1}}, away{{9, 9, 9}, {10, 10, 10}};
  const std::vector<Op> ops{Create{0, 0, 1, -1, box}, Create{1, 0, 2, 2, away}, Batch{}, Move{1, box}, Batch{}};
  AcceptsAll accept;
  auto faulty = make("boxstream");
  faulty->getOverlappingPairCache()->setOverlapFilterCallback(&accept);
  const ReplayResult result = replay(write(ops), players(std::move(faulty)));
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(describe(*result.difference, Scalar::float32),
            "batch 2: recording 0, right 0, faulty 1, search 0; faulty has in excess the pair of proxies 0 and 1, "
            "box of 0: [0 0 0] to [1 1 1], box of 1: [0 0 0] to [1 1 1]");
}

TEST(Fault, AMissingHitIsFound) {
  const Aabb64 box{{0, 0, 0}, {1, 1, 1}}, away{{9, 9, 9}, {10, 10, 10}};
  const std::vector<Op> ops{Create{0, 0, 1, -1, box}, Batch{}, BoxQuery{away}, BoxQuery{box}, Batch{}};
  const ReplayResult result = replay(write(ops), players(std::make_unique<DropsOneHit>(make("boxstream"))));
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(describe(*result.difference, Scalar::float32),
            "batch 2, box query 2: right 1, faulty 0, search 1; faulty lacks proxy 0, box of 0: [0 0 0] to [1 1 1]");
}

TEST(Fault, ARecordingOfAFaultNamesThePair) {
  const Bytes bytes = record_pile(100, 80);
  const ReplayResult result = replay_on(bytes, {"boxstream", "dbvt"});
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->batch, 80u);
  EXPECT_EQ(result.difference->party, "recording");
  EXPECT_TRUE(result.difference->missing);
  ASSERT_EQ(result.difference->proxies.size(), 2u);
  const ExpectedPairs search = state_at(bytes, 80);
  EXPECT_TRUE(search.overlap({result.difference->proxies[0], result.difference->proxies[1]}));
}

TEST(Fault, ARecordedPairTooManyIsNamed) {
  const Aabb64 box{{0, 0, 0}, {1, 1, 1}}, away{{9, 9, 9}, {10, 10, 10}};
  const std::vector<Op> ops{Create{0, 0, 1, -1, box}, Create{1, 0, 1, -1, away}, Batch{digest_of({{0, 1}})}};
  EXPECT_EQ(difference_on(write(ops), {"boxstream"}),
            "batch 1: recording 1, boxstream 0, search 0; recording has in excess the pair of proxies 0 and 1, "
            "box of 0: [0 0 0] to [1 1 1], box of 1: [9 9 9] to [10 10 10]");
}

}  // namespace
}  // namespace boxstream::record_test
