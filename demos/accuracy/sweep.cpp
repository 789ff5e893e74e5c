// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/nearest_word.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "measure/clock.hpp"
#include "measure/interleave.hpp"
#include "reference_run.hpp"
#include "run_and_sample.hpp"
#include "simulation/run/simulation.hpp"
#include "timed.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Scene;
using scenes::Simulation;

/// The scene of one setting, ready to run.
struct Candidate {
  Row row;
  Scene scene;
  Source source{};  ///< if it runs elsewhere
};

Scene scene_of(const Request& request, const nlohmann::json& document) {
  const Scene scene = scenes::parse_scene(document.dump(), request.file);
  return request.scale == 1 ? scene : scenes::scaled(scene, request.scale);
}

/// Where all settings start; nothing if that is where the scene's file has bodies.
std::vector<Place> start_of(const Request& request, nlohmann::json document) {
  if (!request.settling) return {};
  document.merge_patch(request.settling->change);
  return places_at_rest(here(scene_of(request, document)), request.broadphase, request.settling->steps);
}

/// The scene with its bodies at their start.
Scene started(const Request& request, const nlohmann::json& document, const std::vector<Place>& start) {
  const Scene scene = scene_of(request, document);
  return start.empty() ? scene : placed(scene, start);
}

/// Exact solvers do not iterate, nor do joints of multibodies: of what is sought, one such setting is enough.
bool is_repetition(const Request& request, const Scene& scene, const Scene& plain) {
  using Kind = scenes::SolverKind;
  const bool iterates = scene.solver.kind == Kind::sequential_impulses || scene.solver.kind == Kind::nncg;
  return request.seek && !iterates && scene.solver.iterations != plain.solver.iterations;
}

/// Where settings are sought, knobs that seldom help are turned one at a time, with the last knob alone.
bool is_rare_alone(const Request& request, const Setting& setting, const nlohmann::json& document, const Scene& plain) {
  const auto is_turned = [&](std::size_t k) { return !is_own(document, plain, {request.knobs[k]}, {setting[k]}); };
  std::size_t rare = 0, all = 0;
  for (std::size_t k = 0; k + 1 < setting.size(); ++k)
    if (is_turned(k)) ++all, rare += request.knobs[k].is_rare ? 1 : 0;
  return rare == 0 || all == 1;
}

bool is_wanted(const Request& request, const Setting& setting) {
  double product = 1;
  for (const nlohmann::json& value : setting) product *= value.is_number() ? value.get<double>() : 1;
  return product <= request.most_product;
}

double time_of(const Request& request, const Candidate& candidate) {
  if (!is_for_elsewhere(candidate.scene)) return timed(candidate.scene, request.broadphase, candidate.row.steps);
  return time_elsewhere(request, candidate.source, candidate.scene, candidate.row.steps);
}

/// Outputs would write files, and what was expected speaks of the scene as it is.
nlohmann::json bare(nlohmann::json document) {
  for (const char* key : {"outputs", "expect"}) document.erase(key);
  return document;
}

/// Checks speak of the whole run of the scene as it is: steps of another length come at other numbers. What the
/// broad-phase misses is no matter of accuracy, and takes another search in each step.
void adapt_checks(const Request& request, const Scene& plain, Scene& scene) {
  const bool whole = (request.steps == 0 || request.steps == static_cast<std::uint64_t>(plain.time.steps)) &&
                     request.scale == 1 && !request.settling;
  std::erase_if(scene.checks, [&](const scenes::Check& check) {
    return !whole || check.metric == scenes::Check::Metric::missed_pairs;
  });
  for (scenes::Check& check : scene.checks)
    check.at = static_cast<std::uint64_t>(std::llround(static_cast<double>(check.at) * plain.time.dt / scene.time.dt));
}

/// Of a run with any setting.
double seconds_of(const Request& request, const Scene& plain) {
  const auto steps = request.steps == 0 ? static_cast<std::uint64_t>(plain.time.steps) : request.steps;
  return static_cast<double>(steps) * plain.time.dt;
}

