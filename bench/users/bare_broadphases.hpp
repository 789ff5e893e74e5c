// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "suites/suites.hpp"

namespace boxstream::bench {

/// A broad-phase alone, without the rest of Bullet: each box is set and the pairs are calculated. Boxes of unit size
/// lie about three pairs each, and go to and fro, each by itself.
struct BareCase {
  enum Kind {
    plain,
    refused,  ///< all but some lie in a layer, touch four others each, and are refused by a filter callback
    eager,    ///< as plain, with Eager::all
  };
  std::string name;
  double pace;  ///< how far a box moves in a frame, of its size
  Kind kind;
  std::vector<int> sizes;
};

void run_bare(const std::string& suite, const BareCase& bare, int n, const Options& options,
              const std::vector<std::string>& peers, Report& report, Progress& progress);

}  // namespace boxstream::bench
