// SPDX-License-Identifier: MIT
// A row for each share of boxes that move: what ranks do and send in a frame of mpi::World, beside
// a boxstream::World of as many boxes as a rank gives, and beside mpi::find_pairs.
#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include <boxstream/mpi.hpp>
#include <boxstream/world.hpp>

#include "inputs/batches.hpp"
#include "outside_mpi.hpp"

namespace boxstream::bench {
namespace {

constexpr int frames = 11;

double mean(double own) {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  PMPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return own / size;
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// On each axis by up to a tenth of the own side, either way.
void tremble(std::vector<Aabb>& boxes, std::size_t one_in, std::mt19937& random) {
  for (std::size_t i = 0; i < boxes.size(); i += one_in)
    for (int d = 0; d < 3; ++d) {
      const float by = (boxes[i].max[d] - boxes[i].min[d]) * (static_cast<float>(random() % 2001) - 1000) * 1e-4F;
      boxes[i].min[d] += by;
      boxes[i].max[d] += by;
    }
}

/// One box in `one_in` moves.
void row(const char* batch, std::size_t n, std::size_t one_in) {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<Aabb> boxes, all = batches::make(batch, n * static_cast<std::size_t>(size), 1);
  std::vector<std::uint64_t> ids;
  for (auto i = static_cast<std::size_t>(rank); i < all.size(); i += static_cast<std::size_t>(size)) {
    boxes.push_back(all[i]);
    ids.push_back(i);
  }
  std::vector<Aabb> alone = batches::make(batch, n, 1);
  std::vector<ProxyId> proxies(n);
  mpi::World world(MPI_COMM_WORLD);
  World world_alone;
  world_alone.create(alone, {}, proxies);
  std::mt19937 random(static_cast<unsigned>(rank));
  std::vector<double> times, times_alone, times_batch;
  std::vector<WidePair> pairs;
  mpi::WorldStats stats;
  for (int frame = 0; frame < frames; ++frame) {
    tremble(boxes, one_in, random);
    tremble(alone, one_in, random);
    const double begin = outside_mpi_ms();
    stats = world.update(boxes, ids);
    const double middle = outside_mpi_ms();
    world_alone.move(proxies, alone);
    world_alone.update();
    const double end = outside_mpi_ms();
    mpi::find_pairs(MPI_COMM_WORLD, boxes, ids, pairs);
    if (frame == 0) continue;
    times.push_back(middle - begin);
    times_alone.push_back(end - middle);
    times_batch.push_back(outside_mpi_ms() - end);
  }
  const auto a_box = [&](std::uint64_t own) { return mean(static_cast<double>(own)) / static_cast<double>(n); };
  const double changed = a_box(stats.changed), received = a_box(stats.received), bytes = a_box(stats.bytes_sent),
               time = mean(median(times)), time_alone = mean(median(times_alone)),
               time_batch = mean(median(times_batch));
  if (rank != 0) return;
  fmt::print("| {} | {} | {} | {:.2f} | {:.3f} | {:.1f} | {:.2f} | {:.2f} |\n", batch, size, n, changed, received,
             bytes, time / time_alone, time_batch / time_alone);
}

}  // namespace
}  // namespace boxstream::bench

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
  for (const std::size_t one_in : {1, 20}) boxstream::bench::row("U", n, one_in);
  MPI_Finalize();
  return 0;
}