std::uint64_t steps_in(double seconds, const Scene& scene, const std::string& label, bool exactly) {
  const double steps = seconds / scene.time.dt;
  const double whole = std::max(1.0, std::round(steps));
  if (exactly && std::abs(steps - whole) > 1e-6 * whole)
    throw BadKnob(label + ": the " + std::to_string(seconds) +
                  " s of a run are no whole number of its steps, so places at the end cannot be compared");
  return static_cast<std::uint64_t>(whole);
}

/// Among all objects, by name or number.
std::optional<std::size_t> body_of(const Request& request, const Scene& scene) {
  if (request.body_name.empty()) return std::nullopt;
  const std::vector<scenes::Body> bodies = scenes::expand(scene).bodies;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == request.body_name || std::to_string(i) == request.body_name) return i;
    if (!bodies[i].name.empty()) names.push_back(bodies[i].name);
  }
  throw BadKnob(unknown_word("body", request.body_name, names) + " (names of the scene, or numbers from 0 to " +
                std::to_string(bodies.size() - 1) + ")");
}

/// Among all joints, by number or by the names of its bodies: "a,b"; "a" where it is the only one of `a`.
std::optional<std::size_t> joint_of(const Request& request, const Scene& scene) {
  const std::string& wanted = request.joint_name;
  if (wanted.empty()) return std::nullopt;
  const scenes::Expanded expanded = scenes::expand(scene);
  const auto name = [&](std::size_t body) {
    return expanded.bodies[body].name.empty() ? std::to_string(body) : expanded.bodies[body].name;
  };
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < expanded.joints.size(); ++i) {
    if (std::to_string(i) == wanted) return i;
    const scenes::Joint& joint = expanded.joints[i];
    const std::string a = name(joint.a), b = joint.b ? name(*joint.b) : "world";
    if (wanted == a + "," + b || wanted == b + "," + a) return i;
    if (wanted != a && wanted != b) continue;
    if (found) throw BadKnob("--joint " + wanted + ": it has several; name both bodies: " + a + "," + b);
    found = i;
  }
  if (!found)
    throw BadKnob("--joint " + wanted + ": there is none; the scene has " + std::to_string(expanded.joints.size()) +
                  ", named by number from 0 or by their bodies: a,b or a,world");
  return found;
}

void check_bodies(const Request& request) {
  const bool wanted =
      !request.truth.points.empty() || std::any_of(request.measures.begin(), request.measures.end(), is_of_body);
  if (wanted && !request.body) throw BadKnob("a measure of one body needs its name: --body NAME");
}

/// Runs are counted and timed for those who wait.
class Runs {
 public:
  Runs(const Request& request, const Progress& progress) : request_(request), progress_(progress) {}

  void next(const std::string& what, double seconds_left = NAN) {
    const double most = std::max(0.0, request_.budget - seconds());
    const bool is_bounded = std::isnan(seconds_left) && std::isfinite(most);
    progress_({done_++, all, seconds_left,
               is_bounded ? what + ", at most " + std::to_string(std::lround(most)) + " s left" : what});
  }
  bool is_over() const { return is_stopped() || elapsed_.seconds() > request_.budget; }
  bool is_stopped() const { return request_.stop && request_.stop(); }
  double seconds() const { return elapsed_.seconds(); }

  std::size_t all = 0;

 private:
  const Request& request_;
  const Progress& progress_;
  std::size_t done_ = 0;
  measure::Elapsed elapsed_;
};

/// Substeps of a step of the plain scene.
double fineness(const Scene& scene, const Scene& plain) {
  return static_cast<double>(scene.time.substeps) * plain.time.dt / scene.time.dt;
}

bool wants_reference(const Measure& measure) {
  return needs_reference(measure) || better(measure) == Better::as_reference;
}

