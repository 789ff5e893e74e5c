// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "suites/suites.hpp"
#include "users/fcl_user.hpp"

namespace boxstream::bench {

namespace {

/// Small worlds are measured several at a time.
constexpr std::size_t enough_things = 200;
/// Of each kind in turn, so that it finds its memory as warm as in a program of its own.
constexpr int frames_in_block = 4;
/// Small worlds get more rounds than the option says.
constexpr int most_rounds = 100;
constexpr std::size_t few_things = 300;

std::vector<FclUserCase> cases() {
  std::vector<FclUserCase> all = fcl_robot_cases();
  for (FclUserCase& one : fcl_body_cases()) all.push_back(std::move(one));
  for (FclUserCase& one : fcl_crowd_cases()) all.push_back(std::move(one));
  return all;
}

/// Ours, and those of FCL that leave nothing to the callback.
std::vector<FclManagerKind> choose_kinds(const Options& options) {
  std::vector<FclManagerKind> kinds = fcl_manager_kinds();
  std::erase_if(kinds, [&](const FclManagerKind& kind) {
    return kind.candidates || kind.lists_all || (kind.name != "ours" && !options.wants_peer(kind.name));
  });
  return kinds;
}

/// The worlds of one case, and the managers of each kind in them.
class UserContest {
 public:
  UserContest(const FclUserCase& of, std::size_t n, const Options& options) : case_(of), n_(n), options_(options) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, enough_things / (n + of.others)); ++i)
      worlds_.push_back(of.make(of, n, options.seed + 1000 * i));
  }

  /// Milliseconds of a frame of one world.
  double enter(const FclManagerKind& kind) {
    runners_.push_back({&kind, {}, {}, {}});
    for (const auto& world : worlds_) {
      world->go_to(0);
      runners_.back().uses.push_back(world->open(kind));
    }
    return run_block(runners_.back(), 0);
  }

  void run_rounds() {
    const Elapsed elapsed;
    int first_frame = 0;
    const auto take_rounds = [&](const measure::Interleaving& rules) {
      measure::interleave(
          runners_.size(), rules, measure::Order::forwards, [&](int) { first_frame += frames_in_block; },
          [&](int, std::size_t i) { runners_[i].ms.push_back(run_block(runners_[i], first_frame)); });
    };
    take_rounds(options_.interleaving);
    measure::Interleaving more = options_.interleaving;
    more.repeats = most_rounds - options_.interleaving.repeats;
    more.budget_seconds = (options_.quick ? 0.4 : 2) - elapsed.seconds();
    if (more.budget_seconds > 0) take_rounds(more);
    for (Runner& runner : runners_) check(runner);
  }

  void report(Report& report) const {
    const Runner& ours = runners_.front();
    for (std::size_t i = 1; i < runners_.size(); ++i) {
      const Runner& peer = runners_[i];
      Row row = row_of(peer.kind->name);
      row.set_peer(summarize(peer.ms));
      row.known_difference =
          peer.kind->name == "fcl-ssap" ? "asks twice about some pairs that are near" : peer.kind->known_difference;
      row.pairs_equal = ours.found == peer.found;
      row.note = fmt::format("callbacks: ours {}, peer {}", ours.found.calls, peer.found.calls);
      report.add(std::move(row));
    }
  }

  void report_skipped(const std::string& peer, const std::string& why, Report& report) const {
    Row row = row_of(peer);
    row.skipped = why;
    report.add(std::move(row));
  }

 private:
  struct Runner {
    const FclManagerKind* kind;
    std::vector<std::unique_ptr<FclUse>> uses;  // one a world
    std::vector<double> ms;
    FclFindings found;
  };

  /// Frames from `first` on; the milliseconds of one, of one world.
  double run_block(Runner& runner, int first) {
    double ms = 0;
    FclFindings ignored;
    for (int frame = first; frame < first + frames_in_block; ++frame) {
      for (const auto& world : worlds_) world->go_to(frame);
      ms += time_once([&] {
        for (const auto& use : runner.uses) {
          FclAsked asked{ignored};
          use->run(asked);
        }
      });
    }
    return ms / frames_in_block / static_cast<double>(worlds_.size());
  }

  /// Frames of their own, with callbacks that remember.
  void check(Runner& runner) {
    for (int frame = 10000; frame < 10002; ++frame)
      for (std::size_t i = 0; i < worlds_.size(); ++i) {
        worlds_[i]->go_to(frame);
        FclAsked asked{runner.found};
        asked.names_pairs = true;
        runner.uses[i]->run(asked);
      }
  }

  Row row_of(const std::string& peer) const {
    const Runner& ours = runners_.front();
    Row row{.suite = "users", .case_name = std::string(case_.name), .n = n_, .peer = peer, .k = ours.found.hits};
    row.set_ours(summarize(ours.ms));
    return row;
  }

  const FclUserCase& case_;
  std::size_t n_;
  const Options& options_;
  std::vector<std::unique_ptr<FclUser>> worlds_;
  std::vector<Runner> runners_;  // after the worlds, whose things they know; ours is the first
};

