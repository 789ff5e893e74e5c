// SPDX-License-Identifier: MIT
// Orders in which pairs are delivered and contacts solved.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <btBulletDynamicsCommon.h>
#include <boxstream/bullet/low_first.hpp>

#include "accuracy/monitor.hpp"
#include "experiment_kinds/kinds.hpp"
#include "experiment_kinds/simulated.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/random.hpp"
#include "pair_orders/ordered.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using scenes::Scene;
using scenes::Simulation;

struct Candidate {
  std::string series, setting;
  std::string broadphase = "boxstream";
  std::optional<PairOrder> pairs, contacts;
  bool deterministic = false;  ///< Bullet's own option
  bool low_first = false;      ///< the adapter's solver
};

/// A scene, run for `before` steps before anything is measured.
struct Subject {
  std::string panel;
  Scene scene;
  int before = 0;
  std::uint64_t seeds = 1;
};

/// A world in which nothing sleeps, so that contacts are solved in every step.
class Run {
 public:
  Run(const Subject& subject, const Candidate& candidate, std::uint64_t seed = 0)
      : gravity_(scenes::vector(subject.scene.world.gravity)),
        solver_(solver_of(candidate)),
        simulation_(seeded(subject.scene, seed), candidate.broadphase, wrap_of(candidate)) {
    btDynamicsWorld& world = simulation_.world();
    world.setConstraintSolver(solver_.get());
    world.getDispatchInfo().m_deterministicOverlappingPairs = candidate.deterministic;
    for (btCollisionObject* object : simulation_.objects())
      if (!object->isStaticOrKinematicObject()) object->forceActivationState(DISABLE_DEACTIVATION);
    for (int step = 0; step < subject.before; ++step) simulation_.advance();
  }

  Simulation& simulation() { return simulation_; }

 private:
  static Scene seeded(Scene scene, std::uint64_t seed) {
    scene.world.seed += seed;
    return scene;
  }
  Simulation::Wrap wrap_of(const Candidate& candidate) const {
    if (!candidate.pairs) return {};
    return [&, order = *candidate.pairs](auto) { return make_ordered_pairs(order, gravity_); };
  }

  std::unique_ptr<btConstraintSolver> solver_of(const Candidate& candidate) const {
    if (candidate.low_first) return std::make_unique<bullet::LowFirst<>>(-gravity_);
    if (!candidate.contacts) return std::make_unique<btSequentialImpulseConstraintSolver>();
    return std::make_unique<OrderedSolver>(PairSorter(*candidate.contacts, gravity_));
  }

  btVector3 gravity_;
  std::unique_ptr<btConstraintSolver> solver_;
  Simulation simulation_;
};

/// Of all contact points of all measured steps.
struct Seen {
  double mean_square = 0;  ///< m^2, of depths
  double deepest = 0;      ///< m, 95 of 100 steps stay below
  double contacts = 0;     ///< in a step
  double energy_gain = 0;  ///< J, in these steps
};

Seen run_and_sample(const Subject& subject, const Candidate& candidate, std::uint64_t seed) {
  Run run(subject, candidate, seed);
  accuracy::Depths all;
  std::vector<double> deepest;
  const auto energy = [&] { return run.simulation().metric(scenes::Check::Metric::energy); };
  const double energy_before = energy();
  for (int step = 0; step < subject.scene.time.steps; ++step) {
    run.simulation().advance();
    const accuracy::Depths now = accuracy::contact_depths(run.simulation());
    all.sum_of_squares += now.sum_of_squares;
    all.count += now.count;
    deepest.push_back(now.deepest);
  }
  return {all.mean_square(), measure::quantile(deepest, 0.95), all.count / subject.scene.time.steps,
          energy() - energy_before};
}

Seen run_and_sample(const Subject& subject, const Candidate& candidate) {
  Seen mean;
  const auto part = 1 / static_cast<double>(subject.seeds);
  for (std::uint64_t seed = 0; seed < subject.seeds; ++seed) {
    const Seen seen = run_and_sample(subject, candidate, seed);
    mean.mean_square += part * seen.mean_square;
    mean.deepest += part * seen.deepest;
    mean.contacts += part * seen.contacts;
    mean.energy_gain += part * seen.energy_gain;
  }
  return mean;
}

Candidate candidate_of(const std::string& series, const std::string& setting) {
  Candidate candidate;
  candidate.series = series;
  candidate.setting = setting;
  const bool dbvt = setting.find("btDbvt") != std::string::npos;
  if (dbvt) candidate.broadphase = "dbvt";
  if (setting.find("deterministic") == 0)
    candidate.deterministic = true;
  else if (series == "solver" && setting == "low first")
    candidate.low_first = true;
  else if (series == "solver")
    candidate.contacts = parse_order(setting);
  else if (!dbvt && setting != "ids")  // these are boxstream's
    candidate.pairs = parse_order(setting);
  return candidate;
}

std::vector<Candidate> candidates_of(const json& settings) {
  std::vector<Candidate> candidates;
  for (const char* series : {"pairs", "solver"})
    for (const json& setting : settings.at(series))
      candidates.push_back(candidate_of(series, setting.get<std::string>()));
  return candidates;
}