double work_of(const Candidate& candidate) {
  return static_cast<double>(candidate.row.steps) * candidate.scene.time.substeps;
}

/// Of a substep, beside others: iterations are a part of it.
double cost_of_substep(const Scene& scene) {
  const bool iterates =
      scene.solver.kind == scenes::SolverKind::sequential_impulses || scene.solver.kind == scenes::SolverKind::nncg;
  const double of_numbers = scene.solver.precision == scenes::Precision::doubled ? 1.3 : 1;
  return of_numbers * (1 + (iterates ? 0.03 * scene.solver.iterations : 0.5));
}

/// What a setting is expected to cost, beside others.
double expected_cost(const Candidate& candidate) {
  return work_of(candidate) * cost_of_substep(candidate.scene);
}

/// Shares of the budget: of the run of the scene as it is, where others are sought that may cost ten times as much; of
/// runs of all settings.
constexpr double share_of_own = 0.1, share_of_runs = 0.4;
/// A run that is looked at after each step takes longer than a plain one.
constexpr double times_plain = 1.5;

/// How many steps of the scene the budget allows, of `steps`; `runs` is what all runs cost beside one of the scene. By
/// running it: later steps may take several times as long as the first ones.
std::uint64_t affordable(const Request& request, const Scene& plain, std::uint64_t steps, double runs) {
  const double share = request.seek ? share_of_own : share_of_runs / runs;
  Simulation simulation(here(plain), request.broadphase);
  const measure::Elapsed elapsed;
  do simulation.advance(true);
  while (simulation.steps_done() < steps && times_plain * elapsed.seconds() < share * request.budget &&
         !(request.stop && request.stop()));
  const std::uint64_t most = simulation.steps_done();
  // Steps of any usual length fit into twelve.
  return most >= steps ? steps : std::max<std::uint64_t>(most / 12 * 12, 12);
}

/// The one that falls least of those that were run, the reference among them: what one holds can stand.
const scenes::Vitals* that_stands(const Reference& reference, const std::vector<Candidate>& candidates,
                                  std::size_t sampled) {
  const scenes::Vitals* least = reference.name.empty() ? nullptr : &reference.vitals;
  for (std::size_t i = 0; i < sampled; ++i) {
    const Row& row = candidates[i].row;
    if (row.failure.empty() && (least == nullptr || row.vitals.height_loss < least->height_loss)) least = &row.vitals;
  }
  return least;
}

/// Whether rows are sound, by what is known until now.
void judge(const Request& request, const Reference& reference, std::vector<Candidate>& candidates,
           std::size_t sampled) {
  std::uint64_t least_outside = std::numeric_limits<std::uint64_t>::max();
  for (std::size_t i = 0; i < sampled; ++i) least_outside = std::min(least_outside, candidates[i].row.vitals.outside);
  scenes::Known known{least_outside};
  if (reference.stands_alike) {
    known.height = &reference.vitals;
  } else if (request.seek) {
    known.height = that_stands(reference, candidates, sampled);
    if (known.height != &reference.vitals) known.height_of = "another setting";
  }
  if (reference.loses_alike) known.energy_lost = &reference.vitals;
  for (std::size_t i = 0; i < sampled; ++i) candidates[i].row.unsound = unsound(candidates[i].row.vitals, known);
}

/// Whether it is known what stands: by a reference, or by a run in steps half as long as those of the coarsest that
/// would do.
bool is_known_what_stands(const Sweep& sweep, const std::vector<Candidate>& candidates, std::size_t sampled) {
  if (sweep.reference.stands_alike) return true;
  double coarsest = 0, finest = 0;
  for (std::size_t i = 0; i < sampled; ++i) {
    const double substeps = candidates[i].scene.time.substeps / candidates[i].scene.time.dt;
    finest = std::max(finest, substeps);
    if (candidates[i].row.may_be_advised() && (coarsest == 0 || substeps < coarsest)) coarsest = substeps;
  }
  return coarsest > 0 && finest >= 1.999 * coarsest;
}

