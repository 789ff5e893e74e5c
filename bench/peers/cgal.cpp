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
    // CGAL permutes its input, so each call starts from a fresh copy.
    copy_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) copy_[i] = {boxes[i], static_cast<std::uint32_t>(i)};
    const auto report = [&pairs](const CgalBox& a, const CgalBox& b) {
      pairs.push_back(a.index < b.index ? Pair{a.index, b.index} : Pair{b.index, a.index});
    };
    CGAL::box_self_intersection_d(copy_.begin(), copy_.end(), report, cutoff_, CGAL::Box_intersection_d::CLOSED);
  }

 private:
  std::ptrdiff_t cutoff_;
  std::vector<CgalBox> copy_;
};

class CgalCross final : public CrossPeer {
 public:
  explicit CgalCross(std::size_t cutoff) : cutoff_(static_cast<std::ptrdiff_t>(cutoff)) {}

  void find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) override {
    pairs.clear();
    // Boxes of the same id are taken for one and the same.
    const auto first_b = static_cast<std::uint32_t>(a.size());
    copy(a, 0, copy_a_);
    copy(b, first_b, copy_b_);
    const auto report = [&](const CgalBox& x, const CgalBox& y) { pairs.push_back({x.index, y.index - first_b}); };
    CGAL::box_intersection_d(copy_a_.begin(), copy_a_.end(), copy_b_.begin(), copy_b_.end(), report, cutoff_,
                             CGAL::Box_intersection_d::CLOSED);
  }

 private:
  static void copy(Span<const Aabb> boxes, std::uint32_t first_id, std::vector<CgalBox>& copy) {
    copy.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) copy[i] = {boxes[i], first_id + static_cast<std::uint32_t>(i)};
  }

  std::ptrdiff_t cutoff_;
  std::vector<CgalBox> copy_a_, copy_b_;
};

}  // namespace

std::unique_ptr<CrossPeer> make_cgal_cross(std::size_t cutoff) {
  return std::make_unique<CgalCross>(cutoff);
}

std::vector<PeerConfig> make_cgal_peers() {
  std::vector<PeerConfig> peers;
  for (const std::size_t cutoff : cgal_cutoffs)
    peers.push_back({"cgal:" + std::to_string(cutoff), "cgal", 1, "", std::make_unique<Cgal>(cutoff)});
  return peers;
}

}  // namespace boxstream::bench
