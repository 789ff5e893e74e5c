// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.hpp>
#include <boxstream/mpi.hpp>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const int n = 1000;
  std::vector<boxstream::Aabb> boxes;
  std::vector<std::uint64_t> ids;
  for (int i = 0; i < n; ++i) {
    const int at = rank * n + i;
    boxes.push_back({{float(at), 0, 0}, {float(at + 1), 1, 1}});
    ids.push_back(std::uint64_t(at));
  }
  std::vector<boxstream::WidePair> pairs;
  const boxstream::mpi::Stats stats = boxstream::mpi::find_pairs(MPI_COMM_WORLD, boxes, ids, pairs);
  std::uint64_t all = stats.boxes - stats.pairs;  // one, over all ranks
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  if (all == 1) return 0;
  std::printf("wrong: %zu pairs on rank %d\n", pairs.size(), rank);
  return 1;
}
