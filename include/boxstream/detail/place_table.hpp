// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace boxstream::detail {

/// A hash table from addresses to places (indices into an array of addresses, which is passed to every call): linear
/// probing, at most half full, holds places only. A few addresses are looked for one by one, without a table.
class PlaceTable {
 public:
  using Place = std::uint32_t;
  using Addresses = const std::vector<void*>&;

  static constexpr Place none = ~Place{0};

  Place find(const void* address, Addresses at) const {
    if (cells_.empty()) {
      for (Place place = 0; place < at.size(); ++place)
        if (at[place] == address) return place;
      return none;
    }
    for (std::size_t i = home(address);; i = next(i)) {
      const Place place = cells_[i];
      if (place == none || at[place] == address) return place;
    }
  }

  /// Room for `addresses` addresses in all. May throw, and has then done nothing.
  void reserve(std::size_t addresses, Addresses at) {
    if (addresses <= few || 2 * addresses <= cells_.size()) return;
    std::size_t size = 16;
    unsigned shift = 60;
    for (; size < 2 * addresses; size *= 2) --shift;
    std::vector<Place> cells(size, none);
    cells_.swap(cells);
    shift_ = shift;
    put_all(at);
  }

  /// Room for those that there are, and no more. May throw, and has then done nothing.
  void shrink(std::size_t addresses, Addresses at) {
    PlaceTable smaller;
    if (addresses != 0) smaller.reserve(addresses, at);
    *this = std::move(smaller);
  }

  /// Needs room; the address is not in the table.
  void insert(Place place, Addresses at) noexcept {
    if (cells_.empty()) return;
    std::size_t i = home(at[place]);
    while (cells_[i] != none) i = next(i);
    cells_[i] = place;
  }

  /// Moves later cells of the probe sequence back, so that searches still find them.
  void erase(Place place, Addresses at) noexcept {
    if (cells_.empty()) return;
    std::size_t hole = cell_of(place, at);
    for (std::size_t i = next(hole); cells_[i] != none; i = next(i)) {
      const std::size_t distance = (i - home(at[cells_[i]])) & (cells_.size() - 1);
      if (distance < ((i - hole) & (cells_.size() - 1))) continue;
      cells_[hole] = cells_[i];
      hole = i;
    }
    cells_[hole] = none;
  }

  /// The address at `from` is about to move to `to`.
  void rename(Place from, Place to, Addresses at) noexcept {
    if (!cells_.empty()) cells_[cell_of(from, at)] = to;
  }

  /// Rebuilds the table after places have changed. Null addresses are skipped.
  void renew(Addresses at) noexcept {
    for (Place& cell : cells_) cell = none;
    put_all(at);
  }

 private:
  static constexpr std::size_t few = 8;

  std::size_t home(const void* address) const {
    const auto bits = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(address));
    return static_cast<std::size_t>((bits * 0x9e3779b97f4a7c15u) >> shift_);
  }
  std::size_t next(std::size_t i) const { return (i + 1) & (cells_.size() - 1); }
  /// The address is in the table.
  std::size_t cell_of(Place place, Addresses at) const {
    std::size_t i = home(at[place]);
    while (cells_[i] != place) i = next(i);
    return i;
  }
  void put_all(Addresses at) noexcept {
    for (Place place = 0; place < at.size(); ++place)
      if (at[place] != nullptr) insert(place, at);
  }

  std::vector<Place> cells_;
  unsigned shift_ = 60;
};

}  // namespace boxstream::detail
