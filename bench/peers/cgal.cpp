// SPDX-License-Identifier: MIT
#include <CGAL/box_intersection_d.h>

#include <cstdint>

#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

/// A model of CGAL's concept BoxIntersectionBox_d: 28 bytes, its id explicit.
struct CgalBox {
  using NT = float;
  using ID = std::uint32_t;

  static int dimension() { return 3; }
  ID id() const { return index; }
  NT min_coord(int d) const { return box.min[d]; }
  NT max_coord(int d) const { return box.max[d]; }

  Aabb box;
  std::uint32_t index;
};

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

}  // namespace

std::unique_ptr<Peer> make_cgal(std::size_t cutoff) {
  return std::make_unique<Cgal>(cutoff);
}

}  // namespace boxstream::bench
