// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace boxstream::tool {

/// What the command line asks for cannot be done. `what()` is the one line to print; exit code 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "; did you mean NAME?" with the one of `names` that is the fewest slips of a finger away from `given`, or nothing if
/// that is too far.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& names);

/// Throws BadInput if `name` is none of `known`: "unknown WHAT ...", with the nearest and all that there are.
void check_known(const char* what, const std::string& name, const std::vector<std::string>& known);

/// Throws BadInput, naming those there are, if `name` is no broad-phase for Bullet and none of `more`.
void check_broadphase(const std::string& name, const std::vector<std::string>& more = {});

}  // namespace boxstream::tool
