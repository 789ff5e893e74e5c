// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace boxstream::scenes {

/// Why a scene cannot be used. `what()` is one line: "FILE: /json/pointer: reason", or "FILE: reason" when the file
/// cannot be read at all.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace boxstream::scenes
