// SPDX-License-Identifier: MIT
#include "formats/record/expected_pairs.hpp"

#include <algorithm>

#include "base/sorted_sweep.hpp"

namespace boxstream::record {

void ExpectedPairs::apply(const Op& op) {
  if (const auto* const create = std::get_if<Create>(&op))
    proxies_.push_back({create->box, create->group, create->mask, true});
  else if (const auto* const move = std::get_if<Move>(&op))
    proxies_[move->id].box = move->box;
  else if (const auto* const destroy = std::get_if<Destroy>(&op))
    proxies_[destroy->id].alive = false;
  else if (const auto* const refilter = std::get_if<Refilter>(&op)) {
    proxies_[refilter->id].group = refilter->group;
    proxies_[refilter->id].mask = refilter->mask;
  }
}

namespace {

/// The axis along which lower bounds are spread most, but for the tenth at either end: those of planes are far away.
template <class Boxes>
int widest_axis(const Boxes& proxies, const std::vector<std::uint32_t>& order) {
  if (order.empty()) return 0;
  std::vector<double> lows(order.size());
  int widest = 0;
  double most = -1;
  for (int d = 0; d < 3; ++d) {
    std::transform(order.begin(), order.end(), lows.begin(), [&](std::uint32_t id) { return proxies[id].box.min[d]; });
    const auto first = lows.begin() + static_cast<std::ptrdiff_t>(lows.size() / 10);
    const auto last = lows.end() - 1 - static_cast<std::ptrdiff_t>(lows.size() / 10);
    std::nth_element(lows.begin(), first, lows.end());
    const double low = *first;
    std::nth_element(lows.begin(), last, lows.end());
    const double spread = *last - low;
    if (spread > most) {
      most = spread;
      widest = d;
    }
  }
  return widest;
}

}  // namespace

const std::vector<Pair>& ExpectedPairs::pairs(std::uint64_t most) {
  order_.clear();
  for (std::uint32_t id = 0; id < proxies_.size(); ++id)
    if (proxies_[id].alive && is_valid(proxies_[id].box)) order_.push_back(id);
  const int axis = widest_axis(proxies_, order_);
  std::swap(former_, expected_);
  expected_.clear();
  sorted_sweep(
      order_, axis, [&](std::uint32_t id) -> const Aabb64& { return proxies_[id].box; },
      [&](Pair pair) {
        if (!accepts(pair) && !std::binary_search(former_.begin(), former_.end(), pair)) return;
        expected_.push_back(pair);
        check_pairs(expected_.size(), most);
      });
  std::sort(expected_.begin(), expected_.end());
  return expected_;
}

std::vector<std::uint32_t> ExpectedPairs::in_box(const Aabb64& box) const {
  std::vector<std::uint32_t> found;
  for (std::uint32_t id = 0; id < proxies_.size(); ++id)
    if (overlap(id, box)) found.push_back(id);
  return found;
}

bool ExpectedPairs::overlap(Pair pair) const {
  return is_alive(pair.b) && overlap(pair.a, proxies_[pair.b].box);
}

bool ExpectedPairs::overlap(std::uint32_t id, const Aabb64& box) const {
  return is_alive(id) && is_valid(proxies_[id].box) && is_valid(box) && overlaps(proxies_[id].box, box);
}

bool ExpectedPairs::accepts(Pair pair) const {
  const Proxy &a = proxies_[pair.a], &b = proxies_[pair.b];
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0;
}

}  // namespace boxstream::record
