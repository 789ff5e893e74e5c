// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace boxstream::worlds_test {

/// What this program has golden hashes of: scenes, or worlds made in C++.
std::vector<std::string> golden_names();

/// The line of golden.txt that a run gives now: name, precision of Bullet, steps, a hash of the list of pairs after
/// each step, and one of the state after each step. Both depend on order.
std::string golden_line(const std::string& name);

/// FNV-1a over whole words.
class Fold {
 public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::string golden_line(const std::string& name, const char* precision, int steps, const Fold& pairs,
                        const Fold& states);

}  // namespace boxstream::worlds_test
