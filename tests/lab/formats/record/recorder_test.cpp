// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <sstream>

#include "formats/record/expected_pairs.hpp"
#include "formats/record/op.hpp"
#include "formats/record/recorder.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/names.hpp"
#include "scenes/shipped.hpp"
#include "scenes/small_scene.hpp"
#include "simulation/engine/broadphases.hpp"
#include "simulation/run/simulation.hpp"
#include "streams.hpp"

namespace boxstream::record_test {
namespace {

using namespace record;
using scenes::Simulation;

struct Recording {
  Bytes bytes;
  std::uint64_t state_hash = 0;
};

Recording record_scene(const scenes::Scene& scene, const std::string& broadphase, int steps) {
  std::ostringstream out;
  Header header;
  for (std::size_t d = 0; d < 3; ++d) {
    header.bounds.min[d] = scene.world.bounds.min[d];
    header.bounds.max[d] = scene.world.bounds.max[d];
  }
  Writer writer(out, header);
  Recording recording;
  Simulation simulation(scene, broadphase, [&](std::unique_ptr<btBroadphaseInterface> inner) {
    return std::make_unique<Recorder>(std::move(inner), writer);
  });
  for (int i = 0; i < steps; ++i) recording.state_hash = simulation.step().state_hash;
  writer.finish();
  const std::string text = out.str();
  recording.bytes.assign(text.begin(), text.end());
  return recording;
}

std::uint64_t state_hash(const scenes::Scene& scene, const std::string& broadphase, int steps) {
  Simulation simulation(scene, broadphase);
  std::uint64_t hash = 0;
  for (int i = 0; i < steps; ++i) hash = simulation.step().state_hash;
  return hash;
}

class Scenes : public testing::TestWithParam<scenes_test::Shipped> {};

TEST_P(Scenes, ReplayWithEqualPairsOnEveryBroadphase) {
  const scenes::Scene scene = scenes_test::reduced(GetParam());
  const int steps = std::max(10, scenes_test::steps_of(GetParam()) / 3);
  const Recording on_boxstream = record_scene(scene, "boxstream", steps);
  EXPECT_EQ(on_boxstream.state_hash, state_hash(scene, "boxstream", steps)) << "recording shows in the world";
  const Census census = census_of(on_boxstream.bytes);
  EXPECT_EQ(census.batches, static_cast<std::uint64_t>(steps * scene.time.substeps));
  EXPECT_EQ(census.destroyed, 0u) << "the world's end is in the recording";
  EXPECT_GT(census.moves, 0u);
  const ReplayResult result = replay_on(on_boxstream.bytes, scenes::broadphase_names());
  EXPECT_FALSE(result.difference) << describe(*result.difference, Scalar::float32);
  EXPECT_EQ(result.batches, census.batches);
  // Run short, some scenes have not come to their first pair.
  if (scenes_test::slowness == 1) {
    EXPECT_GT(result.pairs, 0u);
  }
  EXPECT_EQ(difference_on(record_scene(scene, "dbvt", steps).bytes, {"boxstream"}), "");
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(scenes_test::shipped_scenes),
                         [](const auto& test) { return test.param.name; });

TEST(Recorder, HasWhatASceneWithEverythingCalls) {
  const scenes::Scene scene = scenes::parse_scene(scenes_test::small_scene, "small");
  for (const std::string& name : scenes::broadphase_names()) {
    const Recording recording = record_scene(scene, name, 30);
    const Census census = census_of(recording.bytes);
    Simulation simulation(scene, name);
    EXPECT_EQ(census.created, simulation.objects().size());
    EXPECT_GE(census.ray_queries, 8u * 30u) << "eight rays a step, beside those of the character";
    EXPECT_EQ(difference_on(recording.bytes, {"boxstream", "dbvt", "sap"}), "") << "recorded on " << name;
  }
}

/// Makes the calls of a stream to a recorder, as a program would, and says what it should have written.
class Program {
 public:
  explicit Program(const std::string& broadphase) : writer_(out_, {}), recorder_(make(broadphase), writer_) {}
  ~Program() {
    for (btBroadphaseProxy* const proxy : proxies_)
      if (proxy != nullptr) recorder_.destroyProxy(proxy, nullptr);
  }

  std::vector<Op> play(const std::vector<Op>& ops) {
    for (const Op& op : ops) std::visit(*this, op);
    writer_.finish();
    const std::string text = out_.str();
    return read({text.begin(), text.end()});
  }

