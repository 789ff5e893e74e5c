// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/splice.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A splice of an array of pairs that is made bit by bit, from the front on, while the array is read. Then pairs move
/// when they are in the nearest cache anyway.
///
///     [ in their places, `done` ][ `carried_` has been here ][ where they were before ]
class LateSplice {
 public:
  /// Of `size` pairs; `arriving` are those at the inserted places. Returns how many are in place. May throw, and has
  /// then done nothing.
  std::size_t begin(const Splice& changes, const btBroadphasePair* arriving, std::size_t size);

  /// Of `pairs`, which has room for both sizes, those up to `end` are in place, if `done` are. Returns how many are.
  std::size_t go_on(btBroadphasePair* pairs, std::size_t done, std::size_t end) noexcept;

  std::size_t next_size() const { return size_ + inserted_.size() - removed_.size(); }
  void give_back() noexcept;

 private:
  static constexpr std::size_t block = 64;

  void carry(const btBroadphasePair* pairs, std::size_t end) noexcept;
  void place(btBroadphasePair* pairs, std::size_t begin, std::size_t end) noexcept;

  std::vector<std::uint32_t> removed_, inserted_;
  std::vector<btBroadphasePair> arriving_;
  std::size_t size_ = 0;
  std::size_t less_ = 0, more_ = 0;  // removals and insertions that are made
  std::size_t next_ = 0;             // the first of the old pairs that has no new place yet
  std::size_t read_ = 0;             // those from `next_` to here are carried
  std::vector<btBroadphasePair> carried_;
  std::size_t first_carried_ = 0;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
