// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace boxstream::record {

/// Bytes that are no stream, or a stream that cannot be replayed here. `what()` is one line: "offset N: reason" where
/// it is about a place.
class RecordError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace boxstream::record
