// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include <boxstream/object_set.hpp>

#include "objects/lazy_pairs.hpp"
#include "objects/object_index.hpp"

namespace boxstream {

namespace detail {

/// Tests the filters at places against one filter. While all objects have the default filter (`special` is empty) the
/// test is done once.
class FilterTest {
 public:
  FilterTest(Filter filter, Span<const Filter> special)
      : filter_(filter), special_(special), passes_default_(accepts(filter, Filter{})) {}

  bool operator()(std::uint32_t place) const {
    return special_.empty() ? passes_default_ : accepts(filter_, special_[place]);
  }

 private:
  Filter filter_;
  Span<const Filter> special_;
  bool passes_default_;
};

/// The places of the objects of a small table, in order: without gaps, so that what few objects cost does not depend on
/// how many have left.
template <class S, std::size_t most>
class LivePlaces {
 public:
  explicit LivePlaces(const ObjectTable<S>& table) {
    for (std::uint32_t place = 0; place < table.places(); ++place) {
      places_[count_] = place;
      count_ += table.object(place) != nullptr;
    }
  }

  std::size_t count() const { return count_; }
  std::uint32_t operator[](std::size_t i) const { return places_[i]; }
  const std::uint32_t* data() const { return places_; }

 private:
  std::size_t count_ = 0;
  std::uint32_t places_[most + 1];
};

inline WorldOptions world_options(const DetectorOptions& options) {
  WorldOptions world;
  world.executor = options.executor;
  world.method = options.method;
  world.cutoff = options.cutoff;
  return world;
}

/// Scratch list of places found by a query, kept for the next query. Concurrent queries get lists of their own.
class ScratchPlaces {
 public:
  struct Spare {
    std::mutex mutex;
    std::vector<std::uint32_t> places;
  };

  explicit ScratchPlaces(Spare& spare) : spare_(spare) { exchange(); }
  ~ScratchPlaces() {
    places_.clear();
    exchange();
  }
  ScratchPlaces(const ScratchPlaces&) = delete;
  ScratchPlaces& operator=(const ScratchPlaces&) = delete;

  std::vector<std::uint32_t>* operator->() { return &places_; }

 private:
  void exchange() noexcept {
    const std::lock_guard lock(spare_.mutex);
    places_.swap(spare_.places);
  }

  Spare& spare_;
  std::vector<std::uint32_t> places_;
};

}  // namespace detail

/// What queries build when they need it.
template <class S>
struct BasicObjectSet<S>::Impl {
  explicit Impl(const DetectorOptions& options) : pairs(detail::world_options(options)) {}

  detail::ObjectIndex<S> index;
  detail::LazyPairs<S> pairs;
  detail::ScratchPlaces::Spare spare;
  std::atomic<std::uint64_t> rows_to_try{4};
};

template <class S>
inline typename BasicObjectSet<S>::Impl& BasicObjectSet<S>::impl() const {
  return impl_.get(options_);
}

template <class S>
inline const detail::Bvh<S>& BasicObjectSet<S>::fresh_index() const {
  return impl().index.fresh(table_, known_);
}

/// True if the index is not fresh, and to compare what takes as long as a scan of `boxes` is cheaper for this query.
template <class S>
inline bool BasicObjectSet<S>::scans_next(std::uint64_t boxes) const {
  return !known_.are_of(table_) && impl().index.scanning_is_cheaper(table_, known_, boxes);
}

namespace detail {

/// Two places in one number, by which pairs of a set are sorted.
inline std::uint64_t number_of_pair(std::uint32_t row, std::uint32_t column) {
  return std::uint64_t{row} << 32 | column;
}

}  // namespace detail

}  // namespace boxstream
