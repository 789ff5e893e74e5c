// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "measure.hpp"
#include "measure/interleave.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {

using scenes::Scene;

namespace {

double time_of(const Request& request, const Candidate& candidate) {
  if (!is_for_elsewhere(candidate.scene)) return timed(candidate.scene, request.broadphase, candidate.row.steps);
  return time_elsewhere(request, candidate.source, candidate.scene, candidate.row.steps);
}

/// Shares of the budget: of the run of the scene as it is, where others are sought that may cost ten times as much; of
/// runs of all settings.
constexpr double share_of_own = 0.1, share_of_runs = 0.4;
/// A run that is looked at after each step takes longer than a plain one.
constexpr double times_plain = 1.5;

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

std::uint64_t affordable(const Request& request, const Scene& plain, std::uint64_t steps, double runs) {
  const double share = request.seek ? share_of_own : share_of_runs / runs;
  scenes::Simulation simulation(here(plain), request.broadphase);
  const measure::Elapsed elapsed;
  do simulation.advance(true);
  while (simulation.steps_done() < steps && times_plain * elapsed.seconds() < share * request.budget &&
         !(request.stop && request.stop()));
  const std::uint64_t most = simulation.steps_done();
  // Steps of any usual length fit into twelve.
  return most >= steps ? steps : std::max<std::uint64_t>(most / 12 * 12, 12);
}

void sample_and_time(const Request& request, std::vector<Candidate>& candidates, Sweep& sweep, Runs& runs) {
  sample(request, sweep, candidates, runs);
  judge(request, sweep.reference, candidates, candidates.size());
  if (request.seek && !is_known_what_stands(sweep, candidates, candidates.size())) doubt(candidates);
  if (!candidates.empty()) time(request, candidates, sweep, runs);
}

}  // namespace boxstream::accuracy
