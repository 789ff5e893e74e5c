// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

/// Programs that link file_calls.cpp have their own open() and pwrite(), which refuse what a test asks them to.
namespace boxstream::out_of_core_test::file_calls {

/// As a file system does that makes no file without a name.
inline bool refuse_nameless = false;

/// Bytes that still fit on the disk; writes that cross the end are short.
inline constexpr std::uint64_t unlimited = UINT64_MAX;
inline std::uint64_t room = unlimited;

/// Every second write is interrupted by a signal first.
inline bool interrupt = false;

/// Puts all back at the end of a scope.
struct Refusals {
  ~Refusals() {
    refuse_nameless = interrupt = false;
    room = unlimited;
  }
};

}  // namespace boxstream::out_of_core_test::file_calls
