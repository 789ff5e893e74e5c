// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <memory>
#include <random>
#include <utility>

#include <boxstream/bullet.hpp>

#include "engine/broadphases.hpp"
#include "pair_hash.hpp"
#include "scene/scene.hpp"
#include "simulation/pair_check.hpp"
#include "simulation/simulation.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

/// Bodies are created in the first steps of a broad-phase's life, whose cost is not that of a frame.
constexpr int warm_up_steps = 5;

/// Every so many steps each world's pairs are checked; the oracle spoils the caches, so such steps are not timed.
constexpr int check_interval = 20;

/// A world takes so many steps before the next one takes as many, and the first of them is not timed: what it finds in
/// the caches is what the other world left there, not what a program that runs one world has.
constexpr int block_steps = 4;

/// With fewer uninterrupted steps than this, medians are taken over all steps, and the rows say so.
constexpr std::size_t enough_steps = 20;

/// A stretch of a scene that is reported as a case of its own.
struct Window {
  const char* suffix;
  int begin, end;  // steps
};

struct SceneCase {
  const char* scene;
  std::vector<Window> windows;
  int quick_steps;
};

/// The pile falls for the first 250 steps and lies still in the last ones.
const SceneCase scene_cases[] = {
    {"pile", {{"", warm_up_steps, 250}, {":rest", 480, 600}}, 40},
    {"storm", {{"", warm_up_steps, 120}}, 25},
    {"terrain", {{"", warm_up_steps, 300}}, 80},
    {"wall", {{"", warm_up_steps, 300}}, 60},
    {"ragdolls", {{"", warm_up_steps, 300}}, 60},
    {"character", {{"", warm_up_steps, 300}}, 100},
    {"cloth", {{"", warm_up_steps, 300}}, 100},
    {"bullet1", {{"", warm_up_steps, 300}}, 40},
    {"bullet2", {{"", warm_up_steps, 120}}, 60},
    {"bullet3", {{"", warm_up_steps, 300}}, 40},
    {"bullet4", {{"", warm_up_steps, 300}}, 40},
    {"bullet5", {{"", warm_up_steps, 300}}, 40},
    {"bullet6", {{"", warm_up_steps, 300}}, 40},
    {"bullet7", {{"", warm_up_steps, 300}}, 40},
    {"bullet8", {{"", warm_up_steps, 300}}, 40},
};

/// What a step's time went into. `sum` and `whole` are what is compared; the others add up to `whole`.
enum Part : std::size_t { update, pairs, dispatch, solve, rest, sum, whole, rays, parts };

using PartTimes = std::array<double, parts>;

/// One scene on one broad-phase, with what its steps took. Worlds of the same scene drift apart, because the order of
/// pairs decides the order of constraints: so each is held against its own oracle, not against another world.
class TimedWorld {
 public:
  TimedWorld(const scenes::Scene& scene, const std::string& broadphase) : simulation_(scene, broadphase) {
    simulation_.set_after_pairs([this] {
      if (check_this_step_ && difference_.empty()) difference_ = scenes::check_pairs(simulation_);
    });
  }

  void step(bool check) {
    check_this_step_ = check;
    scenes::StepOptions nothing_extra;
    nothing_extra.events = nothing_extra.exact_pairs = nothing_extra.hash = false;
    const InterruptionWatch watch;
    const scenes::StepResult result = simulation_.step(nothing_extra);
    interrupted_ = watch.interrupted();
    pairs_ = result.pairs;
    times_[Part::update] = result.update_aabbs_ms;
    times_[Part::pairs] = result.overlapping_pairs_ms;
    times_[Part::dispatch] = result.dispatch_ms;
    times_[Part::solve] = result.solve_ms;
    times_[Part::sum] = result.broadphase_ms + result.dispatch_ms;
    times_[Part::whole] = result.step_ms;
    times_[Part::rest] = result.step_ms - times_[Part::sum] - result.solve_ms;
    times_[Part::rays] = result.queries_ms;
  }

  /// Of the last step.
  bool interrupted() const { return interrupted_; }
  const PartTimes& times() const { return times_; }
  std::uint64_t pairs() const { return pairs_; }

