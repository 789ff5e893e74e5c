// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "world/nearest_band.hpp"

namespace boxstream::detail {

/// Two blocks yet to be compared, on levels of their own.
template <class S>
struct NearStep {
  S squared;  // distance
  std::uint32_t a;
  std::uint32_t b;
  std::uint8_t level_a;
  std::uint8_t level_b;
};

/// What one query of distances needs.
template <class S>
struct NearScratch {
  NearBand<S> band;
  std::vector<NearStep<S>> steps;
  std::vector<std::uint32_t> row;
};

/// Lends each query scratch of its own, whatever thread it is on and whichever query it is inside of, and keeps it for
/// later ones. The lock is held for the handing over only.
template <class S>
class NearScratchPool {
 public:
  class Loan {
   public:
    explicit Loan(NearScratchPool& pool) : pool_(pool), scratch_(pool.take()) {}
    ~Loan() { pool_.give_back(std::move(scratch_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    NearScratch<S>& operator*() const { return *scratch_; }

   private:
    NearScratchPool& pool_;
    std::unique_ptr<NearScratch<S>> scratch_;
  };

 private:
  std::unique_ptr<NearScratch<S>> take() {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      auto scratch = std::move(idle_.back());
      idle_.pop_back();
      return scratch;
    }
    auto scratch = std::make_unique<NearScratch<S>>();
    idle_.reserve(made_ + 1);  // so that giving back cannot fail
    ++made_;
    return scratch;
  }

  void give_back(std::unique_ptr<NearScratch<S>> scratch) noexcept {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(scratch));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<NearScratch<S>>> idle_;
  std::size_t made_ = 0;
};

}  // namespace boxstream::detail
