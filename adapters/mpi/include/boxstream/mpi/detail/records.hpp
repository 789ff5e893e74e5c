// SPDX-License-Identifier: MIT
#pragma once

#include <climits>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/mpi/detail/ranks.hpp>

namespace boxstream::mpi::detail {

/// What travels: a box and its id.
template <class S>
struct Record {
  BasicAabb<S> box;
  std::uint64_t id;
};

/// A T as MPI sees it, so that counts are of these and not of bytes, which an int might not hold.
template <class T>
class Type {
 public:
  Type() {
    check(MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type_));
    check(MPI_Type_commit(&type_));
  }
  ~Type() { MPI_Type_free(&type_); }
  Type(const Type&) = delete;
  Type& operator=(const Type&) = delete;

  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Values for each rank, or from each: `counts[rank]` of them from `begins[rank]` on, at most INT_MAX together.
template <class T>
struct Parcels {
  void set_ranks(int ranks) {
    counts.assign(static_cast<std::size_t>(ranks), 0);
    begins.assign(counts.size(), 0);
  }

  /// Makes room for what the counts say; throws std::length_error beyond INT_MAX.
  void allocate() {
    std::size_t total = 0;
    for (std::size_t rank = 0; rank < counts.size(); ++rank) {
      begins[rank] = static_cast<int>(total);
      total += static_cast<std::size_t>(counts[rank]);
      if (total > INT_MAX) throw std::length_error("too many boxes for one message");
    }
    values.resize(total);
  }

  std::vector<T> values;
  std::vector<int> counts, begins;
};

/// What a rank has sent to the others.
struct Traffic {
  template <class T>
  void add(std::uint64_t count) {
    bytes += count * sizeof(T);
    messages += count != 0 ? 1 : 0;
  }

  std::uint64_t bytes = 0, messages = 0;
};

/// `values` of all ranks on every rank, in order of the ranks. The ranks of `all` are set.
template <class T>
void gather(const Ranks& ranks, const std::vector<T>& values, Parcels<T>& all, Traffic& traffic) {
  const int count = static_cast<int>(values.size());
  check(MPI_Allgather(&count, 1, MPI_INT, all.counts.data(), 1, MPI_INT, ranks.comm()));
  ranks.together([&] { all.allocate(); });
  const Type<T> type;
  check(MPI_Allgatherv(values.data(), count, type, all.values.data(), all.counts.data(), all.begins.data(), type,
                       ranks.comm()));
  for (int i = 1; i < ranks.size(); ++i) traffic.add<T>(values.size());
}

/// Sends each rank its parcel; `in`, whose ranks are set, has what came, in order of the ranks that sent it.
/// `make_room` is told how much that is, before it comes, and may throw.
template <class T, class MakeRoom>
void exchange(const Ranks& ranks, const Parcels<T>& out, Parcels<T>& in, Traffic& traffic, MakeRoom&& make_room) {
  check(MPI_Alltoall(out.counts.data(), 1, MPI_INT, in.counts.data(), 1, MPI_INT, ranks.comm()));
  ranks.together([&] {
    in.allocate();
    make_room(in.values.size());
  });
  const Type<T> type;
  check(MPI_Alltoallv(out.values.data(), out.counts.data(), out.begins.data(), type, in.values.data(), in.counts.data(),
                      in.begins.data(), type, ranks.comm()));
  for (int rank = 0; rank < ranks.size(); ++rank)
    if (rank != ranks.self()) traffic.add<T>(static_cast<std::uint64_t>(out.counts[static_cast<std::size_t>(rank)]));
}

}  // namespace boxstream::mpi::detail
