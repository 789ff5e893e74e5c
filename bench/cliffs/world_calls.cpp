// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <memory>

#include <boxstream/world.hpp>

#include "cliffs/keeper.hpp"

namespace boxstream::bench {

namespace {

class WorldKeeper final : public Keeper {
 public:
  void fill(Span<const Aabb> boxes) override {
    ids_.resize(boxes.size());
    users_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) users_[i] = i;
    world.create(boxes, {}, ids_, users_);
  }
  void remove(std::uint32_t i) override { world.destroy(ids_[i]); }
  void add(std::uint32_t i, const Aabb& box) override { ids_[i] = world.create(box, {}, i); }
  void come(const Aabb& box) override { newcomer_ = world.create(box, {}, ids_.size()); }
  void leave() override { world.destroy(newcomer_); }
  void move(Span<const std::uint32_t> which, Span<const Aabb> boxes) override {
    if (which.size() == ids_.size()) {
      world.move(ids_, boxes);
      return;
    }
    for (const std::uint32_t i : which) world.move(ids_[i], boxes[i]);
  }
  void update() override { world.update(); }
  PairSummary pairs(Span<const Aabb>) override {
    PairSummary summary;
    world.for_each_pair([&](ProxyPair pair) {
      summary.add(static_cast<std::uint32_t>(world.user(pair.a)), static_cast<std::uint32_t>(world.user(pair.b)));
      return true;
    });
    return summary;
  }
  ProxyId id(std::size_t i) const { return ids_[i]; }

  World world;

 private:
  std::vector<ProxyId> ids_;
  ProxyId newcomer_;
  std::vector<std::uint64_t> users_;
};

std::unique_ptr<Keeper> make_world_keeper() {
  return std::make_unique<WorldKeeper>();
}

World& world_of(Keeper& keeper) {
  return static_cast<WorldKeeper&>(keeper).world;
}

/// Another one each time.
std::size_t next_of(Keeper& keeper, const CliffScene& scene) {
  return ++keeper.turn * 7 % scene.size();
}

/// The box around one of the scene, this much larger.
Aabb wider(const Aabb& box, float by) {
  Aabb wide = box;
  for (int d = 0; d < 3; ++d) {
    wide.min[d] -= by;
    wide.max[d] += by;
  }
  return wide;
}

std::uint64_t create_all(Keeper&, const CliffScene& scene) {
  WorldKeeper keeper;
  keeper.fill(scene.frame(0));
  keeper.update();
  return keeper.world.pair_count();
}

std::uint64_t query_box(Keeper& keeper, const CliffScene& scene) {
  std::uint64_t found = 0;
  world_of(keeper).query_box(wider(scene.at(0, next_of(keeper, scene)), 1), [&](ProxyId) { return ++found > 0; });
  return found;
}

std::uint64_t query_ray(Keeper& keeper, const CliffScene& scene) {
  const Aabb& box = scene.at(0, next_of(keeper, scene));
  std::uint64_t found = 0;
  world_of(keeper).query_ray(Ray::along(box.min, {1, 0.5f, 0.25f}, 8.0f), [&](ProxyId, float, float length) {
    ++found;
    return length;
  });
  return found;
}

std::uint64_t query_nearest(Keeper& keeper, const CliffScene& scene) {
  ProxyId nearest[4];
  return world_of(keeper).query_nearest(scene.at(1, next_of(keeper, scene)).min, nearest);
}

std::uint64_t query_nearest_box(Keeper& keeper, const CliffScene& scene) {
  Aabb away = scene.at(0, next_of(keeper, scene));
  away.min[0] += 1.5f;
  away.max[0] += 1.5f;
  float least = std::numeric_limits<float>::infinity();
  world_of(keeper).query_nearest_box(away, least,
                                     [&](ProxyId, float distance) { return least = std::min(least, distance); });
  return 0;
}

std::uint64_t query_planes(Keeper& keeper, const CliffScene& scene) {
  const Aabb& box = scene.at(0, next_of(keeper, scene));
  const Plane planes[] = {{{1, 0, 0}, -box.min[0]}, {{-1, 0, 0}, box.max[0]}, {{0, 1, 0.5f}, -box.min[1]}};
  std::uint64_t found = 0;
  world_of(keeper).query_planes(planes, [&](ProxyId) { return ++found > 0; });
  return found;
}

std::uint64_t nearest_pairs(Keeper& keeper, const CliffScene&) {
  std::uint64_t found = 0;
  world_of(keeper).nearest_pairs(0.1f, [&](ProxyPair, float) {
    ++found;
    return 0.1f;
  });
  return 0;
}

std::uint64_t for_each_pair(Keeper& keeper, const CliffScene&) {
  std::uint64_t found = 0;
  world_of(keeper).for_each_pair([&](ProxyPair) { return ++found > 0; });
  return found;
}

std::uint64_t stream_pairs(Keeper& keeper, const CliffScene&) {
  std::uint64_t found = 0;
  world_of(keeper).stream_pairs([&](Span<const ProxyPair> pairs) { return (found += pairs.size()) > 0; });
  return found;
}

std::uint64_t set_filter(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<WorldKeeper&>(keeper);
  const std::size_t i = next_of(keeper, scene);
  of.world.set_filter(of.id(i), {2, 1});
  of.world.update();
  of.world.set_filter(of.id(i), {});
  of.world.update();
  return of.world.pair_count();
}

std::uint64_t refilter(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<WorldKeeper&>(keeper);
  of.world.refilter(of.id(next_of(keeper, scene)));
  of.world.update();
  return of.world.pair_count();
}

std::uint64_t refilter_all(Keeper& keeper, const CliffScene&) {
  world_of(keeper).refilter();
  world_of(keeper).update();
  return world_of(keeper).pair_count();
}

std::uint64_t begin_pairs_of(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<WorldKeeper&>(keeper);
  of.world.begin_pairs_of(
      of.id(next_of(keeper, scene)), [](ProxyId, ProxyId) { return true; }, [](ProxyPair) {});
  return of.world.pair_count();
}

std::uint64_t release(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<WorldKeeper&>(keeper);
  const std::size_t i = next_of(keeper, scene);
  of.world.release(of.id(i), of.id((i + 1) % scene.size()));
  of.world.update();
  return of.world.pair_count();
}

std::uint64_t pair_place(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<WorldKeeper&>(keeper);
  const std::size_t i = next_of(keeper, scene);
  return of.world.pair_place(of.id(i), of.id((i + 1) % scene.size())).has_value();
}

/// A query when all boxes have moved since the last one.
std::uint64_t query_after_moves(Keeper& keeper, const CliffScene& scene) {
  ++keeper.turn;
  keeper.move(scene.all(), scene.frame(keeper.turn));
  std::uint64_t found = 0;
  world_of(keeper).query_box(scene.at(keeper.turn, keeper.turn * 7 % scene.size()),
                             [&](ProxyId) { return ++found > 0; });
  return found;
}

}  // namespace

