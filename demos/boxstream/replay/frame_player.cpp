// SPDX-License-Identifier: MIT
#include "boxstream/replay/frame_player.hpp"

#include <algorithm>
#include <boxstream/world.hpp>
#include <numeric>

#include "formats/record/player.hpp"
#include "formats/scene_model/values.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/engine/broadphases.hpp"

namespace boxstream::tool {
namespace {

class OnWorld final : public FramePlayer {
 public:
  std::chrono::nanoseconds play(Span<const Aabb> boxes) override {
    const bool first = ids_.empty();
    std::vector<std::uint64_t> numbers;
    if (first) {
      ids_.resize(boxes.size());
      numbers.resize(boxes.size());
      std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
    }
    const auto start = measure::now();
    if (first)
      world_.create(boxes, {}, ids_, numbers);
    else
      world_.move(ids_, boxes);
    world_.update();
    return measure::now() - start;
  }

  std::vector<Pair> held() const override {
    std::vector<Pair> pairs;
    pairs.reserve(world_.pair_count());
    world_.for_each_pair([&](ProxyPair pair) {
      const auto a = static_cast<std::uint32_t>(world_.user(pair.a)),
                 b = static_cast<std::uint32_t>(world_.user(pair.b));
      pairs.push_back({std::min(a, b), std::max(a, b)});
      return true;
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

 private:
  World world_;
  std::vector<ProxyId> ids_;
};

Aabb64 widened(const Aabb& box) {
  return {{box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}};
}

class OnBullet final : public FramePlayer {
 public:
  OnBullet(const std::string& name, const scenes::Bounds& bounds, std::size_t objects, std::uint64_t most_pairs)
      : player_(name, scenes::make_broadphase(name, bounds, objects), most_pairs) {}

  std::chrono::nanoseconds play(Span<const Aabb> boxes) override {
    const bool first = calls_.empty();
    calls_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const auto id = static_cast<std::uint32_t>(i);
      if (first)
        calls_.emplace_back(record::Create{id, 0, 1, -1, widened(boxes[i])});
      else
        calls_.emplace_back(record::Move{id, widened(boxes[i])});
    }
    calls_.emplace_back(record::Batch{});
    const auto start = measure::now();
    for (const record::Op& call : calls_) player_.apply(call);
    return measure::now() - start;
  }

  std::vector<Pair> held() const override { return player_.held(); }

 private:
  record::Player player_;
  std::vector<record::Op> calls_;
};

}  // namespace

std::unique_ptr<FramePlayer> make_frame_player(const std::string& name, const Aabb& world, std::size_t objects,
                                               std::uint64_t most_pairs) {
  if (name == "world") return std::make_unique<OnWorld>();
  scenes::Bounds bounds;
  std::copy(std::begin(world.min), std::end(world.min), bounds.min.begin());
  std::copy(std::begin(world.max), std::end(world.max), bounds.max.begin());
  return std::make_unique<OnBullet>(name, bounds, objects, most_pairs);
}

}  // namespace boxstream::tool