/// Where that is not known, what falls may be what should stand.
void doubt(std::vector<Candidate>& candidates) {
  for (Candidate& each : candidates) {
    Row& row = each.row;
    if (row.may_be_advised() && row.vitals.height_loss > scenes::most_fall)
      row.unsound = "loses " + std::to_string(std::lround(100 * row.vitals.height_loss)) +
                    " % of its height, and there was no time for a finer run that says whether it should";
  }
}

/// ms of the cheapest one that is good enough; infinite: there is none yet.
double cheapest(const Request& request, const Sweep& sweep, const std::vector<Candidate>& candidates,
                std::size_t sampled) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sampled; ++i) {
    const Row& row = candidates[i].row;
    const double error = error_of(request, sweep, row, 0);
    if (row.may_be_advised() && (error <= request.seek->bound || std::isnan(error) != 0) && !std::isnan(row.ms.median))
      least = std::min(least, row.ms.median);
  }
  return least;
}

/// Knobs but for the last that are not as the scene has them.
std::size_t changes(const Setting& setting, const Setting& own) {
  std::size_t count = 0;
  for (std::size_t k = 0; k + 1 < own.size(); ++k) count += setting[k] == own[k] ? 0 : 1;
  return count;
}

/// Share of the time that is left which may go into looking for a setting.
constexpr double share_of_search = 0.7;

/// Where there is no time for all that are still to run, those are left out that change several knobs at once, and then
/// those that change any but the last: what is found is further from the cheapest, but it is found.
void leave_out(std::vector<Candidate>& candidates, std::size_t done, double seconds_of_cost, double seconds_left) {
  const Setting own = candidates.front().row.setting;
  const auto first = static_cast<std::ptrdiff_t>(done);
  const auto seconds = [&] {
    return std::accumulate(candidates.begin() + first, candidates.end(), 0.0, [&](double sum, const Candidate& each) {
      return sum + seconds_of_cost * expected_cost(each);
    });
  };
  for (std::size_t most = own.size(); most-- > 0 && seconds() > share_of_search * seconds_left;)
    candidates.erase(std::remove_if(candidates.begin() + first, candidates.end(),
                                    [&](const Candidate& each) { return changes(each.row.setting, own) > most; }),
                     candidates.end());
}

/// Runs and samples candidates; those that were not run are gone: when the request said stop, or what was sought is
/// found.
void sample(const Request& request, const Sweep& sweep, std::vector<Candidate>& candidates, Runs& runs) {
  double work_left = 0, seconds_of_work = NAN, ms_of_cost = NAN;
  for (const Candidate& c : candidates) work_left += work_of(c);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    const bool found = request.seek && is_known_what_stands(sweep, candidates, i) &&
                       ms_of_cost * expected_cost(candidate) > 1.3 * cheapest(request, sweep, candidates, i);
    // What is sought ends with the budget, in the middle of a run too.
    Request bounded = request;
    if (request.seek && i > 0) bounded.stop = [&] { return runs.is_over(); };
    if (found || (bounded.stop && bounded.stop())) {
      candidates.resize(i);
      return;
    }
    runs.next(candidate.row.label, seconds_of_work * work_left);
    const double start = runs.seconds();
    const bool is_done =
        is_for_elsewhere(candidate.scene)
            ? sample_elsewhere(request, candidate.source, candidate.scene, sweep.reference, candidate.row, nullptr,
                               request.seek && i > 0 ? request.budget - runs.seconds() : HUGE_VAL)
            : run_and_sample(bounded, candidate.scene, sweep.reference, candidate.row);
    if (!is_done) {
      candidates.resize(i);
      return;
    }
    seconds_of_work = (runs.seconds() - start) / work_of(candidate);
    work_left -= work_of(candidate);
    ms_of_cost = std::fmin(ms_of_cost, candidate.row.ms.median / expected_cost(candidate));
    judge(request, sweep.reference, candidates, i + 1);
    if (request.seek && i == 0 && sweep.own)
      leave_out(candidates, 1, (runs.seconds() - start) / expected_cost(candidates.front()),
                request.budget - runs.seconds());
  }
}

