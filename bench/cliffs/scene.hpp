// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// The boxes that all methods of a comparison hold: cubes of sides around 1 with half a pair each. They sway: frame f
/// is frame f % frames.
class CliffScene {
 public:
  static constexpr std::size_t frames = 8;

  explicit CliffScene(std::size_t n);

  std::size_t size() const { return all_.size(); }
  /// Of frame 0.
  std::size_t pairs() const { return pairs_; }
  /// All ranks.
  Span<const std::uint32_t> all() const { return all_; }
  /// Box i in a frame.
  const Aabb& at(std::size_t frame, std::size_t i) const { return boxes_[frame % frames * size() + i]; }
  Span<const Aabb> frame(std::size_t frame) const { return {boxes_.data() + frame % frames * size(), size()}; }
  /// The same boxes, each at the place of another.
  Span<const Aabb> jumped(std::size_t frame) const { return {jumped_.data() + frame % frames * size(), size()}; }

 private:
  std::vector<std::uint32_t> all_;
  std::vector<Aabb> boxes_, jumped_;
  std::size_t pairs_ = 0;
};

}  // namespace boxstream::bench