/// Some take time by the square of n, or more.
double predicted_seconds(const FclUserCase& of, std::size_t n, const FclManagerKind& kind, const Options& options) {
  if (n <= few_things) return 0;
  const std::size_t fewer = n / 10;
  const double ms = fewer > few_things ? 1000 * predicted_seconds(of, fewer, kind, options) : 0;
  if (ms > 1000 * options.limit_seconds) return ms / 1000;
  return 0.1 * UserContest(of, fewer, options).enter(kind);
}

bool is_sweep(const FclManagerKind& kind) {
  return kind.name == "fcl-ssap" || kind.name == "fcl-sap";
}

/// Why a kind takes no part; empty if it does.
std::string why_not(const FclUserCase& of, std::size_t n, const FclManagerKind& kind, const Options& options) {
  if (kind.name == "ours") return {};
  if (n < of.sets_limit_from && is_sweep(kind)) return "would never end";
  if (of.trees_alone && kind.name.substr(0, 8) != "fcl-tree") return "of trees alone";
  const double seconds = predicted_seconds(of, n, kind, options);
  return seconds > options.limit_seconds ? fmt::format("over limit, {:.2g} s a frame or more predicted", seconds) : "";
}

void run_case(const FclUserCase& of, std::size_t n, const std::vector<FclManagerKind>& kinds, const Options& options,
              Report& report, Progress& progress) {
  UserContest contest(of, n, options);
  std::vector<std::pair<std::string, std::string>> skipped;
  for (const FclManagerKind& kind : kinds) {
    progress.show(fmt::format("users {} n={}: {}", of.name, n, kind.name));
    const std::string reason = why_not(of, n, kind, options);
    if (reason.empty())
      contest.enter(kind);
    else
      skipped.push_back({kind.name, reason});
  }
  contest.run_rounds();
  progress.clear();
  contest.report(report);
  for (const auto& [peer, why] : skipped) contest.report_skipped(peer, why, report);
}

}  // namespace

void run_fcl_users(const Options& options, Report& report, Progress& progress) {
  const std::vector<FclManagerKind> kinds = choose_kinds(options);
  for (const FclUserCase& of : cases()) {
    if (!options.wants_case(std::string(of.name))) continue;
    std::vector<std::size_t> sizes = options.sizes.empty() ? of.sizes : options.sizes;
    if (options.sizes.empty() && options.quick) sizes = {of.sizes.begin() + 1, of.sizes.end() - 1};
    for (const std::size_t n : sizes) run_case(of, n, kinds, options, report, progress);
  }
}

std::vector<CaseText> fcl_user_texts() {
  return texts_of(cases());
}

}  // namespace boxstream::bench