/// What settings cost, measured as long as it is not settled.
void time(const Request& request, std::vector<Candidate>& candidates, Sweep& sweep, Runs& runs) {
  measure::Turns turns;
  turns.most = request.repeats;
  if (!std::isfinite(request.budget)) turns.narrow_enough = 0;
  // The longest turn has to fit too.
  double longest = 0;
  for (const Candidate& each : candidates) longest = std::max(longest, each.row.ms.median * sweep.seconds / 1000);
  turns.is_over = [&] { return runs.is_stopped() || runs.seconds() + longest > request.budget; };
  const measure::Costs costs = measure::interleave_with_control(
      candidates.size(), turns, [&](std::size_t i) { return time_of(request, candidates[i]); },
      [&](std::size_t i) { runs.next(candidates[i].row.label); });
  sweep.turns = costs.fewest_turns;
  sweep.control_spread = costs.control_spread;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (costs.turns_of[i] > 0) candidates[i].row.ms = costs.of[i];
}

}  // namespace

double error_of(const Request& request, const Sweep& sweep, const Row& row, std::size_t m) {
  const Measure& measure = request.measures[m];
  const double value = row.series[m].of(measure);
  if (m == 0 && request.truth.value) return std::abs(value - *request.truth.value);
  switch (better(measure)) {
    case Better::low:
      return value;
    case Better::high:
      return -value;
    case Better::near_zero:
      return std::abs(value);
    case Better::as_reference:
      return m < sweep.reference.series.size() ? std::abs(value - sweep.reference.series[m].of(measure)) : NAN;
  }
  return NAN;
}

Scene scene_with(const Request& request, const Setting& setting) {
  const nlohmann::json document = bare(request.scene);
  Scene scene = started(request, with(document, request.knobs, setting), start_of(request, document));
  const double seconds = seconds_of(request, scene_of(request, document));
  scene.time.steps = static_cast<int>(steps_in(seconds, scene, label(request.knobs, setting), false));
  return scene;
}