  std::size_t objects() const { return simulation_.objects().size(); }
  bool casts_rays() const { return !simulation_.scene().queries.empty(); }
  const std::string& name() const { return simulation_.broadphase_name(); }
  const std::string& difference() const { return difference_; }

 private:
  scenes::Simulation simulation_;
  bool check_this_step_ = false;
  bool interrupted_ = false;
  std::string difference_;
  std::uint64_t pairs_ = 0;
  PartTimes times_{};
};

/// The same step of all worlds.
struct Round {
  std::vector<PartTimes> times;
  std::vector<std::uint64_t> pairs;
  bool interrupted = false;
  bool counts = true;  // false: checked, or the first one after another world's
};

Series series_of(const std::vector<Round>& rounds, std::size_t world, Part part) {
  std::vector<double> samples;
  for (const Round& round : rounds) samples.push_back(round.times[world][part]);
  return summarize(std::move(samples));
}

double mean_pairs(const std::vector<Round>& rounds, std::size_t world) {
  double total = 0;
  for (const Round& round : rounds) total += static_cast<double>(round.pairs[world]);
  return rounds.empty() ? 0 : total / static_cast<double>(rounds.size());
}

/// Where the time goes, and how many pairs the dispatcher is given: ours against theirs.
std::string breakdown(const std::vector<Round>& rounds, std::size_t peer) {
  std::string text;
  const std::pair<const char*, Part> named[] = {{"update", Part::update},
                                                {"pairs", Part::pairs},
                                                {"dispatch", Part::dispatch},
                                                {"solve", Part::solve},
                                                {"rest", Part::rest}};
  for (const auto& [name, part] : named)
    text += fmt::format("{} {:.3g} : {:.3g}, ", name, series_of(rounds, 0, part).median,
                        series_of(rounds, peer, part).median);
  return text + fmt::format("pairs dispatched {:.0f} : {:.0f}", mean_pairs(rounds, 0), mean_pairs(rounds, peer));
}

class SceneRun {
 public:
  SceneRun(const std::string& name, const std::string& path, std::vector<Window> windows,
           std::vector<std::string> peers)
      : name_(name), windows_(std::move(windows)) {
    const scenes::Scene scene = scenes::load_scene(path);
    peers.insert(peers.begin(), "boxstream");
    for (const std::string& broadphase : peers) worlds_.push_back(std::make_unique<TimedWorld>(scene, broadphase));
  }

  void run(Progress& progress) {
    const int steps = windows_.back().end;
    rounds_.resize(static_cast<std::size_t>(steps));
    for (int begin = 0, block = 0; begin < steps; begin += block_steps, ++block) {
      progress.show(fmt::format("bullet {}: step {} of {}", name_, begin + 1, steps));
      // Each world goes first in turn, so that none always follows the same neighbour.
      for (std::size_t i = 0; i < worlds_.size(); ++i) {
        const std::size_t world = (i + static_cast<std::size_t>(block)) % worlds_.size();
        for (int step = begin; step < std::min(begin + block_steps, steps); ++step) take(step, world, step == begin);
      }
    }
    progress.clear();
  }

  void report(Report& report) const {
    for (const auto& world : worlds_)
      if (!world->difference().empty()) fmt::print("FAIL: {} on {}: {}\n", name_, world->name(), world->difference());
    for (const Window& window : windows_) {
      std::string note;
      const std::vector<Round> rounds = usable(window, note);
      for (std::size_t peer = 1; peer < worlds_.size(); ++peer) {
        add_row(report, rounds, peer, window.suffix, Part::sum,
                breakdown(rounds, peer) + (note.empty() ? "" : "; " + note));
        add_row(report, rounds, peer, std::string(window.suffix) + ":step", Part::whole, note);
        if (worlds_[0]->casts_rays())
          add_row(report, rounds, peer, std::string(window.suffix) + ":rays", Part::rays, note);
      }
    }
  }

 private:
  void take(int step, std::size_t index, bool is_first) {
    Round& round = rounds_[static_cast<std::size_t>(step)];
    round.times.resize(worlds_.size());
    round.pairs.resize(worlds_.size());
    const bool check = step % check_interval == check_interval - 1;
    TimedWorld& world = *worlds_[index];
    world.step(check);
    round.times[index] = world.times();
    round.pairs[index] = world.pairs();
    round.interrupted = round.interrupted || world.interrupted();
    round.counts = round.counts && !check && !is_first;
  }

