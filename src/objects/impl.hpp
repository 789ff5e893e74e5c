// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include <boxstream/object_set.hpp>

#include "objects/held_pairs.hpp"
#include "objects/object_index.hpp"

namespace boxstream {

namespace detail {

/// Says of places whether the filters there go with one filter. While no object has bits of its own (`special` is
/// empty) one answer stands for all.
class GoesWith {
 public:
  GoesWith(Filter filter, Span<const Filter> special)
      : filter_(filter), special_(special), goes_with_plain_(accepts(filter, Filter{})) {}

  bool operator()(std::uint32_t place) const {
    return special_.empty() ? goes_with_plain_ : accepts(filter_, special_[place]);
  }

 private:
  Filter filter_;
  Span<const Filter> special_;
  bool goes_with_plain_;
};

/// Places that a query found, in memory that is kept for the next one. Those at the same time have their own.
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

/// What queries make when they need it.
template <class S>
struct BasicObjectSet<S>::Impl {
  explicit Impl(Executor* executor) : pairs(WorldOptions{executor}) {}

  detail::ObjectIndex<S> index;
  detail::HeldPairs<S> pairs;
  detail::ScratchPlaces::Spare spare;
  std::atomic<std::uint64_t> rows_to_try{4};
};

template <class S>
inline const detail::Bvh<S>& BasicObjectSet<S>::fresh_index() const {
  return impl_->index.fresh(roster_, known_);
}

}  // namespace boxstream
