// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// Pairs, touches and contacts of frames, all numbers in LEB128:
///   ended     how many pairs of the frame before are no more, then where each is in its list, as seen from the last
///   one begun     how many there are anew, then each: a since the pair before, b since a or, if a is the same, since
///   that b turned    how many pairs touch and did not before, or the other way round, then where each is in the list
///   of pairs,
///             as seen from the last one; a pair that begins did not touch before
///   contacts  0: those of the frame before are good enough; else one more than there are, then each: where its
///             pair is in the list, as seen from the last one; its place, in `contact_quantum` units with the sign in
///             the lowest bit, as seen from the pair's object a, or from b where a is fixed, in the frame before; its
///             normal, by the two coordinates of an octahedron, 0 to 63 for -1 to 1
/// Contacts are many, and those of what rests hardly change: the first frame of a block has them, and each that has
/// few.
class PairCode {
 public:
  static constexpr std::int32_t contact_quantum = 4;  ///< units

  static constexpr std::size_t few_contacts = 2000;

  explicit PairCode(float unit) : unit_(unit) {}

  /// `places` of objects in the frame before, in sixteenths of a unit.
  void code(const Snapshot& snapshot, const std::vector<std::int32_t>& places, std::string& out);
  void restart();

 private:
  std::vector<bool> former_touches(const Snapshot& snapshot) const;
  void code_change(const Snapshot& snapshot, std::string& out);
  void code_touches(const Snapshot& snapshot, std::string& out);
  void code_contacts(const Snapshot& snapshot, const std::vector<std::int32_t>& places, std::string& out);

  float unit_;
  std::vector<Pair> pairs_;     // of the frame before
  std::vector<bool> touching_;  // of each of them
  bool is_first_ = true;        // of a block
};

}  // namespace boxstream::view
