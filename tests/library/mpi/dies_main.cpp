// SPDX-License-Identifier: MIT
// A rank that ends in the middle of a search, while others wait for it: MPI has to end them.
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

#include <boxstream/mpi.hpp>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::vector<boxstream::Aabb> boxes(100, {{0, 0, 0}, {1, 1, 1}});
  std::vector<std::uint64_t> ids(boxes.size());
  std::iota(ids.begin(), ids.end(), boxes.size() * static_cast<std::size_t>(rank));
  boxstream::mpi::stream_pairs(MPI_COMM_WORLD, boxes, ids, [](boxstream::Span<const boxstream::WidePair>) -> bool {
    std::puts("a rank ends");
    std::fflush(stdout);
    std::_Exit(3);
  });
  std::puts("not reached");
  MPI_Finalize();
  return 0;
}
