// SPDX-License-Identifier: MIT
// A row for each batch: what ranks do and send when each has as many boxes, however many ranks there are.
#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/mpi.hpp>

#include "inputs/batches.hpp"
#include "outside_mpi.hpp"

namespace boxstream::bench {
namespace {

constexpr int repeats = 5;

struct Over {
  double mean, most;
};

/// Over all ranks.
Over over(double own) {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  double sum = 0, most = 0;
  PMPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  PMPI_Allreduce(&own, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return {sum / size, most};
}

template <class Run>
double median_ms(Run&& run) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const double begin = outside_mpi_ms();
    run();
    times.push_back(outside_mpi_ms() - begin);
  }
  std::sort(times.begin(), times.end());
  return times[repeats / 2];
}

/// `n` boxes for each rank, of which none are where the rank's part is.
void row(const std::string& batch, std::size_t n) {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<Aabb> boxes;
  std::vector<std::uint64_t> ids;
  {
    const auto all = batches::make(batch, n * static_cast<std::size_t>(size), 1);
    for (auto i = static_cast<std::size_t>(rank); i < all.size(); i += static_cast<std::size_t>(size)) {
      boxes.push_back(all[i]);
      ids.push_back(i);
    }
  }
  const std::vector<Aabb> alone = batches::make(batch, n, 1);
  std::vector<WidePair> pairs;
  std::vector<Pair> pairs_alone;
  mpi::Stats stats;
  const double together_ms = median_ms([&] { stats = mpi::find_pairs(MPI_COMM_WORLD, boxes, ids, pairs); });
  const double alone_ms = median_ms([&] { Detector().find_pairs(alone, pairs_alone); });

  const auto mean_and_most = [](auto own) { return over(static_cast<double>(own)); };
  const Over received = mean_and_most(stats.received), found = mean_and_most(stats.pairs),
             tests = mean_and_most(stats.tests), bytes = mean_and_most(stats.bytes_sent),
             messages = mean_and_most(stats.messages_sent), time = over(together_ms), time_alone = over(alone_ms);
  if (rank != 0) return;
  fmt::print("| {} | {} | {} | {:.3f} | {:.2f} | {} | {:.1f} | {:.1f} | {:.0f} | {:.2f} | {:.2f} |\n", batch, size, n,
             received.mean / static_cast<double>(n), received.most / received.mean,
             found.mean > 0 ? fmt::format("{:.2f}", found.most / found.mean) : "-", tests.mean / static_cast<double>(n),
             bytes.mean / static_cast<double>(n), messages.most, time.mean / time_alone.mean,
             time.most / time_alone.mean);
  std::fflush(stdout);
}

}  // namespace
}  // namespace boxstream::bench

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 250000;
  std::vector<std::string> batches(argv + std::min(argc, 2), argv + argc);
  if (batches.empty()) batches = {"U", "C", "heap", "lattice"};
  for (const std::string& batch : batches) boxstream::bench::row(batch, n);
  MPI_Finalize();
  return 0;
}
