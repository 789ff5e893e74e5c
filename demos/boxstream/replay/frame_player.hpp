// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace boxstream::tool {

/// A broad-phase that is given the boxes of the same objects, frame after frame, all of them each time.
class FramePlayer {
 public:
  virtual ~FramePlayer() = default;

  /// As many boxes as the first time. Returns the time from the first box to the last pair.
  virtual std::chrono::nanoseconds play(Span<const Aabb> boxes) = 0;
  /// The pairs it holds, as numbers of boxes, sorted; near misses included.
  virtual std::vector<Pair> held() const = 0;
};

/// `name` is "world" or one of broadphase_names(); `world` and `objects` are for those that need them. Those of Bullet
/// throw record::RecordError where they hold more than `most_pairs`, near misses included.
std::unique_ptr<FramePlayer> make_frame_player(const std::string& name, const Aabb& world, std::size_t objects,
                                               std::uint64_t most_pairs);

}  // namespace boxstream::tool
