// SPDX-License-Identifier: MIT
#include "suites/fcl_contest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace boxstream::bench {

namespace {

constexpr int warm_frames = 4;

}  // namespace

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

}  // namespace boxstream::bench
