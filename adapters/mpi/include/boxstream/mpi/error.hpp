// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <stdexcept>
#include <string>

namespace boxstream::mpi {

/// What a rank threw, thrown on every rank. Where it came from, the exception itself is nested in it
/// (std::rethrow_if_nested).
class Error : public std::runtime_error {
 public:
  Error(int rank, const std::string& what)
      : std::runtime_error("boxstream: rank " + std::to_string(rank) + ": " + without_prefix(what)), rank_(rank) {}

  /// The lowest that threw.
  int rank() const { return rank_; }

 private:
  /// Errors of boxstream itself begin with its name.
  static std::string without_prefix(const std::string& what) {
    const std::string prefix = "boxstream: ";
    return what.compare(0, prefix.size(), prefix) == 0 ? what.substr(prefix.size()) : what;
  }

  int rank_;
};

}  // namespace boxstream::mpi
