// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boxstream/mpi.hpp>

#include "core/oracle.hpp"

namespace boxstream::mpi_test {

using tests::Boxes;
using tests::Pairs;

inline int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
inline int size() {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/// Ids of boxes: large, and not in their order.
inline std::uint64_t id_of(std::size_t i) {
  return (std::uint64_t{i} << 40) ^ 0x8000005a5a5a5a5a;
}
inline std::uint32_t index_of(std::uint64_t id) {
  return static_cast<std::uint32_t>((id ^ 0x8000005a5a5a5a5a) >> 40);
}

enum class Way { round_robin, sorted, all_on_last, every_other_empty };
inline constexpr Way ways[] = {Way::round_robin, Way::sorted, Way::all_on_last, Way::every_other_empty};

/// What one rank gives, of boxes that all ranks can make.
template <class S>
struct Share {
  Share(const Boxes<S>& all, Way way) {
    const std::size_t ranks = static_cast<std::size_t>(size()), self = static_cast<std::size_t>(rank());
    const auto place = [&](std::size_t i) -> std::size_t {
      if (way == Way::round_robin) return i % ranks;
      if (way == Way::sorted) return i * ranks / all.size();
      if (way == Way::all_on_last) return ranks - 1;
      return i * 7919 % ((ranks + 1) / 2) * 2;
    };
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) order[i] = i;
    if (way == Way::sorted)
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return order_of(all[a]) != order_of(all[b]) ? order_of(all[a]) < order_of(all[b]) : a < b;
      });
    for (std::size_t i = 0; i < all.size(); ++i)
      if (place(i) == self) {
        boxes.push_back(all[order[i]]);
        ids.push_back(id_of(order[i]));
      }
  }

  Boxes<S> boxes;
  std::vector<std::uint64_t> ids;

 private:
  static S order_of(const BasicAabb<S>& box) { return box.min[0] == box.min[0] ? box.min[0] : S(0); }
};

/// The values of all ranks, on each, in order of the ranks.
template <class T>
std::vector<std::vector<T>> from_all(const std::vector<T>& own) {
  std::vector<std::vector<T>> all(static_cast<std::size_t>(size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto& values = all[i];
    if (static_cast<int>(i) == rank()) values = own;
    std::uint64_t count = values.size();
    MPI_Bcast(&count, 1, MPI_UINT64_T, static_cast<int>(i), MPI_COMM_WORLD);
    values.resize(count);
    MPI_Bcast(values.data(), static_cast<int>(count * sizeof(T)), MPI_BYTE, static_cast<int>(i), MPI_COMM_WORLD);
  }
  return all;
}

template <class T>
std::vector<T> from_all(const T& own) {
  std::vector<T> all;
  for (const auto& values : from_all(std::vector<T>{own})) all.push_back(values[0]);
  return all;
}

/// Pairs of all ranks as pairs of indices.
inline Pairs united(const std::vector<WidePair>& own) {
  Pairs pairs;
  for (const auto& of_rank : from_all(own))
    for (const WidePair pair : of_rank) {
      EXPECT_LT(pair.a, pair.b);
      const auto [a, b] = std::minmax({index_of(pair.a), index_of(pair.b)});
      pairs.push_back({a, b});
    }
  return pairs;
}

}  // namespace boxstream::mpi_test