  std::vector<Round> usable(const Window& window, std::string& note) const {
    std::vector<Round> rounds;
    for (int step = window.begin; step < window.end; ++step)
      if (rounds_[static_cast<std::size_t>(step)].counts) rounds.push_back(rounds_[static_cast<std::size_t>(step)]);
    const auto quiet = std::count_if(rounds.begin(), rounds.end(), [](const Round& r) { return !r.interrupted; });
    if (static_cast<std::size_t>(quiet) >= std::min(enough_steps, rounds.size()))
      std::erase_if(rounds, [](const Round& r) { return r.interrupted; });
    else
      note = fmt::format("busy machine: only {} of {} steps ran uninterrupted", quiet, rounds.size());
    return rounds;
  }

  void add_row(Report& report, const std::vector<Round>& rounds, std::size_t peer, const std::string& suffix, Part part,
               std::string note) const {
    const Series ours = series_of(rounds, 0, part), theirs = series_of(rounds, peer, part);
    Row row;
    row.suite = "bullet";
    row.clock = "wall";
    row.case_name = name_ + suffix;
    row.n = worlds_[0]->objects();
    row.peer = worlds_[peer]->name();
    row.k = static_cast<std::uint64_t>(mean_pairs(rounds, 0));
    row.ours_ms = ours.median;
    row.ours_min = ours.min;
    row.peer_ms = theirs.median;
    row.peer_min = theirs.min;
    row.samples = theirs.samples;
    row.pairs_equal = worlds_[0]->difference().empty() && worlds_[peer]->difference().empty();
    row.note = std::move(note);
    report.add(std::move(row));
  }

  std::string name_;
  std::vector<Window> windows_;
  std::vector<std::unique_ptr<TimedWorld>> worlds_;
  std::vector<Round> rounds_;
};

/// A bare broad-phase, without the rest of Bullet: each box is set and the pairs are calculated. Boxes of unit size lie
/// about three pairs each, and go to and fro together with nobody.
struct BareCase {
  enum Kind {
    plain,
    refused,  ///< all but some lie in a layer, touch four others each, and are refused by a filter callback
    ghosts,   ///< every other one is a ghost object, and the cache has a ghost callback
    eager,    ///< as plain, with Eager::all
  };
  const char* name;
  double pace;  // how far a box moves in a frame, of its size
  Kind kind;
  std::vector<int> sizes;
};
const BareCase bare_cases[] = {
    {"asleep", 0, BareCase::plain, {10, 50, 250, 1000}}, {"slow", 0.01, BareCase::plain, {10, 50, 250, 1000}},
    {"fast", 0.3, BareCase::plain, {10, 50, 250, 1000}}, {"refused", 0.3, BareCase::refused, {2500, 10000}},
    {"ghosts", 0.03, BareCase::ghosts, {2000}},          {"eager", 0.03, BareCase::eager, {2000}}};
constexpr int movers_among_refused = 50;

using BareFrame = std::vector<std::pair<btVector3, btVector3>>;

/// The last frame leads back to the first.
std::vector<BareFrame> bare_frames(const BareCase& bare, int n, std::uint64_t seed) {
  const bool in_layer = bare.kind == BareCase::refused;
  std::mt19937_64 engine(seed);
  const auto random = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  const double side = in_layer ? std::floor(std::sqrt(n)) : std::cbrt(1.5 * n);
  std::vector<std::array<double, 6>> motions;
  for (int i = 0; i < n; ++i)
    motions.push_back({random(0, side), random(0, side), random(0, side), random(-1, 1), random(-1, 1), random(-1, 1)});
  if (in_layer) {
    for (int i = 0; i < movers_among_refused; ++i) motions[static_cast<std::size_t>(i)][2] = side / 2;
    for (int i = movers_among_refused; i < n; ++i)
      motions[static_cast<std::size_t>(i)] = {double(i % int(side)), double(i / int(side)), side / 2, 0, 0, 0};
  }
  constexpr int there = 32;
  std::vector<BareFrame> frames;
  for (int frame = 0; frame < 2 * there; ++frame) {
    const double way = bare.pace * (frame < there ? frame : 2 * there - frame);
    BareFrame& boxes = frames.emplace_back();
    for (const auto& m : motions) {
      const btVector3 at(btScalar(m[0] + way * m[3]), btScalar(m[1] + way * m[4]), btScalar(m[2] + way * m[5]));
      boxes.emplace_back(at, at + btVector3(1, 1, 1));
    }
  }
  return frames;
}

