// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "inputs/batches.hpp"
#include "suites/batch_contest.hpp"
#include "suites/fcl_works.hpp"
#include "suites/predictor.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

/// Compares our manager with FCL's, work by work, and adds a row for each of these.
class FclContest {
 public:
  /// Everything is borrowed. The first of `kinds` is ours.
  FclContest(const Options& options, const std::vector<FclManagerKind>& kinds, Report& report, Progress& progress)
      : options_(options), kinds_(kinds), report_(report), progress_(progress) {}

  void run(const std::string& batch, const FclWork& work, std::size_t n);

 private:
  struct Runner {
    const FclManagerKind* kind;
    std::vector<FclWorker> workers;  // one a cast
    std::vector<double> ms;
    int calls = 1;  // a sample
    FclAnswer last, all;
    FclAnswer checked;
  };

  FclScene make_scene(std::size_t n) const;
  std::string key_of(const FclManagerKind& kind) const;
  double trial_ms(const FclManagerKind& kind, std::size_t n) const;
  double predict_ms(const FclManagerKind& kind);
  static double run_once(Runner& runner);
  void enter(const FclManagerKind& kind, FclScene& scene);
  void run_rounds(FclScene& scene);
  Row row_of(const std::string& peer) const;
  void report_rows();
  void show(const std::string& what);

  const Options& options_;
  const std::vector<FclManagerKind>& kinds_;
  Report& report_;
  Progress& progress_;
  Predictor predictor_;

  // Of the case that runs.
  std::string batch_;
  const FclWork* work_ = nullptr;
  std::size_t n_ = 0;
  std::vector<Runner> runners_;  // ours is the first
  std::vector<Row> skipped_;
};

constexpr int warm_frames = 4;

void FclContest::show(const std::string& what) {
  progress_.show(fmt::format("fcl {}:{} n={}: {}", batch_, work_->name, n_, what));
}

FclScene FclContest::make_scene(std::size_t n) const {
  return FclScene(batch_, n, options_.seed, work_->motion, work_->one_in);
}

/// Filling and one run.
double FclContest::trial_ms(const FclManagerKind& kind, std::size_t n) const {
  FclScene scene = make_scene(n);
  FclWorker worker(kind, *work_, scene.casts().front());
  FclAnswer answer;
  double ms = time_once([&] { worker.prepare(); });
  scene.next_frame();
  ms += time_once([&] { worker.work(answer); });
  return ms;
}

std::string FclContest::key_of(const FclManagerKind& kind) const {
  return fmt::format("{}:{} {}", batch_, work_->name, kind.name);
}

double FclContest::predict_ms(const FclManagerKind& kind) {
  constexpr std::size_t few = 100, many = 2000;
  const auto casts = static_cast<double>(FclScene::casts_of(n_));
  if (n_ <= few) return trial_ms(kind, n_) * casts;
  if (n_ <= many) return trial_ms(kind, n_ / 10) * 30 * casts;
  return predictor_.predict(key_of(kind), n_, 1000 * options_.limit_seconds,
                            [&](std::size_t n) { return trial_ms(kind, n); });
}

double FclContest::run_once(Runner& runner) {
  runner.last = {};
  const double ms = time_once([&] {
    for (int call = 0; call < runner.calls; ++call)
      for (FclWorker& worker : runner.workers) worker.work(runner.last);
  });
  return ms / runner.calls;
}

void FclContest::enter(const FclManagerKind& kind, FclScene& scene) {
  show(kind.name + ", trial");
  if (kind.lists_all && work_->change != FclChange::all_moved) return;
  const bool is_ours = &kind == &kinds_.front();
  const double limit_ms = 1000 * options_.limit_seconds;
  const double predicted = predict_ms(kind);
  if (!is_ours && predicted > limit_ms) {
    Row row = row_of(kind.name);
    row.skipped = fmt::format("over limit, {:.2g} s a run or more predicted", predicted / 1000);
    skipped_.push_back(std::move(row));
    return;
  }
  Runner runner{&kind, {}, {}, 1, {}, {}, {}};
  for (FclCast& cast : scene.casts()) runner.workers.emplace_back(kind, *work_, cast);
  double ms = time_once([&] {
    for (FclWorker& worker : runner.workers) worker.prepare();
  });
  // One-time work is done now, and methods that learn from motion have seen some frames.
  double first_ms = 0;
  for (int frame = 0; frame < warm_frames && first_ms < options_.interleaving.slow_ms / 10; ++frame) {
    scene.next_frame();
    first_ms = run_once(runner);
    for (FclWorker& worker : runner.workers) worker.release();
  }
  predictor_.add(key_of(kind), n_, (ms + first_ms) / static_cast<double>(runner.workers.size()));
  if (work_->change == FclChange::none) {
    ms = run_once(runner);
    runner.calls = std::max(1, static_cast<int>(std::ceil(options_.interleaving.min_sample_ms / (ms + 1e-6))));
  }
  runners_.push_back(std::move(runner));
}

