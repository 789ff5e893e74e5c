// SPDX-License-Identifier: MIT
// A search of boxes in an order that is named, to have its instructions counted: see orders_test.py.
#include <algorithm>
#include <cstdio>
#include <string>

#include "box_sets.hpp"
#include "random.hpp"

namespace boxstream::tests {
namespace {

/// The order in which a quicksort that takes the median of three for its pivot needs quadratic time (Musser 1997).
template <class T>
std::vector<T> against_median_of_three(const std::vector<T>& sorted) {
  std::vector<T> order = sorted;
  const std::size_t half = sorted.size() / 4 * 2;
  for (std::size_t i = 0; i < half; ++i) {
    order[i] = sorted[i % 2 == 0 ? i : half + i - 1];
    order[half + i] = sorted[2 * i + 1];
  }
  return order;
}

bool put_in_order(Boxes<float>& boxes, const std::string& order) {
  std::sort(boxes.begin(), boxes.end(), [](const Aabb& x, const Aabb& y) { return x.min[0] < y.min[0]; });
  const std::size_t n = boxes.size();
  const auto sorted = boxes;
  if (order == "shuffled") {
    Random(9).shuffle(boxes);
  } else if (order == "reversed") {
    std::reverse(boxes.begin(), boxes.end());
  } else if (order == "organ_pipe") {
    for (std::size_t i = 0; i < n; ++i) boxes[i % 2 == 0 ? i / 2 : n - 1 - i / 2] = sorted[i];
  } else if (order == "two_runs") {
    for (std::size_t i = 0; i < n; ++i) boxes[i] = sorted[i % 2 == 0 ? i / 2 : (n + 1) / 2 + i / 2];
  } else if (order == "against_median_of_three") {
    boxes = against_median_of_three(sorted);
  } else {
    return order == "sorted";
  }
  return true;
}

}  // namespace
}  // namespace boxstream::tests

/// usage: ... BOX_SET SIZE ORDER
int main(int count, char** arguments) {
  using namespace boxstream;
  using namespace boxstream::tests;
  if (count != 4) return 2;
  auto boxes = box_set<float>(arguments[1]).make(std::stoul(arguments[2]), 1);
  if (!put_in_order(boxes, arguments[3])) return 2;
  std::uint64_t pairs = 0;
  Detector().stream_pairs(boxes, [&](Span<const Pair> found) {
    pairs += found.size();
    return true;
  });
  std::printf("%llu pairs\n", static_cast<unsigned long long>(pairs));
}
