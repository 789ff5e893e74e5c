// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// Programs that link heap_watch.cpp have all their operator new and delete counted, from any thread, and can make
/// them fail.
namespace boxstream::tests::heap_watch {

std::uint64_t allocations();  ///< since the start of the program
std::int64_t live_allocations();
std::int64_t live_bytes();
std::int64_t peak_bytes();  ///< most live bytes since `reset_peak`
void reset_peak();

/// Lets `count` more allocations succeed; the next one throws std::bad_alloc, and so do all after it until
/// `stop_failing`.
void fail_after(std::int64_t count);
/// Lets the allocation fail before which `first` more succeed, and, unless `then` is `never`, the one before which
/// `then` more succeed after that; no others.
inline constexpr std::int64_t never = -1;
void fail_at(std::int64_t first, std::int64_t then = never);
/// True if an allocation has failed since `fail_after` or `fail_at`.
bool stop_failing();
/// Allocations since then that might have failed.
std::int64_t tried();

/// While one of these lives, failures as they were asked for come to pass, or wait: so that those of a test itself, in
/// callbacks above all, neither fail nor count.
class Failures {
 public:
  explicit Failures(bool come);
  ~Failures();
  Failures(const Failures&) = delete;
  Failures& operator=(const Failures&) = delete;

 private:
  const bool came_;
};

}  // namespace boxstream::tests::heap_watch
