// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace boxstream::files {

/// A file that cannot be read or written. `what()` is "NAME: reason".
class BadFile : public std::runtime_error {
 public:
  BadFile(const std::string& name, const std::string& reason)
      : std::runtime_error(name + ": " + reason), reason_(reason) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace boxstream::files
