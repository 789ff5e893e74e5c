// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace boxstream::tool {

/// The user asked for something that cannot be done as asked. `what()` is the one line to print; exit code 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace boxstream::tool
