// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace boxstream::detail {

/// The pair that a query of near pairs begins with, as long as neither of its tables changes. Any thread reads and
/// keeps it at any time. Where two meet, one of them does without.
class KnownFirst {
 public:
  /// What a pair is known of: the other set, by its number, and the last changes of both tables.
  struct Of {
    std::uint64_t other, change, other_change;
  };

  KnownFirst() = default;
  /// One that was moved knows nothing.
  KnownFirst(KnownFirst&&) noexcept {}
  KnownFirst& operator=(KnownFirst&&) noexcept {
    keep({}, unknown);
    return *this;
  }

  static constexpr std::uint64_t unknown = ~std::uint64_t{0};

  /// The pair by its number, or `unknown`.
  std::uint64_t find(const Of& of) const {
    const std::uint64_t version = version_.load(std::memory_order_acquire);
    const bool is_of = word(0) == of.other && word(1) == of.change && word(2) == of.other_change;
    const std::uint64_t pair = word(3);
    return is_of && version % 2 == 0 && version_.load(std::memory_order_relaxed) == version ? pair : unknown;
  }

  void keep(const Of& of, std::uint64_t pair) {
    std::uint64_t version = version_.load(std::memory_order_relaxed);
    if (version % 2 != 0 || !version_.compare_exchange_strong(version, version + 1, std::memory_order_acquire)) return;
    const std::uint64_t words[] = {of.other, of.change, of.other_change, pair};
    for (std::size_t i = 0; i < 4; ++i) words_[i].store(words[i], std::memory_order_release);
    version_.store(version + 2, std::memory_order_release);
  }

 private:
  // In order with the version, which so tells a reader that a word is newer than the version it has read.
  std::uint64_t word(std::size_t i) const { return words_[i].load(std::memory_order_acquire); }

  std::atomic<std::uint64_t> version_{0};  // odd while words are written
  std::atomic<std::uint64_t> words_[4]{};  // sets have no number 0
};

/// A number that nothing else has that this library makes; moving takes it along.
class OwnNumber {
 public:
  operator std::uint64_t() const { return number_; }

 private:
  static std::uint64_t next() {
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
  }

  std::uint64_t number_ = next();
};

}  // namespace boxstream::detail