bool share_a_point(const std::pair<btVector3, btVector3>& a, const std::pair<btVector3, btVector3>& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.first[d] <= b.second[d] && b.first[d] <= a.second[d])) return false;
  return true;
}

class BareWorld {
 public:
  BareWorld(BareCase::Kind kind, const std::string& broadphase, const std::vector<BareFrame>& frames)
      : frames_(frames),
        moving_(kind == BareCase::refused ? movers_among_refused : frames[0].size()),
        objects_(frames[0].size()) {
    const scenes::Bounds bounds{{-100, -100, -100}, {200, 200, 200}};
    bullet::Options eager;
    eager.eager = bullet::Eager::all;
    if (kind == BareCase::eager && broadphase == "boxstream")
      broadphase_ = std::make_unique<bullet::Broadphase>(eager);
    else
      broadphase_ = scenes::make_broadphase(broadphase, bounds, frames[0].size());
    btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
    if (kind == BareCase::refused) cache.setOverlapFilterCallback(&refuse_layer_);
    if (kind == BareCase::ghosts) cache.setInternalGhostPairCallback(&tell_ghosts_);
    for (std::size_t i = 0; i < frames[0].size(); ++i) {
      const bool is_ghost = kind == BareCase::ghosts && i % 2 == 1;
      btCollisionObject& client = is_ghost ? ghosts_.emplace_back() : objects_[i];
      client.setUserIndex(static_cast<int>(i));
      proxies_.push_back(broadphase_->createProxy(frames[0][i].first, frames[0][i].second, 0, &client,
                                                  i < moving_ ? 1 : 2, 1, nullptr));
    }
  }
  ~BareWorld() {
    struct EndAll : btOverlapCallback {
      bool processOverlap(btBroadphasePair&) override { return true; }
    } end_all;
    broadphase_->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, nullptr);
    for (btBroadphaseProxy* proxy : proxies_) broadphase_->destroyProxy(proxy, nullptr);
  }
  BareWorld(const BareWorld&) = delete;
  BareWorld& operator=(const BareWorld&) = delete;

  void advance() {
    now_ = (now_ + 1) % frames_.size();
    const BareFrame& boxes = frames_[now_];
    for (std::size_t i = 0; i < moving_; ++i)
      broadphase_->setAabb(proxies_[i], boxes[i].first, boxes[i].second, nullptr);
    broadphase_->calculateOverlappingPairs(nullptr);
  }

  /// Those held whose boxes overlap.
  PairSummary exact_pairs() const {
    PairSummary summary;
    const btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
    const btBroadphasePair* const held = cache.getOverlappingPairArrayPtr();
    for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
      const auto a = index_of(held[i].m_pProxy0), b = index_of(held[i].m_pProxy1);
      if (share_a_point(frames_[now_][a], frames_[now_][b])) summary.add(a, b);
    }
    return summary;
  }

  /// Those there are.
  PairSummary expected_pairs() const {
    PairSummary summary;
    const BareFrame& boxes = frames_[now_];
    for (std::uint32_t a = 0; a < moving_; ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
        if (share_a_point(boxes[a], boxes[b])) summary.add(a, b);
    return summary;
  }

 private:
  static std::uint32_t index_of(const btBroadphaseProxy* proxy) {
    return static_cast<std::uint32_t>(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
  }

  struct RefuseLayer final : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      return (a->m_collisionFilterGroup & b->m_collisionFilterGroup & 2) == 0;
    }
  };

  const std::vector<BareFrame>& frames_;
  const std::size_t moving_;  // the first so many
  RefuseLayer refuse_layer_;
  btGhostPairCallback tell_ghosts_;
  std::vector<btCollisionObject> objects_;
  std::deque<btPairCachingGhostObject> ghosts_;
  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::vector<btBroadphaseProxy*> proxies_;
  std::size_t now_ = 0;
};

