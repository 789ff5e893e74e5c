// SPDX-License-Identifier: MIT
#include <CGAL/box_intersection_d.h>

#include <cstddef>
#include <string>

#include "peers/cgal_box.hpp"
#include "peers/cross.hpp"
#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

class Cgal final : public Peer {
 public:
  explicit Cgal(std::size_t cutoff) : cutoff_(static_cast<std::ptrdiff_t>(cutoff)) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    copy_boxes(boxes, 0, copy_);
    const auto report = [&pairs](const CgalBox& a, const CgalBox& b) {
      pairs.push_back(a.index < b.index ? Pair{a.index, b.index} : Pair{b.index, a.index});
    };
    CGAL::box_self_intersection_d(copy_.begin(), copy_.end(), report, cutoff_, CGAL::Box_intersection_d::CLOSED);
  }

 private:
  std::ptrdiff_t cutoff_;
  std::vector<CgalBox> copy_;
};

}  // namespace

CrossSearch make_cgal_cross(std::size_t cutoff) {
  return [cutoff = static_cast<std::ptrdiff_t>(cutoff), copy_a = std::vector<CgalBox>(),
          copy_b = std::vector<CgalBox>()](Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) mutable {
    pairs.clear();
    const auto first_b = static_cast<std::uint32_t>(a.size());
    copy_boxes(a, 0, copy_a);
    copy_boxes(b, first_b, copy_b);
    const auto report = [&](const CgalBox& x, const CgalBox& y) { pairs.push_back({x.index, y.index - first_b}); };
    CGAL::box_intersection_d(copy_a.begin(), copy_a.end(), copy_b.begin(), copy_b.end(), report, cutoff,
                             CGAL::Box_intersection_d::CLOSED);
  };
}

std::vector<PeerConfig> make_cgal_peers() {
  std::vector<PeerConfig> peers;
  for (const std::size_t cutoff : cgal_cutoffs)
    peers.push_back({"cgal:" + std::to_string(cutoff), "cgal", 1, "", std::make_unique<Cgal>(cutoff)});
  return peers;
}

}  // namespace boxstream::bench
