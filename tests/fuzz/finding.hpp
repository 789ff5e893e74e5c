// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>

/// What every fuzz target has: libFuzzer's, or the replay of the corpus, calls it with input after input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace boxstream::fuzz {

/// Thrown by a target when a promise is broken. No std::exception, so that nothing on the way takes it for an error
/// that it knows; under libFuzzer it is not caught, which makes the input a crash.
struct Finding {};

[[noreturn]] inline void found(const std::string& what) {
  std::cerr << "FINDING: " << what << std::endl;
  throw Finding{};
}

inline void promise(bool kept, const char* what) {
  if (!kept) found(what);
}
inline void promise(bool kept, const std::string& what) {
  if (!kept) found(what);
}

/// Complaints about files are one line, and say something.
inline void promise_one_line(const std::string& complaint) {
  promise(!complaint.empty(), "an empty complaint");
  for (const char c : complaint)
    promise(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a control character in the complaint: " + complaint);
}

}  // namespace boxstream::fuzz