void run_bare(const BareCase& bare, int n, const Options& options, std::vector<std::string> broadphases, Report& report,
              Progress& progress) {
  const std::string name = fmt::format("bare:{}", bare.name);
  progress.show(fmt::format("bullet {}, {} boxes", name, n));
  const std::vector<BareFrame> frames = bare_frames(bare, n, options.seed);
  broadphases.insert(broadphases.begin(), "boxstream");
  std::vector<std::unique_ptr<BareWorld>> worlds;
  std::vector<bool> equal;
  std::vector<Contestant> contestants;
  for (const std::string& broadphase : broadphases) {
    BareWorld& world = *worlds.emplace_back(std::make_unique<BareWorld>(bare.kind, broadphase, frames));
    bool right = true;
    for (std::size_t frame = 0; frame < 2 * frames.size(); ++frame) {
      world.advance();
      if (frame % 8 == 7) right = right && world.exact_pairs() == world.expected_pairs();
    }
    equal.push_back(right);
    contestants.push_back({.run = [&world, &frames] {
      for (std::size_t frame = 0; frame < frames.size(); ++frame) world.advance();
    }});
  }
  const std::vector<Series> series = measure_interleaved(contestants, options.interleaving, [](int) {});
  progress.clear();
  const auto per_frame = [&](double milliseconds) { return milliseconds / static_cast<double>(frames.size()); };
  for (std::size_t peer = 1; peer < worlds.size(); ++peer) {
    Row row;
    row.suite = "bullet";
    row.case_name = name;
    row.n = static_cast<std::size_t>(n);
    row.peer = broadphases[peer];
    row.k = worlds[0]->exact_pairs().count;
    row.ours_ms = per_frame(series[0].median);
    row.ours_min = per_frame(series[0].min);
    row.peer_ms = per_frame(series[peer].median);
    row.peer_min = per_frame(series[peer].min);
    row.samples = series[peer].samples;
    row.pairs_equal = equal[0] && equal[peer];
    report.add(std::move(row));
  }
}

std::string scene_path(const std::string& name) {
  return fmt::format("{}/{}.json", BOXSTREAM_SCENES_DIR, name);
}

bool is_bare(const std::string& name) {
  return std::any_of(std::begin(bare_cases), std::end(bare_cases),
                     [&](const BareCase& bare) { return name == std::string("bare:") + bare.name; });
}

/// Scenes that are not on the list run as long as they say.
SceneCase case_of(const std::string& name) {
  for (const SceneCase& known : scene_cases)
    if (known.scene == name) return known;
  return {name.c_str(), {{"", warm_up_steps, scenes::load_scene(scene_path(name)).time.steps}}, 60};
}

void run_scene(const std::string& name, const Options& options, const std::vector<std::string>& peers, Report& report,
               Progress& progress) {
  SceneCase scene = case_of(name);
  const int steps = options.steps > 0 ? options.steps : options.quick ? scene.quick_steps : scene.windows.back().end;
  std::erase_if(scene.windows, [&](const Window& window) { return window.begin >= steps; });
  if (scene.windows.empty()) scene.windows = {{"", 0, steps}};
  scene.windows.back().end = std::min(scene.windows.back().end, steps);
  SceneRun run(name, scene_path(name), scene.windows, peers);
  run.run(progress);
  run.report(report);
}

}  // namespace

bool is_scene(const std::string& name) {
  return is_bare(name) || std::filesystem::exists(scene_path(name));
}

void run_bullet_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> peers = options.peers;
  if (peers.empty()) peers = {"dbvt", "dbvt-deferred", "sap"};
  std::vector<std::string> cases = options.cases;
  if (cases.empty()) {
    for (const SceneCase& scene : scene_cases) cases.push_back(scene.scene);
    for (const BareCase& bare : bare_cases) cases.push_back(std::string("bare:") + bare.name);
  }
  for (const std::string& name : cases) {
    if (!is_bare(name)) {
      run_scene(name, options, peers, report, progress);
      continue;
    }
    for (const BareCase& bare : bare_cases)
      for (const int n : bare.sizes)
        if (name == std::string("bare:") + bare.name) run_bare(bare, n, options, peers, report, progress);
  }
}

}  // namespace boxstream::bench
