// SPDX-License-Identifier: MIT
// Stands in for the collectives that boxstream::mpi uses, by MPI's interface for profilers.
#include "outside_mpi.hpp"

#include <mpi.h>

#include "measure/stopwatch.hpp"

namespace boxstream::bench {

namespace {

std::chrono::nanoseconds inside{};

template <class Call>
int timed(Call&& call) {
  const auto begin = measure::now();
  const int code = call();
  inside += measure::now() - begin;
  return code;
}

}  // namespace

double outside_mpi_ms() {
  return measure::milliseconds(measure::now() - inside);
}

}  // namespace boxstream::bench

using boxstream::bench::timed;

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  return timed([&] { return PMPI_Allreduce(in, out, count, type, operation, comm); });
}

int MPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                  MPI_Comm comm) {
  return timed([&] { return PMPI_Allgather(out, out_count, out_type, in, in_count, in_type, comm); });
}

int MPI_Allgatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int* in_counts,
                   const int* in_begins, MPI_Datatype in_type, MPI_Comm comm) {
  return timed([&] { return PMPI_Allgatherv(out, out_count, out_type, in, in_counts, in_begins, in_type, comm); });
}

int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                 MPI_Comm comm) {
  return timed([&] { return PMPI_Alltoall(out, out_count, out_type, in, in_count, in_type, comm); });
}

int MPI_Alltoallv(const void* out, const int* out_counts, const int* out_begins, MPI_Datatype out_type, void* in,
                  const int* in_counts, const int* in_begins, MPI_Datatype in_type, MPI_Comm comm) {
  return timed(
      [&] { return PMPI_Alltoallv(out, out_counts, out_begins, out_type, in, in_counts, in_begins, in_type, comm); });
}
