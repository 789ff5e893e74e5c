// SPDX-License-Identifier: MIT
// The same batch on every number of threads and every SIMD target that this machine has: the same pairs in the same
// order, or a failure.
#include <fmt/format.h>
#include <hwy/highway.h>

#include <algorithm>
#include <memory>
#include <thread>

#include <boxstream/detector.hpp>

#include "boxes/pair_difference.hpp"
#include "experiment_kinds/kinds.hpp"
#include "inputs/batches.hpp"
#include "thread_pool.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// Switches the library to a SIMD target; 0: back to the best one.
void choose_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Goes back to the best target when it is destroyed.
struct RestoredTarget {
  RestoredTarget() = default;
  ~RestoredTarget() { choose_target(0); }
  RestoredTarget(const RestoredTarget&) = delete;
  RestoredTarget& operator=(const RestoredTarget&) = delete;
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
  std::unique_ptr<threads::ThreadPool> executor;
  std::unique_ptr<Detector> detector;
  std::uint64_t hash = 0;
  PairDifference difference{};
  std::string failure{};
};

std::vector<Cell> make_cells(unsigned most_threads) {
  std::vector<Cell> cells;
  for (const std::int64_t target : targets())
    for (unsigned threads = 1; threads <= most_threads; ++threads) {
      cells.push_back({target, threads, std::make_unique<threads::ThreadPool>(threads), nullptr});
      cells.back().detector = std::make_unique<Detector>(DetectorOptions{cells.back().executor.get()});
    }
  return cells;
}

void measure_batch(const std::string& batch, std::size_t n, unsigned most_threads, Measurement& measurement) {
  const std::vector<Aabb> boxes = batches::make(batch, n, 1);
  const std::vector<Pair> expected = reference_pairs(boxes);
  std::vector<Cell> cells = make_cells(most_threads);
  std::vector<Pair> pairs;
  const RestoredTarget restored;
  const auto run = [&](Cell& cell) {
    choose_target(cell.target);
    // Elapsed time for all of them, as more than one thread works.
    return measure::time_once([&] { cell.detector->find_pairs(Span<const Aabb>(boxes), pairs); }, measure::Clock::wall);
  };
  for (Cell& cell : cells) {
    measurement.progress(fmt::format("{}: {}, {} threads", batch, hwy::TargetName(cell.target), cell.threads));
    run(cell);
    cell.hash = hash_in_order(pairs);
    cell.difference = compare_pairs(expected, pairs);
    cell.failure = cell.difference.complaint(false);
    if (cell.failure.empty() && cell.hash != cells.front().hash) cell.failure = "the same pairs in another order";
  }
  const auto timed = [&](Cell& cell) {
    const double ms = run(cell);
    if (hash_in_order(pairs) != cell.hash && cell.failure.empty())
      cell.failure = "other pairs, or another order, in a timed run";
    return 1e6 * ms / static_cast<double>(n);
  };
  measurement.add_points(fmt::format("{}, {} boxes", batch, n), cells, timed, [&](const Cell& cell, const auto&) {
    return Point{.series = hwy::TargetName(cell.target),
                 .setting = fmt::format("{} thread{}", cell.threads, cell.threads == 1 ? "" : "s"),
                 .x = static_cast<double>(cell.threads),
                 .values = {static_cast<double>(cell.difference.missed), static_cast<double>(cell.difference.extra),
                            cell.hash == cells.front().hash ? 0.0 : 1.0},
                 .failure = cell.failure};
  });
}

}  // namespace

void measure_cells(Measurement& measurement) {
  const json& settings = measurement.settings();
  const unsigned most_threads = std::clamp(std::thread::hardware_concurrency(), 1U, settings.value("most_threads", 8U));
  for (const json& batch : settings.at("batches"))
    measure_batch(batch, settings.at("boxes").get<std::size_t>(), most_threads, measurement);
}

}  // namespace boxstream::report
