// SPDX-License-Identifier: MIT
// What one writes when there are few boxes: no columns, no buffers but one.
#include "peers/plain.hpp"
#include "peers/sorted_sweep.hpp"

namespace boxstream::bench {

namespace {

class BareLoop final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    const auto n = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = i + 1; j < n; ++j)
        if (overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  }
};

class SortedSweep final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    sorted_sweep<float>(boxes, order_, pairs);
  }

 private:
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::unique_ptr<Peer> make_bare_loop() {
  return std::make_unique<BareLoop>();
}
std::unique_ptr<Peer> make_sorted_sweep() {
  return std::make_unique<SortedSweep>();
}

}  // namespace boxstream::bench
