// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "candidates.hpp"
#include "named.hpp"
#include "sampling.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Scene;

void check_bodies(const Request& request) {
  const bool wanted =
      !request.truth.points.empty() || std::any_of(request.measures.begin(), request.measures.end(), is_of_body);
  if (wanted && !request.body) throw BadKnob("a measure of one body needs its name: --body NAME");
}

bool wants_reference(const Measure& measure) {
  return needs_reference(measure) || better(measure) == Better::as_reference;
}

/// A sweep on its way.
struct Work {
  Request request;
  nlohmann::json document;
  std::vector<Place> start;
  Scene plain;  ///< the scene as it is, at its start
  bool by_place;
  Candidates candidates{};
  Sweep sweep{};

  explicit Work(const Request& wanted)
      : request(wanted),
        document(bare(wanted.scene)),
        start(start_of(wanted, document)),
        plain(started(wanted, document, start)),
        by_place(std::any_of(wanted.measures.begin(), wanted.measures.end(), needs_reference)) {
    request.body = body_of(request, plain);
    request.joint = joint_of(request, plain);
    check_bodies(request);
    sweep.scene = plain.meta;
    sweep.seconds = sweep.seconds_of_scene = seconds_of(request, plain);
    candidates = candidates_of(request, document, plain, start);
    sweep.own = candidates.own;
  }

  /// As far as the budget goes.
  void shorten(Runs& runs) {
    if (request.steps != 0 || !std::isfinite(request.budget)) return;
    const auto steps = static_cast<std::uint64_t>(plain.time.steps);
    const double one = plain.time.substeps * cost_of_substep(plain);
    runs.all = 1;
    runs.next("how far the budget goes");
    const std::uint64_t some = affordable(request, plain, steps, std::max(1.0, candidates.cost / one));
    if (some >= steps) return;
    request.steps = some;
    sweep.seconds = seconds_of(request, plain);
    if (request.seek && sweep.own) leave_out_coarser();
  }

  /// The beginning does not tell whether what is coarser than the scene as it is stands to the end.
  void leave_out_coarser() {
    const auto cost = [](const Scene& scene) { return scene.time.substeps / scene.time.dt * cost_of_substep(scene); };
    const double own = cost(candidates.all[*sweep.own].scene);
    std::erase_if(candidates.all, [&](const Candidate& each) { return cost(each.scene) < own; });
  }

  void set_steps() {
    for (Candidate& candidate : candidates.all) {
      candidate.row.steps = steps_in(sweep.seconds, candidate.scene, candidate.row.label, by_place);
      // The plan of a world depends on how long it runs.
      candidate.scene.time.steps = static_cast<int>(candidate.row.steps);
      adapt_checks(request, plain, candidate.scene);
    }
  }

  bool is_reference_needed() const {
    return std::any_of(request.measures.begin(), request.measures.end(), wants_reference) &&
           !(request.truth.value && !by_place);
  }

  void refer(Runs& runs) {
    const std::uint64_t steps = steps_in(sweep.seconds, plain, "reference", true);
    if (request.reference) {
      runs.all += 1;
      runs.next("reference");
      sweep.reference.trajectory = request.reference(plain, steps);
      sweep.reference.dt = plain.time.dt;
      return;
    }
    Scene scene = plain;
    adapt_checks(request, plain, scene);
    runs.all += 3;
    const auto run_it = [&] {
      sweep.reference = run_reference(
          request, scene, candidates.any_elsewhere ? std::optional<Source>({document, start}) : std::nullopt, steps,
          candidates.finest, is_reference_needed(), [&](const std::string& what) { runs.next(what); });
    };
    run_it();
    // Where there is no time for a reference of the finest settings, those are not sought.
    while (request.seek && sweep.reference.failure == takes_too_long && !runs.is_over() &&
           candidates.finest >= 2 * plain.time.substeps) {
      candidates.finest /= 2;
      std::erase_if(candidates.all,
                    [&](const Candidate& each) { return fineness(each.scene, plain) > candidates.finest; });
      run_it();
    }
  }

  /// The cheapest first, but for the scene as it is: what the others cost is told in its terms.
  void order() {
    std::stable_sort(candidates.all.begin(), candidates.all.end(),
                     [](const Candidate& a, const Candidate& b) { return expected_cost(a) < expected_cost(b); });
    const auto own = std::find_if(candidates.all.begin(), candidates.all.end(), [&](const Candidate& each) {
      return is_own(document, plain, request.knobs, each.row.setting);
    });
    if (own != candidates.all.end()) std::rotate(candidates.all.begin(), own, own + 1), sweep.own = 0;
  }
};

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
  Runs runs(wanted, progress);  // settling takes of the budget, too
  Work work(wanted);
  const Request& request = work.request;
  Sweep& sweep = work.sweep;
  std::vector<Candidate>& candidates = work.candidates.all;
  work.shorten(runs);
  work.set_steps();
  runs.all += candidates.size() + static_cast<std::size_t>(request.repeats) * (candidates.size() + 1);
  if (work.is_reference_needed() || request.compare) work.refer(runs);
  if (request.seek) work.order();
  sweep.all_settings = candidates.size();
  sample_and_time(request, candidates, sweep, runs);
  sweep.stopped = runs.is_stopped() || (candidates.size() < sweep.all_settings && !request.seek);
  for (Candidate& candidate : candidates) sweep.rows.push_back(std::move(candidate.row));
  if (sweep.own && *sweep.own >= sweep.rows.size()) sweep.own.reset();
  return std::move(sweep);
}

}  // namespace boxstream::accuracy
