// SPDX-License-Identifier: MIT
#include <algorithm>

#include "peers/plain.hpp"
#include "peers/soa.hpp"

namespace boxstream::bench {

namespace {

/// Sort along the axis where the boxes are spread most, then compare each box with those that start inside it.
class Sweep final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    const std::size_t n = boxes.size();
    const int axis = widest_axis(boxes);
    order_.resize(n);
    for (std::size_t i = 0; i < n; ++i) order_[i] = {boxes[i].min[axis], static_cast<std::uint32_t>(i)};
    std::sort(order_.begin(), order_.end());
    arrays_.resize(n);
    for (std::size_t i = 0; i < n; ++i) arrays_.set(i, boxes[order_[i].second], order_[i].second);

    const std::vector<float>& low = arrays_.low[axis];
    const std::vector<float>& high = arrays_.high[axis];
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t end = i + 1;
      while (end < n && low[end] <= high[i]) ++end;
      arrays_.match(i, i + 1, end, pairs);
    }
  }

 private:
  static int widest_axis(Span<const Aabb> boxes) {
    int axis = 0;
    double largest = -1;
    for (int d = 0; d < 3; ++d) {
      double sum = 0, squares = 0;
      for (const Aabb& box : boxes) {
        const double centre = 0.5 * (static_cast<double>(box.min[d]) + static_cast<double>(box.max[d]));
        sum += centre;
        squares += centre * centre;
      }
      const double variance = squares - sum * sum / static_cast<double>(boxes.size());
      if (variance > largest) {
        largest = variance;
        axis = d;
      }
    }
    return axis;
  }

  std::vector<std::pair<float, std::uint32_t>> order_;
  BoxArrays arrays_;
};

}  // namespace

std::unique_ptr<Peer> make_sweep() {
  return std::make_unique<Sweep>();
}

}  // namespace boxstream::bench
