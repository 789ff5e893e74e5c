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
/// True if an allocation has failed since `fail_after`.
bool stop_failing();

}  // namespace boxstream::tests::heap_watch
