// SPDX-License-Identifier: MIT
#pragma once

#include <climits>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <boxstream/mpi/detail/records.hpp>

namespace boxstream::mpi::detail {

/// Collects which values go to which ranks, and then makes a parcel of them for each.
class Packing {
 public:
  explicit Packing(int ranks) : counts_(static_cast<std::size_t>(ranks)) {}

  void reserve(std::size_t copies) { copies_.reserve(copies); }
  void add(std::size_t value, std::size_t rank) {
    copies_.push_back({static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(rank)});
    ++counts_[rank];
  }
  std::size_t size() const { return copies_.size(); }

  /// `value(i)` is the value that was called i. Throws std::length_error if there are more than INT_MAX copies.
  template <class T, class Value>
  void fill(Parcels<T>& out, Value&& value) const {
    if (copies_.size() > INT_MAX) throw std::length_error("too many boxes for one message");
    out.counts.assign(counts_.begin(), counts_.end());
    out.begins.resize(counts_.size());
    out.allocate();
    std::vector<int> next = out.begins;
    for (const Copy copy : copies_) out.values[static_cast<std::size_t>(next[copy.rank]++)] = value(copy.value);
  }

 private:
  struct Copy {
    std::uint32_t value, rank;
  };

  std::vector<Copy> copies_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace boxstream::mpi::detail
