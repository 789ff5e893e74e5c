// SPDX-License-Identifier: MIT
#include "users/step_contest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace boxstream::bench {

namespace {

/// How often each world's pairs are checked; the oracle spoils the caches, so those steps are not timed.
constexpr int check_interval = 20;

/// How many steps a world takes before the next one's turn. The first of them is not timed: it finds in the caches what
/// the other world left there, not what a program that runs one world has.
constexpr int block_steps = 4;

/// With fewer uninterrupted steps than this, medians are taken over all steps, and the rows say so.
constexpr std::size_t enough_steps = 20;

/// The same step of all worlds.
struct Round {
  std::vector<PartTimes> times;
  std::vector<std::uint64_t> pairs;
  bool interrupted = false;
  bool counts = true;  // false: checked, or the first one after another world's
};

class Contest {
 public:
  Contest(const StepRows& rows, std::vector<std::unique_ptr<SteppedWorld>> worlds)
      : rows_(rows), worlds_(std::move(worlds)) {}

  void run(Progress& progress);
  void report(Report& report) const;

 private:
  void take(int step, std::size_t index, bool is_first);
  std::vector<Round> usable(const Window& window, std::string& note) const;
  void add_row(Report& report, const std::vector<Round>& rounds, std::size_t peer, const std::string& suffix, Part part,
               std::string note) const;

  const StepRows& rows_;
  std::vector<std::unique_ptr<SteppedWorld>> worlds_;
  std::vector<Round> rounds_;
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

void Contest::run(Progress& progress) {
  const int steps = rows_.windows.back().end;
  rounds_.resize(static_cast<std::size_t>(steps));
  for (int begin = 0, block = 0; begin < steps; begin += block_steps, ++block) {
    progress.show(fmt::format("{} {}: step {} of {}", rows_.suite, rows_.case_name, begin + 1, steps));
    // Each world goes first in turn, so that none always follows the same neighbour.
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
      const std::size_t world = (i + static_cast<std::size_t>(block)) % worlds_.size();
      for (int step = begin; step < std::min(begin + block_steps, steps); ++step) take(step, world, step == begin);
    }
  }
  progress.clear();
}

void Contest::take(int step, std::size_t index, bool is_first) {
  Round& round = rounds_[static_cast<std::size_t>(step)];
  round.times.resize(worlds_.size());
  round.pairs.resize(worlds_.size());
  const bool check = step % check_interval == check_interval - 1;
  SteppedWorld& world = *worlds_[index];
  const InterruptionMonitor monitor;
  world.step(check);
  round.times[index] = world.times();
  round.pairs[index] = world.pairs();
  round.interrupted = round.interrupted || monitor.interrupted();
  round.counts = round.counts && !check && !is_first;
}

std::vector<Round> Contest::usable(const Window& window, std::string& note) const {
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

void Contest::report(Report& report) const {
  for (const auto& world : worlds_)
    if (!world->difference().empty())
      fmt::print("FAIL: {} on {}: {}\n", rows_.case_name, world->broadphase(), world->difference());
  for (const Window& window : rows_.windows) {
    std::string note;
    const std::vector<Round> rounds = usable(window, note);
    for (std::size_t peer = 1; peer < worlds_.size(); ++peer) {
      add_row(report, rounds, peer, window.suffix, Part::sum,
              breakdown(rounds, peer) + (note.empty() ? "" : "; " + note));
      add_row(report, rounds, peer, window.suffix + ":step", Part::whole, note);
      if (worlds_[0]->casts_rays()) add_row(report, rounds, peer, window.suffix + ":rays", Part::rays, note);
    }
  }
}

void Contest::add_row(Report& report, const std::vector<Round>& rounds, std::size_t peer, const std::string& suffix,
                      Part part, std::string note) const {
  const SteppedWorld &ours = *worlds_[0], &theirs = *worlds_[peer];
  Row row{.suite = rows_.suite,
          .case_name = rows_.case_name + suffix,
          .n = ours.objects(),
          .peer = theirs.broadphase(),
          .k = static_cast<std::uint64_t>(mean_pairs(rounds, 0)),
          .pairs_equal = ours.difference().empty() && theirs.difference().empty(),
          .note = std::move(note)};
  row.set_ours(series_of(rounds, 0, part));
  row.set_peer(series_of(rounds, peer, part));
  report.add(std::move(row));
}

}  // namespace

void contest_steps(const StepRows& rows, std::vector<std::unique_ptr<SteppedWorld>> worlds, Report& report,
                   Progress& progress) {
  Contest contest(rows, std::move(worlds));
  contest.run(progress);
  contest.report(report);
}

}  // namespace boxstream::bench
