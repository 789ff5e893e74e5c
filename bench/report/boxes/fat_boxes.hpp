// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <boxstream/world.hpp>

#include "peers/peer.hpp"

namespace boxstream::report {

/// Searches fat boxes, so that pairs stay valid until a box exits its fat box: then that one gets a new fat box, and is
/// searched for again. Candidates are the pairs whose fat boxes touch: all that touch, and extra ones.
///
/// It does not predict motion: the margin is the same on both sides.
class FatBoxes final : public bench::Peer {
 public:
  /// The margin on each side, as a share of the mean side of the box: 0.05 for 5 %. `tested`: returned are the
  /// candidates that touch, else all candidates.
  FatBoxes(double share, bool tested) : share_(share), tested_(tested) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override;
  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) override;
  void release() override { world_.reset(); }

  /// The number of boxes that exited in the last frame.
  std::size_t exits() const { return exited_.size(); }

 private:
  Aabb fattened(const Aabb& box) const;
  void list_candidates();
  void hand_over(Span<const Aabb> boxes, std::vector<Pair>& pairs) const;

  double share_;
  bool tested_;
  std::optional<World> world_;
  std::vector<ProxyId> ids_, exited_;
  std::vector<Aabb> fat_, exited_fat_;
  std::vector<Pair> candidates_;
};

}  // namespace boxstream::report