/// Bodies are numbered as they are created: for scenes without joints, whose bodies come from the ground up.
void create(Scene& scene, const std::string& how) {
  scenes::Expanded expanded = scenes::expand(scene);
  scene.shapes = std::move(expanded.shapes);
  scene.bodies = std::move(expanded.bodies);
  scene.generators.clear();
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  if (how == "from the top") return;
  if (how != "in any order") throw std::invalid_argument("no order of creation \"" + how + "\"");
  scenes::Random random(1);
  for (std::size_t i = scene.bodies.size(); i > 1; --i)
    std::swap(scene.bodies[i - 1], scene.bodies[static_cast<std::size_t>(random.below(i))]);
}

std::vector<Subject> subjects_of(const json& scenes) {
  std::vector<Subject> subjects;
  for (const json& item : scenes) {
    Subject subject;
    subject.scene = scenes::load_scene(item.at("scene").get<std::string>());
    if (item.contains("scale")) subject.scene = scenes::scaled(subject.scene, item["scale"].get<double>());
    subject.scene.checks.clear();
    subject.scene.time.warmup_steps = 0;
    subject.scene.time.steps = item.at("steps").get<int>();
    subject.before = item.value("before", 0);
    subject.seeds = item.value("seeds", std::uint64_t{1});
    subject.panel = subject.scene.meta.name;
    if (item.contains("created")) {
      const std::string how = item["created"].get<std::string>();
      create(subject.scene, how);
      subject.panel += ", " + how;
    }
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

/// The range of arbitrary orders: differences within it are noise.
struct Noise {
  double least, middle, most;
};

Noise noise_of(const Subject& subject, int orders) {
  std::vector<double> depths;
  for (int i = 0; i < orders; ++i) {
    Candidate candidate;
    candidate.contacts = PairOrder{PairOrder::By::random, static_cast<std::uint64_t>(i)};
    depths.push_back(std::sqrt(run_and_sample(subject, candidate).mean_square));
  }
  return {measure::quantile(depths, 0), measure::quantile(depths, 0.5), measure::quantile(depths, 1)};
}

/// The rows of a scene; costs and contacts are relative to those of the first one.
void measure_subject(const Subject& subject, const std::vector<Candidate>& candidates, Measurement& measurement) {
  measurement.progress(subject.panel + ": arbitrary orders");
  const Noise noise = noise_of(subject, measurement.settings().at("random").get<int>());
  const auto timed = [&](const Candidate& candidate) {
    measurement.progress(subject.panel + " " + candidate.setting + ": time");
    return ms_per_simulated_second(Run(subject, candidate).simulation());
  };
  double usual_contacts = NAN, usual_cost = NAN;
  measurement.add_points(
      subject.panel, candidates, timed, [&](const Candidate& candidate, const measure::Estimate& cost) {
        measurement.progress(subject.panel + " " + candidate.setting);
        const Seen seen = run_and_sample(subject, candidate);
        const double depth = std::sqrt(seen.mean_square);
        if (&candidate == &candidates.front()) {
          usual_contacts = seen.contacts;
          usual_cost = cost.median;
        }
        const double beyond_noise = depth < noise.least ? -1 : depth > noise.most ? 1 : 0;
        return Point{.series = candidate.series,
                     .setting = candidate.setting,
                     .values = {depth * 1e3, seen.deepest * 1e3, seen.contacts, seen.energy_gain, depth / noise.middle,
                                cost.median / usual_cost, seen.contacts / usual_contacts, beyond_noise, NAN, NAN}};
      });
}

double geometric_mean(const std::vector<const Point*>& points, std::size_t metric) {
  double sum = 0;
  for (const Point* point : points) sum += std::log(point->values[metric]);
  return std::exp(sum / static_cast<double>(points.size()));
}

/// One row for each candidate: the cost of all scenes together, geometric means of the ratios, and on how many scenes
/// it is beyond noise.
void add_sums(const std::string& panel, const std::vector<Candidate>& candidates, std::size_t first, Results& results) {
  std::vector<Point> sums;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<const Point*> of_scenes;
    for (std::size_t p = first + i; p < results.points.size(); p += candidates.size())
      of_scenes.push_back(&results.points[p]);
    const auto beyond = [&](double side) {
      return static_cast<double>(std::count_if(of_scenes.begin(), of_scenes.end(),
                                               [&](const Point* point) { return point->values[7] == side; }));
    };
    Point sum{.panel = panel, .series = candidates[i].series, .setting = candidates[i].setting};
    for (const Point* point : of_scenes)
      for (double measure::Estimate::*value :
           {&measure::Estimate::median, &measure::Estimate::low, &measure::Estimate::high, &measure::Estimate::least})
        sum.cost.*value += point->cost.*value;
    sum.values = {NAN, NAN, NAN, NAN};
    for (std::size_t metric = 4; metric < 7; ++metric) sum.values.push_back(geometric_mean(of_scenes, metric));
    sum.values.insert(sum.values.end(), {NAN, beyond(-1), beyond(1)});
    sums.push_back(std::move(sum));
  }
  results.points.insert(results.points.end(), sums.begin(), sums.end());
}

}  // namespace

void measure_orders(Measurement& measurement) {
  const std::vector<Candidate> candidates = candidates_of(measurement.settings());
  for (const json& group : measurement.settings().at("groups")) {
    const std::size_t first = measurement.results.points.size();
    const std::string name = group.at("name").get<std::string>();
    std::vector<Subject> subjects = subjects_of(group.at("scenes"));
    for (Subject& subject : subjects) {
      subject.panel = name + ": " + subject.panel;
      measure_subject(subject, candidates, measurement);
    }
    add_sums(name + ": all", candidates, first, measurement.results);
  }
}

}  // namespace boxstream::report
