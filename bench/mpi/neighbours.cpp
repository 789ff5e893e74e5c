// SPDX-License-Identifier: MIT
// Particles at random places and their pairs within a distance of 1, to be compared with LAMMPS: against_lammps.sh.
//   boxstream_mpi_neighbours N DATA    writes the particles for LAMMPS
//   boxstream_mpi_neighbours N         finds the pairs
#include <fmt/core.h>
#include <fmt/os.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include <boxstream/mpi.hpp>

#include "outside_mpi.hpp"

namespace boxstream::bench {
namespace {

struct Place {
  double x[3];
};

/// As dense as sand: about three pairs each.
double side(std::size_t n) {
  return std::cbrt(static_cast<double>(n) * 0.7);
}

std::vector<Place> places(std::size_t n) {
  std::mt19937_64 random(1);
  std::vector<Place> places(n);
  for (Place& place : places)
    for (double& x : place.x) x = static_cast<double>(random() >> 11) * 0x1p-53 * side(n);
  return places;
}

void write(const char* path, std::size_t n) {
  auto file = fmt::output_file(path);
  file.print("particles\n\n{} atoms\n1 atom types\n", n);
  for (const char* axis : {"x", "y", "z"}) file.print("0 {:.17g} {}lo {}hi\n", side(n), axis, axis);
  file.print("\nMasses\n\n1 1\n\nAtoms\n\n");
  std::size_t number = 0;
  for (const Place& place : places(n))
    file.print("{} 1 {:.17g} {:.17g} {:.17g}\n", ++number, place.x[0], place.x[1], place.x[2]);
}

/// Boxes of a width of 1, and some more for what rounding takes away.
Aabb64 box_of(const Place& place) {
  constexpr double half = 0.5 + 1e-9;
  Aabb64 box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = place.x[d] - half;
    box.max[d] = place.x[d] + half;
  }
  return box;
}

bool are_near(const Place& a, const Place& b) {
  double squares = 0;
  for (int d = 0; d < 3; ++d) squares += (a.x[d] - b.x[d]) * (a.x[d] - b.x[d]);
  return squares <= 1;
}

void find(std::size_t n) {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const std::vector<Place> all = places(n);
  std::vector<Aabb64> boxes;
  std::vector<std::uint64_t> ids;
  for (auto i = static_cast<std::size_t>(rank); i < n; i += static_cast<std::size_t>(size)) {
    boxes.push_back(box_of(all[i]));
    ids.push_back(i);
  }
  std::uint64_t near = 0;
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    near = 0;
    const double begin = outside_mpi_ms();
    mpi::stream_pairs(MPI_COMM_WORLD, boxes, ids, [&](Span<const WidePair> pairs) {
      for (const WidePair pair : pairs) near += are_near(all[pair.a], all[pair.b]) ? 1 : 0;
      return true;
    });
    times.push_back(outside_mpi_ms() - begin);
  }
  std::sort(times.begin(), times.end());
  double most = 0;
  PMPI_Allreduce(&times[2], &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  PMPI_Allreduce(MPI_IN_PLACE, &near, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0) fmt::print("{} {:.1f}\n", near, most);
}

}  // namespace
}  // namespace boxstream::bench

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
  if (argc > 2)
    boxstream::bench::write(argv[2], n);
  else
    boxstream::bench::find(n);
  MPI_Finalize();
  return 0;
}
