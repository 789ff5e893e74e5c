// SPDX-License-Identifier: MIT
// 1024 worlds of 100 bodies that fly about and bounce off each other, as learning and planning step them: one search a
// step finds the pairs of all worlds, and what was not there a step before has begun.
#include <boxstream/boxstream.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <vector>

namespace {

constexpr std::size_t worlds = 1024, bodies = 100;
constexpr float room = 15, side = 1;

struct Body {
  float at[3], speed[3];  // multiples of 1/64, so that sums are exact
};

std::uint32_t state = 1;
float random_multiple(int least, int most) {
  state = state * 1664525 + 1013904223;
  return float(least + int((state >> 8) % std::uint32_t(most - least + 1))) / 64;
}

Body random_body() {
  Body body;
  for (float& x : body.at) x = random_multiple(0, int(room) * 64);
  for (float& v : body.speed) v = random_multiple(-8, 8);
  return body;
}

/// Off the walls.
void move(Body& body) {
  for (int d = 0; d < 3; ++d) {
    body.at[d] += body.speed[d];
    if (body.at[d] < 0 || body.at[d] > room) {
      body.speed[d] = -body.speed[d];
      body.at[d] += 2 * body.speed[d];
    }
  }
}

boxstream::Aabb box_of(const Body& body) {
  const float* const x = body.at;
  return {{x[0], x[1], x[2]}, {x[0] + side, x[1] + side, x[2] + side}};
}

}  // namespace

int main() {
  std::vector<Body> all(worlds * bodies);
  std::vector<boxstream::Aabb> boxes(all.size());
  std::vector<std::uint64_t> offsets;  // world i has boxes offsets[i] to offsets[i + 1]
  for (std::size_t world = 0; world <= worlds; ++world) offsets.push_back(world * bodies);
  std::generate(all.begin(), all.end(), random_body);

  boxstream::Detector detector;
  boxstream::PairsOfSets now, before{{}, std::vector<std::uint64_t>(worlds + 1, 0)};
  std::vector<boxstream::Pair> begun;
  std::size_t total = 0, resets = 0;
  for (int step = 1; step <= 60; ++step) {
    std::for_each(all.begin(), all.end(), move);
    std::transform(all.begin(), all.end(), boxes.begin(), box_of);
    const boxstream::Stats stats = detector.find_pairs(boxes, offsets, now);
    for (std::size_t world = 0; world < worlds; ++world) {
      const auto first = now.pairs.begin() + std::ptrdiff_t(now.offsets[world]);
      const auto last = now.pairs.begin() + std::ptrdiff_t(now.offsets[world + 1]);
      const auto old_first = before.pairs.begin() + std::ptrdiff_t(before.offsets[world]);
      const auto old_last = before.pairs.begin() + std::ptrdiff_t(before.offsets[world + 1]);
      std::sort(first, last);
      begun.clear();
      std::set_difference(first, last, old_first, old_last, std::back_inserter(begun));
      for (const auto [a, b] : begun) std::swap(all[a].speed, all[b].speed);  // of equal mass
      total += begun.size();
      // A world where much has happened begins anew: its bodies are set, and it holds no pairs.
      if (begun.size() >= 20) {
        std::generate_n(all.begin() + std::ptrdiff_t(offsets[world]), bodies, random_body);
        std::fill(first, last, boxstream::Pair{});
        ++resets;
      }
    }
    std::swap(now, before);
    if (step % 20 == 0) std::printf("step %d: %zu pairs, %zu have begun\n", step, std::size_t(stats.pairs), total);
  }
  std::printf("%zu times a world began anew\n", resets);
}
