// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>

#include "measure/interleave.hpp"
#include "papers/hybrid/problem.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

/// The same for the same pairs in any order, and different for others but by an accident of 2^-64.
struct PairSum {
  std::uint64_t pairs = 0, sum = 0;

  void add(std::uint32_t a, std::uint32_t b) {
    std::uint64_t z = (std::uint64_t{a} << 32 | b) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 32)) * 0xd6e8feb86659fd93u;
    ++pairs;
    sum += z ^ (z >> 32);
  }
  friend bool operator==(const PairSum&, const PairSum&) = default;
};

struct Measured {
  double ms;  ///< median, processor time of this thread
  PairSum found;
};

/// `search` is given where its pairs go. What it makes, it makes within the time: each run starts from the caller's
/// boxes, as a user's would.
Measured measure(int repeats, const std::function<void(Found)>& search);

/// Median of the times of `run`, each after an untimed `prepare`.
double measure_time(int repeats, const std::function<void()>& prepare, const std::function<void()>& run);

/// The engine on one thread, warm.
Measured measure_engine(int repeats, const std::vector<Aabb>& boxes);
Measured measure_engine(int repeats, const std::vector<Aabb>& a, const std::vector<Aabb>& b);

/// Throws std::runtime_error naming `what` unless both are the same.
void require_same(const PairSum& found, const PairSum& expected, const std::string& what);

/// Version One numbers boxes by their places in its own array, which sorting structures changes. Throws
/// std::runtime_error unless the boxes that `version` finds in pairs have the ends of those that the engine finds in
/// `closed`, where closed[i] is boxes[i].
void require_same_boxes(VersionOne& version, const HybridOptions& options, const std::vector<Box>& boxes,
                        const std::vector<Aabb>& closed);

struct Contestant {
  std::string name;
  std::function<void(Found)> search;  ///< as for `measure`
};

/// Rounds without a limit of time, one call for each sample.
measure::Interleaving all_rounds(int repeats);

/// Interleaved. Medians, in the same order. Throws std::runtime_error, with the name of a contestant, when they do not
/// find the same pairs.
std::vector<Measured> measure_interleaved(int repeats, const std::vector<Contestant>& contestants);

}  // namespace boxstream::papers
