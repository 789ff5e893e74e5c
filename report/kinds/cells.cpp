// SPDX-License-Identifier: MIT
// The same batch on every number of threads and every SIMD target that this machine has: the same pairs in the same
// order, or a failure.
#include <fmt/format.h>
#include <hwy/highway.h>

#include <algorithm>
#include <memory>
#include <thread>

#include <boxstream/detector.hpp>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "batches/batches.hpp"
#include "boxes/pair_difference.hpp"
#include "thread_executor.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// Switches the library to a SIMD target; 0: back to the best one.
void choose_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

struct TargetOfChoice {
  TargetOfChoice() = default;
  ~TargetOfChoice() { choose_target(0); }
  TargetOfChoice(const TargetOfChoice&) = delete;
  TargetOfChoice& operator=(const TargetOfChoice&) = delete;
};

/// What the library was compiled for and this machine has; HWY_TARGETS is that of the library, which has the same
/// flags.
std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> found;
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1)
    found.push_back(left & -left);
  return found;
}

/// Of pairs in their order.
std::uint64_t hash_in_order(const std::vector<Pair>& pairs) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Pair& pair : pairs) hash = (hash ^ ((std::uint64_t{pair.a} << 32) | pair.b)) * 0x9e3779b97f4a7c15u + 1;
  return hash;
}

struct Cell {
  std::int64_t target;
  unsigned threads;
  std::unique_ptr<bench::ThreadExecutor> executor;
  std::unique_ptr<Detector> detector;
  std::uint64_t hash = 0;
  std::string failure;
};

std::vector<Cell> make_cells(unsigned most_threads) {
  std::vector<Cell> cells;
  for (const std::int64_t target : targets())
    for (unsigned threads = 1; threads <= most_threads; ++threads) {
      cells.push_back({target, threads, std::make_unique<bench::ThreadExecutor>(threads), nullptr, 0, {}});
      cells.back().detector = std::make_unique<Detector>(DetectorOptions{cells.back().executor.get()});
    }
  return cells;
}

void run_batch(const std::string& batch, std::size_t n, unsigned most_threads, const RunOptions& options,
               const Progress& progress, Results& results) {
  const std::vector<Aabb> boxes = batches::make(batch, n, 1);
  const std::vector<Pair> expected = reference_pairs(boxes);
  std::vector<Cell> cells = make_cells(most_threads);
  std::vector<Pair> pairs;
  const TargetOfChoice restored;
  const auto run = [&](Cell& cell) {
    choose_target(cell.target);
    // Elapsed time for all of them, as more than one thread works.
    return accuracy::stopwatch([&] { cell.detector->find_pairs(Span<const Aabb>(boxes), pairs); },
                               accuracy::Clock::wall);
  };
  std::vector<PairDifference> differences;
  for (Cell& cell : cells) {
    progress(fmt::format("{}: {}, {} threads", batch, hwy::TargetName(cell.target), cell.threads));
    run(cell);
    cell.hash = hash_in_order(pairs);
    differences.push_back(compare_pairs(expected, pairs));
    cell.failure = differences.back().complaint(false);
    if (cell.failure.empty() && cell.hash != cells.front().hash) cell.failure = "the same pairs in another order";
  }
  const accuracy::Turns turns = accuracy::take_turns(cells.size(), options.repeats, [&](std::size_t i) {
    const double ms = run(cells[i]);
    if (hash_in_order(pairs) != cells[i].hash && cells[i].failure.empty())
      cells[i].failure = "other pairs, or another order, in a timed run";
    return 1e6 * ms / static_cast<double>(n);
  });
  const std::string panel = fmt::format("{}, {} boxes", batch, n);
  for (std::size_t i = 0; i < cells.size(); ++i)
    results.points.push_back(
        {.panel = panel,
         .series = hwy::TargetName(cells[i].target),
         .setting = fmt::format("{} thread{}", cells[i].threads, cells[i].threads == 1 ? "" : "s"),
         .x = static_cast<double>(cells[i].threads),
         .cost = turns.costs[i],
         .values = {static_cast<double>(differences[i].missed), static_cast<double>(differences[i].extra),
                    cells[i].hash == cells.front().hash ? 0.0 : 1.0},
         .failure = cells[i].failure});
  results.twins.push_back({panel, turns.twin_spread});
}

}  // namespace

Results cells_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ns per box";
    results.metrics = {"missed", "extra", "other_order"};
    const unsigned most_threads =
        std::clamp(std::thread::hardware_concurrency(), 1U, settings.value("most_threads", 8U));
    for (const json& batch : settings.at("batches"))
      run_batch(batch, settings.at("boxes").get<std::size_t>(), most_threads, options, progress, results);
    return results;
  });
}

}  // namespace boxstream::report