  void operator()(const Create& op) {
    proxies_.push_back(
        recorder_.createProxy(vector(op.box.min), vector(op.box.max), op.shape, this, op.group, op.mask, nullptr));
  }
  void operator()(const Move& op) {
    recorder_.setAabb(proxies_[op.id], vector(op.box.min), vector(op.box.max), nullptr);
  }
  void operator()(const Destroy& op) { recorder_.destroyProxy(std::exchange(proxies_[op.id], nullptr), nullptr); }
  void operator()(const Refilter& op) {
    proxies_[op.id]->m_collisionFilterGroup = op.group;
    proxies_[op.id]->m_collisionFilterMask = op.mask;
  }
  void operator()(const BoxQuery& op) {
    struct Ignore final : btBroadphaseAabbCallback {
      bool process(const btBroadphaseProxy*) override { return true; }
    } ignore;
    recorder_.aabbTest(vector(op.box.min), vector(op.box.max), ignore);
  }
  void operator()(const RayQuery& op) {
    struct Ignore final : btBroadphaseRayCallback {
      bool process(const btBroadphaseProxy*) override { return true; }
    } ignore;
    ignore.m_rayDirectionInverse = vector(op.inverse_direction);
    for (int d = 0; d < 3; ++d) ignore.m_signs[d] = ignore.m_rayDirectionInverse[d] < 0;
    ignore.m_lambda_max = static_cast<btScalar>(op.length);
    recorder_.rayTest(vector(op.from), vector(op.to), ignore, vector(op.extent_min), vector(op.extent_max));
  }
  void operator()(const Batch&) { recorder_.calculateOverlappingPairs(nullptr); }
  void operator()(const ResetPool&) { recorder_.resetPool(nullptr); }

 private:
  static btVector3 vector(const double (&v)[3]) {
    return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2]));
  }

  std::ostringstream out_;
  Writer writer_;
  Recorder recorder_;
  std::vector<btBroadphaseProxy*> proxies_;
};

/// What is expected after each batch, as the search finds it from calls in the order in which they come out.
PairDigest expected_digest(ExpectedPairs& search, const Op& op) {
  search.apply(op);
  return std::holds_alternative<Batch>(op) ? digest_of(search.pairs()) : PairDigest{};
}

/// Refilters come out later than they went in (a plain write is noticed at the next move or batch); all else as it was.
RC_GTEST_PROP(Recorder, WritesTheCallsThatWereMade, (std::uint32_t seed)) {
  const std::vector<Op> given = random_ops(seed, 250);
  const std::vector<Op> written = Program("boxstream").play(given);
  const auto is_refilter = [](const Op& op) { return std::holds_alternative<Refilter>(op); };
  // Through a file, so that moves to the same box are gone here too.
  std::vector<Op> expected = read(write(given)), found = written;
  std::erase_if(expected, is_refilter);
  std::erase_if(found, is_refilter);
  RC_ASSERT(found.size() == expected.size());
  ExpectedPairs search;
  std::size_t at = 0;
  for (const Op& op : written) {
    const PairDigest digest = expected_digest(search, op);
    if (const auto* const batch = std::get_if<Batch>(&op)) RC_ASSERT(batch->pairs == digest);
    if (is_refilter(op)) continue;
    if (!same(op, expected[at]))
      RC_FAIL(text_of(expected[at], Scalar::float32) + " was recorded as " + text_of(op, Scalar::float32));
    ++at;
  }
}

RC_GTEST_PROP(Replay, RandomStreamsOnBoxstream, (std::uint32_t seed)) {
  const ReplayResult result = replay_on(write(random_ops(seed, 400)), {"boxstream"});
  RC_PRE(result.pairs > 0);  // few streams have none; where most had none, that would fail
  RC_LOG() << (result.difference ? describe(*result.difference, Scalar::float32) : "");
  RC_ASSERT(!result.difference);
}

RC_GTEST_PROP(Replay, TameStreamsOnEveryBroadphase, (std::uint32_t seed)) {
  const ReplayResult result = replay_on(write(random_ops(seed, 400, Temper::tame)), scenes::broadphase_names());
  RC_PRE(result.pairs > 0);  // few streams have none; where most had none, that would fail
  RC_LOG() << (result.difference ? describe(*result.difference, Scalar::float32) : "");
  RC_ASSERT(!result.difference);
}

}  // namespace
}  // namespace boxstream::record_test