Sweep run(const Request& wanted, const Progress& progress) {
  Request request = wanted;
  Runs runs(request, progress);
  const nlohmann::json document = bare(request.scene);
  const std::vector<Place> start = start_of(request, document);
  const Scene plain = started(request, document, start);
  request.body = body_of(request, plain);
  request.joint = joint_of(request, plain);
  check_bodies(request);
  Sweep sweep;
  sweep.scene = plain.meta;
  sweep.seconds = seconds_of(request, plain);
  const bool by_place = std::any_of(request.measures.begin(), request.measures.end(), needs_reference);
  const bool needed = std::any_of(request.measures.begin(), request.measures.end(), wants_reference) &&
                      !(request.truth.value && !by_place);

  std::vector<Candidate> candidates;
  double finest = 1, cost_of_all = 0;
  bool any_elsewhere = false;
  for (const Setting& setting : grid(request.knobs)) {
    if (!is_wanted(request, setting)) continue;
    if (request.seek && !is_rare_alone(request, setting, document, plain)) continue;
    Candidate candidate;
    candidate.row.setting = setting;
    candidate.row.label = label(request.knobs, setting);
    const nlohmann::json turned = with(document, request.knobs, setting);
    candidate.scene = started(request, turned, start);
    if (is_for_elsewhere(candidate.scene)) {
      if (!request.elsewhere)
        throw BadKnob(
            "/solver/precision: boxstream-double, the part of this tool that has worlds of double precision, is not "
            "installed; it is built where Bullet is there in both precisions");
      candidate.source = {turned, start};
      any_elsewhere = true;
    }
    if (is_repetition(request, candidate.scene, plain)) continue;
    finest = std::max(finest, fineness(candidate.scene, plain));
    cost_of_all += fineness(candidate.scene, plain) * cost_of_substep(candidate.scene);
    if (!sweep.own && is_own(document, plain, request.knobs, setting)) sweep.own = candidates.size();
    candidates.push_back(std::move(candidate));
  }
  sweep.seconds_of_scene = sweep.seconds;
  if (request.steps == 0 && std::isfinite(request.budget)) {
    const auto steps = static_cast<std::uint64_t>(plain.time.steps);
    const double one = plain.time.substeps * cost_of_substep(plain);
    runs.all = 1;
    runs.next("how far the budget goes");
    const std::uint64_t some = affordable(request, plain, steps, std::max(1.0, cost_of_all / one));
    if (some < steps) {
      request.steps = some;
      sweep.seconds = seconds_of(request, plain);
    }
  }
  if (request.seek && sweep.own && sweep.seconds < sweep.seconds_of_scene) {
    // The beginning does not tell whether what is coarser than the scene as it is stands to the end.
    const Scene own = candidates[*sweep.own].scene;
    const double cost = own.time.substeps / own.time.dt * cost_of_substep(own);
    std::erase_if(candidates, [&](const Candidate& each) {
      return each.scene.time.substeps / each.scene.time.dt * cost_of_substep(each.scene) < cost;
    });
  }
  for (Candidate& candidate : candidates) {
    candidate.row.steps = steps_in(sweep.seconds, candidate.scene, candidate.row.label, by_place);
    // The plan of a world depends on how long it runs.
    candidate.scene.time.steps = static_cast<int>(candidate.row.steps);
    adapt_checks(request, plain, candidate.scene);
  }
  runs.all += candidates.size() + static_cast<std::size_t>(request.repeats) * (candidates.size() + 1);

  if (needed || request.compare) {
    const std::uint64_t steps = steps_in(sweep.seconds, plain, "reference", true);
    Scene scene = plain;
    adapt_checks(request, plain, scene);
    if (request.reference) {
      runs.all += 1;
      runs.next("reference");
      sweep.reference.trajectory = request.reference(plain, steps);
      sweep.reference.dt = plain.time.dt;
    } else {
      runs.all += 3;
      const auto refer = [&] {
        return run_reference(request, scene, any_elsewhere ? std::optional<Source>({document, start}) : std::nullopt,
                             steps, finest, needed, [&](const std::string& what) { runs.next(what); });
      };
      sweep.reference = refer();
      // Where there is no time for a reference of the finest settings, those are not sought.
      while (request.seek && sweep.reference.failure == takes_too_long && !runs.is_over() &&
             finest >= 2 * plain.time.substeps) {
        finest /= 2;
        std::erase_if(candidates, [&](const Candidate& each) { return fineness(each.scene, plain) > finest; });
        sweep.reference = refer();
      }
    }
  }
  if (request.seek) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return expected_cost(a) < expected_cost(b); });
    // The scene as it is comes first: what the others cost is told in its terms.
    const auto own = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& each) {
      return is_own(document, plain, request.knobs, each.row.setting);
    });
    if (own != candidates.end()) std::rotate(candidates.begin(), own, own + 1), sweep.own = 0;
  }
  sweep.all_settings = candidates.size();
  sample(request, sweep, candidates, runs);
  judge(request, sweep.reference, candidates, candidates.size());
  if (request.seek && !is_known_what_stands(sweep, candidates, candidates.size())) doubt(candidates);
  if (!candidates.empty()) time(request, candidates, sweep, runs);
  sweep.stopped = runs.is_stopped() || (candidates.size() < sweep.all_settings && !request.seek);
  for (Candidate& candidate : candidates) sweep.rows.push_back(std::move(candidate.row));
  if (sweep.own && *sweep.own >= sweep.rows.size()) sweep.own.reset();
  return sweep;
}

}  // namespace boxstream::accuracy