std::vector<CliffCall> world_calls() {
  std::unique_ptr<Keeper> (*peer)() = nullptr;
#ifdef BOXSTREAM_BENCH_CLIFFS_BULLET
  peer = make_dbvt_keeper;
#endif
  std::vector<CliffCall> calls = frame_calls("World", make_world_keeper, peer);
  const auto add = [&](const char* name, const char* description, auto run, bool has_history = true) {
    calls.push_back({"World", name, description, make_world_keeper, nullptr, run, has_history});
  };
  add("create", "a World is made, filled, updated once and dropped", create_all, false);
  add("query_box", "one box a little larger than those of the scene", query_box);
  add("query_ray", "one ray of eight sides", query_ray);
  add("query_nearest", "the four nearest to a point", query_nearest);
  add("query_nearest_box", "the least distance of one box", query_nearest_box);
  add("query_planes", "three planes", query_planes);
  add("query after moves", "all boxes move, then query_box", query_after_moves);
  add("nearest_pairs", "pairs nearer than a tenth of a side", nearest_pairs);
  add("for_each_pair", "all pairs held", for_each_pair);
  add("stream_pairs", "all pairs held", stream_pairs);
  add("set_filter", "of one box, and back, each with an update", set_filter);
  add("refilter of one", "with an update", refilter);
  add("refilter of all", "with an update", refilter_all);
  add("begin_pairs_of", "one box", begin_pairs_of);
  add("release", "one pair, with an update", release);
  add("pair_place", "one pair", pair_place);
  return calls;
}

}  // namespace boxstream::bench
