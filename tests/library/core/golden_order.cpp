// SPDX-License-Identifier: MIT
#include "golden_order.hpp"

#include <algorithm>
#include <cstdio>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "box_sets.hpp"

namespace boxstream::tests {

namespace {

std::string line(const std::string& scene, const Pairs& pairs) {
  char text[64];
  std::snprintf(text, sizeof text, " %zu %016llx", pairs.size(),
                static_cast<unsigned long long>(order_hash(pairs)));  // NOLINT(google-runtime-int): for the format
  return scene + text;
}

/// Five frames in which a third of the boxes jump, all drift, and some leave, so that each way in which a World
/// searches is taken. What begins and ends, and what is held at last, make one list.
template <class S>
Pairs frames(const BoxSet<S>& set, std::size_t n, Executor* executor) {
  BasicWorld<S> world(WorldOptions{executor});
  auto boxes = set.make(n, 1);
  const auto elsewhere = set.make(n, 2);
  std::vector<ProxyId> ids(n);
  world.create(boxes, {}, ids);
  Pairs told;
  const auto tell = [&told](Span<const ProxyPair> pairs) {
    for (const ProxyPair& pair : pairs) told.push_back({pair.a.slot, pair.b.slot});
  };
  for (std::size_t frame = 0; frame < 5; ++frame) {
    for (std::size_t i = 0; i < n; ++i) {
      if (i % 3 == frame) boxes[i] = elsewhere[i];
      for (S* bound : {&boxes[i].min[frame % 3], &boxes[i].max[frame % 3]}) *bound += S(1) / S(64);
      world.move(ids[i], boxes[i]);
    }
    if (frame == 3)
      for (std::size_t i = 0; i < n; i += 7) world.destroy(ids[i]);
    world.update();
    tell(world.begun());
    tell(world.ended());
  }
  world.for_each_pair([&](ProxyPair pair) {
    tell(Span<const ProxyPair>(&pair, 1));
    return true;
  });
  return told;
}

template <class S>
void add_lines(Executor* executor, std::vector<std::string>& lines) {
  const std::string scalar = sizeof(S) == 4 ? " float" : " double";
  Detector detector(DetectorOptions{executor});
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
      const std::size_t in_frames = std::min<std::size_t>(n, 3000);
      lines.push_back(
          line(set.name + " " + std::to_string(in_frames) + scalar + " frames", frames(set, in_frames, executor)));
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

std::vector<std::string> golden_order(Executor* executor) {
  std::vector<std::string> lines;
  add_lines<float>(executor, lines);
  add_lines<double>(executor, lines);
  return lines;
}

}  // namespace boxstream::tests
