// SPDX-License-Identifier: MIT
#include "golden_order.hpp"

#include <algorithm>
#include <cstdio>

#include "box_sets.hpp"

namespace boxstream::tests {

namespace {

std::string line(const std::string& scene, const Pairs& pairs) {
  char text[64];
  std::snprintf(text, sizeof text, " %zu %016llx", pairs.size(),
                static_cast<unsigned long long>(order_hash(pairs)));  // NOLINT(google-runtime-int): for the format
  return scene + text;
}

template <class S>
void add_lines(Detector& detector, std::vector<std::string>& lines) {
  const std::string scalar = sizeof(S) == 4 ? " float" : " double";
  Pairs pairs;
  for (const auto& set : box_sets<S>()) {
    // Small enough to be compared at once; then large enough for a tree, and for an executor to be asked.
    for (const std::size_t n : {std::size_t{50}, std::min<std::size_t>(20000, set.largest)}) {
      const auto a = set.make(n, 1), b = set.make(n / 3, 2);
      const std::string scene = set.name + " " + std::to_string(n) + scalar;
      detector.find_pairs(a, pairs);
      lines.push_back(line(scene + " one_set", pairs));
      detector.find_pairs(a, b, pairs);
      lines.push_back(line(scene + " two_sets", pairs));
    }
  }
}

}  // namespace

std::uint64_t order_hash(Span<const Pair> pairs) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Pair pair : pairs)
    for (const std::uint32_t id : {pair.a, pair.b})
      for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ (id >> shift & 0xff)) * 0x100000001b3u;
  return hash;
}

std::vector<std::string> golden_order(Detector& detector) {
  std::vector<std::string> lines;
  add_lines<float>(detector, lines);
  add_lines<double>(detector, lines);
  return lines;
}

}  // namespace boxstream::tests
