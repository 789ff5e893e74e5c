// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace boxstream::tool {

/// What the command line asks for cannot be done. `what()` is the one line to print; exit code 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace boxstream::tool