void FclContest::run_rounds(FclScene& scene) {
  const auto on_round = [&](int round) {
    show(fmt::format("round {} of {}", round + 1, options_.interleaving.repeats));
    scene.next_frame();
  };
  const auto forwards = measure::Order::forwards;
  measure::interleave(runners_.size(), options_.interleaving, forwards, on_round, [&](int, std::size_t i) {
    Runner& runner = runners_[i];
    runner.ms.push_back(run_once(runner) / static_cast<double>(runner.workers.size()));
    runner.all.calls += runner.last.calls;
    runner.all.hits += runner.last.hits / static_cast<std::uint64_t>(runner.calls);
    for (FclWorker& worker : runner.workers) worker.release();
  });
  // One more frame, whose pairs are compared.
  scene.next_frame();
  for (Runner& runner : runners_) {
    run_once(runner);
    for (FclWorker& worker : runner.workers) worker.check(runner.checked);
  }
  progress_.clear();
}

Row FclContest::row_of(const std::string& peer) const {
  return {.suite = "fcl", .case_name = fmt::format("{}:{}", batch_, work_->name), .n = n_, .peer = peer};
}

void FclContest::report_rows() {
  const Runner& ours = runners_.front();
  const Series our_series = summarize(ours.ms);
  const auto add = [&](Row row) {
    row.k = work_->query == FclQuery::none ? 0 : ours.checked.hits / ours.workers.size();
    row.set_ours(our_series);
    report_.add(std::move(row));
  };
  for (std::size_t i = 1; i < runners_.size(); ++i) {
    const Runner& peer = runners_[i];
    const Series series = summarize(peer.ms);
    Row row = row_of(peer.kind->name);
    row.set_peer(series);
    row.known_difference = peer.kind->known_difference;
    row.pairs_equal = ours.checked.pairs == peer.checked.pairs && ours.all.hits == peer.all.hits;
    if (work_->query == FclQuery::none) row.pairs_equal.reset();
    add(std::move(row));
  }
  for (Row& row : skipped_) add(std::move(row));
}

void FclContest::run(const std::string& batch, const FclWork& work, std::size_t n) {
  batch_ = batch;
  work_ = &work;
  n_ = n;
  runners_.clear();
  skipped_.clear();
  FclScene scene = make_scene(n);
  for (const FclManagerKind& kind : kinds_) enter(kind, scene);
  run_rounds(scene);
  report_rows();
  runners_.clear();  // before the objects
}

const FclWork* find_work(const std::string& case_name) {
  const std::size_t colon = case_name.find(':');
  if (colon == std::string::npos || !is_batch(case_name.substr(0, colon))) return nullptr;
  for (const FclWork& work : fcl_works())
    if (work.name == std::string_view(case_name).substr(colon + 1)) return &work;
  return nullptr;
}

std::vector<FclManagerKind> choose_kinds(const Options& options) {
  std::vector<FclManagerKind> kinds = fcl_manager_kinds();
  std::string known;
  for (const FclManagerKind& kind : kinds) known += ' ' + kind.name;
  for (const std::string& name : options.peers)
    if (std::none_of(kinds.begin() + 1, kinds.end(), [&](const FclManagerKind& kind) { return kind.name == name; }))
      throw std::invalid_argument("no peer '" + name + "' in suite fcl; there are" + known);
  std::erase_if(kinds,
                [&](const FclManagerKind& kind) { return kind.name != "ours" && !options.wants_peer(kind.name); });
  return kinds;
}

}  // namespace

std::vector<CaseText> fcl_case_texts() {
  return texts_of(fcl_works());
}

bool is_fcl_case(const std::string& name) {
  return find_work(name) != nullptr;
}

void run_fcl_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    for (const FclWork& work : fcl_works()) cases.push_back("U:" + std::string(work.name));
  const std::vector<FclManagerKind> kinds = choose_kinds(options);
  FclContest contest(options, kinds, report, progress);
  for (const std::size_t n : options.sizes_or({32, 1000}, {32, 1000, 4000, 100000}))
    for (const std::string& name : cases) contest.run(name.substr(0, name.find(':')), *find_work(name), n);
}

}  // namespace boxstream::bench
