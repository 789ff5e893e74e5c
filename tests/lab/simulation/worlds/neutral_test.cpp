// SPDX-License-Identifier: MIT
// What finds the pairs does not show in what bodies do: every scene, beside the same scene on a broad-phase that is
// nothing but a search among all boxes, with pairs in the same order, to the last bit.
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>

#include <boxstream/bullet.hpp>

#include "brute_force.hpp"
#include "drops_one_pair.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "scenes/shipped.hpp"
#include "simulation/run/simulation.hpp"
#include "simulation/run/state_hash.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

using namespace boxstream;
using scenes::Simulation;

struct SceneRun {
  std::string scene;
  double factor;  ///< of the number of bodies
  int steps;
};

void PrintTo(const SceneRun& run, std::ostream* out) {
  *out << run.scene;
}

constexpr int whole = 600;

/// Scenes that do not run 600 steps, even in whole runs.
const std::map<std::string, int> shorter{
    {"hard/one_point_5000", 3},  // as long as it is; brute force asks the filter for twelve million pairs in each
};

/// Scenes that run with fewer bodies than the tests of shipped scenes take, so that 600 steps take a second or two.
const std::map<std::string, double> smaller{{"bullet1", 0.1}, {"bullet6", 0.1}, {"bullet7", 0.1},
                                            {"pile", 0.03},   {"storm", 0.02},  {"hard/pyramid_1240", 0.1}};

std::vector<SceneRun> runs() {
  std::vector<SceneRun> all;
  const int steps = size_of_run(whole, tests::sanitized ? whole / 3 : whole);
  // As many objects as the tests of these scenes take, unless all is to run whole.
  for (const scenes_test::Shipped& shipped : scenes_test::shipped_scenes)
    all.push_back({shipped.name, whole_runs() ? 1 : shipped.factor, steps});
  for (const std::string folder : {"hard", "effects"})
    for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped(folder)))
      if (entry.path().extension() == ".json") all.push_back({folder + "/" + entry.path().stem().string(), 1, steps});
  for (SceneRun& run : all) {
    if (const auto known = shorter.find(run.scene); known != shorter.end())
      run.steps = std::min(run.steps, known->second);
    if (const auto known = smaller.find(run.scene); known != smaller.end() && !whole_runs()) run.factor = known->second;
  }
  std::sort(all.begin(), all.end(), [](const SceneRun& a, const SceneRun& b) { return a.scene < b.scene; });
  return all;
}

scenes::Scene scene_of(const SceneRun& run) {
  scenes::Scene scene = scenes::load_scene(scenes_test::file_of(run.scene));
  if (run.factor != 1) scene = scenes::scaled(scene, run.factor);
  scene.checks.clear();  // they look on, which takes time and changes nothing: see effects.Neutral
  return scene;
}

using Broadphase = std::unique_ptr<btBroadphaseInterface>;

Broadphase brute_force(Broadphase) {
  return std::make_unique<BruteForce>();
}

/// Brute force knows nothing of how far contacts of wide shapes reach.
Broadphase exact_boxes(Broadphase) {
  bullet::Options options;
  options.exact_boxes = true;
  return std::make_unique<bullet::Broadphase>(options);
}

using UidPair = std::pair<int, int>;

std::vector<UidPair> pairs_of(const Simulation& simulation) {
  const btOverlappingPairCache& cache = *simulation.broadphase().getOverlappingPairCache();
  std::vector<UidPair> pairs;
  for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
    const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
    pairs.emplace_back(pair.m_pProxy0->m_uniqueId, pair.m_pProxy1->m_uniqueId);
  }
  return pairs;
}

/// Where two runs part: in which step, whether in the pairs or in the state, and how.
struct Parting {
  int step = 0;  ///< 0: nowhere
  std::string text;
  std::size_t pairs_seen = 0;
};

std::string first_differing_object(const Simulation& a, const Simulation& b) {
  std::vector<float> in_a, in_b;
  for (std::size_t i = 0; i < a.objects().size(); ++i) {
    scenes::collect_state({a.objects()[i]}, in_a);
    scenes::collect_state({b.objects()[i]}, in_b);
    if (scenes::hash_of(in_a) == scenes::hash_of(in_b)) continue;
    std::ostringstream text;
    text.precision(9);
    text << "object " << i << " of " << a.objects().size() << ", at " << in_a[0] << ' ' << in_a[1] << ' ' << in_a[2]
         << " and " << in_b[0] << ' ' << in_b[1] << ' ' << in_b[2];
    return text.str();
  }
  return "no object";
}

std::string first_differing_pair(const std::vector<UidPair>& a, const std::vector<UidPair>& b) {
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  std::ostringstream text;
  text << a.size() << " and " << b.size() << " pairs; number " << x - a.begin() << " is ";
  for (const auto& [place, end] : {std::pair{x, a.end()}, std::pair{y, b.end()}})
    if (place == end)
      text << "none ";
    else
      text << place->first << '-' << place->second << ' ';
  return text.str();
}

enum class Look { at_pairs_and_state, at_state };

Parting parting(Simulation& a, Simulation& b, int steps, Look look = Look::at_pairs_and_state) {
  Parting found;
  for (int step = 1; step <= steps; ++step) {
    a.advance();
    b.advance();
    const std::vector<UidPair> in_a = pairs_of(a), in_b = pairs_of(b);
    found.pairs_seen += in_a.size();
    if (look == Look::at_pairs_and_state && in_a != in_b)
      found.text = "pairs: " + first_differing_pair(in_a, in_b);
    else if (a.state_hash() != b.state_hash())
      found.text = "state: " + first_differing_object(a, b);
    else
      continue;
    found.step = step;
    break;
  }
  return found;
}

class NeutralScene : public testing::TestWithParam<SceneRun> {};

TEST_P(NeutralScene, MovesAsWithBruteForce) {
  const scenes::Scene scene = scene_of(GetParam());
  Simulation ours(scene, "boxstream", exact_boxes), other(scene, "boxstream", brute_force);
  const std::uint64_t start = ours.state_hash();
  const Parting found = parting(ours, other, GetParam().steps);
  EXPECT_EQ(found.step, 0) << "in step " << found.step << ", boxstream and brute force: " << found.text;
  // Else it would say nothing.
  EXPECT_TRUE(found.pairs_seen > 0 || ours.state_hash() != start);
}

INSTANTIATE_TEST_SUITE_P(All, NeutralScene, testing::ValuesIn(runs()), [](const auto& test) {
  std::string name = test.param.scene;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

/// One pair, once, in one step: the comparison has to notice, in the pairs and in what bodies do.
TEST(NeutralControl, OnePairDroppedOnceIsSeen) {
  for (const SceneRun& run :
       {SceneRun{"pile", 0.03, 100}, SceneRun{"hard/stack_of_plates", 1, 100}, SceneRun{"character", 0.6, 100}}) {
    SCOPED_TRACE(run.scene);
    static constexpr int when = 60;
    const scenes::Scene scene = scene_of(run);
    const auto drop = [](Broadphase inner) -> Broadphase {
      return std::make_unique<tests::DropsOnePair>(exact_boxes(std::move(inner)), when);
    };
    for (const Look look : {Look::at_pairs_and_state, Look::at_state}) {
      Simulation faulty(scene, "boxstream", drop), other(scene, "boxstream", brute_force);
      const Parting found = parting(faulty, other, run.steps, look);
      EXPECT_EQ(found.step, when) << found.text;
      EXPECT_EQ(found.text.substr(0, 6), look == Look::at_state ? "state:" : "pairs:");
    }
  }
}

}  // namespace
}  // namespace boxstream::worlds_test
