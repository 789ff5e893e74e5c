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
      : std::runtime_error("boxstream: rank " + std::to_string(rank) + ": " + what), rank_(rank) {}

  /// The lowest that threw.
  int rank() const { return rank_; }

 private:
  int rank_;
};

}  // namespace boxstream::mpi
