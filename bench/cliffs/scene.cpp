// SPDX-License-Identifier: MIT
#include "cliffs/scene.hpp"

#include <cmath>
#include <numeric>
#include <random>

#include <boxstream/detector.hpp>

namespace boxstream::bench {

CliffScene::CliffScene(std::size_t n) : all_(n) {
  std::iota(all_.begin(), all_.end(), 0u);
  std::mt19937_64 engine(n);
  const auto random = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(engine() >> 11) / 9007199254740992.0);
  };
  const double room = std::cbrt(8.0 * static_cast<double>(n));
  std::vector<Aabb> homes(n);
  for (Aabb& home : homes)
    for (int d = 0; d < 3; ++d) {
      home.min[d] = random(0, room);
      home.max[d] = home.min[d] + random(0.5, 1.5);
    }
  for (std::size_t f = 0; f < frames; ++f) {
    std::vector<Aabb> now = homes;
    for (Aabb& box : now)
      for (int d = 0; d < 3; ++d) {
        const float away = random(-0.05, 0.05);
        box.min[d] += away;
        box.max[d] += away;
      }
    boxes_.insert(boxes_.end(), now.begin(), now.end());
    const std::size_t shift = f * (n / 3 + 1);
    for (std::size_t i = 0; i < n; ++i) jumped_.push_back(now[(i + shift) % n]);
  }
  pairs_ = find_pairs(frame(0)).size();
}

}  // namespace boxstream::bench
