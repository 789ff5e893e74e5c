// SPDX-License-Identifier: MIT
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

namespace {

/// One thread.
class WorldAlone final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override {
    world_.clear();
    ids_.assign(boxes.size(), {});
    world_.create(boxes, {}, ids_);
    for (std::size_t i = 0; i < ids_.size(); ++i) note(ids_[i], static_cast<std::uint32_t>(i));
    // The first query builds the index.
    if (!boxes.empty()) world_.query_box(boxes[0], [](ProxyId) { return false; });
  }

  void query_box(const Aabb& box, VisitNumber visit) const override {
    world_.query_box(box, [&](ProxyId id) {
      visit(number_of(id));
      return true;
    });
  }

  FirstHit first_hit(const Ray& ray) const override {
    FirstHit first;
    world_.query_ray(ray, [&](ProxyId id, float enter, float) {
      first.offer(enter, number_of(id));
      return first.enter;
    });
    return first;
  }

  void insert(std::uint32_t number, const Aabb& box) override {
    if (ids_.size() <= number) ids_.resize(number + 1);
    ids_[number] = world_.create(box);
    note(ids_[number], number);
  }

  void erase(std::uint32_t number) override { world_.destroy(ids_[number]); }

  void next_frame(Span<const Aabb> boxes, Found found) override {
    world_.move(ids_, boxes);
    world_.update();
    world_.stream_pairs([&](Span<const ProxyPair> pairs) {
      for (const ProxyPair& pair : pairs) found(number_of(pair.a), number_of(pair.b));
      return true;
    });
  }

 private:
  std::uint32_t number_of(ProxyId id) const { return numbers_[id.slot]; }

  void note(ProxyId id, std::uint32_t number) {
    if (numbers_.size() <= id.slot) numbers_.resize(id.slot + 1);
    numbers_[id.slot] = number;
  }

  World world_;
  std::vector<ProxyId> ids_;            // by number
  std::vector<std::uint32_t> numbers_;  // by slot
};

/// All pairs from scratch; nothing is kept but memory.
class DetectorAlone final : public Structure {
 public:
  void build(Span<const Aabb> boxes) override { boxes_.assign(boxes.begin(), boxes.end()); }

  void find_pairs(Span<const Aabb> others, Found found) const override {
    detector_.stream_pairs(boxes_, others, [&](Span<const Pair> pairs) {
      for (const Pair pair : pairs) found(pair.a, pair.b);
      return true;
    });
  }

  void next_frame(Span<const Aabb> boxes, Found found) override {
    detector_.stream_pairs(boxes, [&](Span<const Pair> pairs) {
      for (const Pair pair : pairs) found(pair.a, pair.b);
      return true;
    });
  }

 private:
  std::vector<Aabb> boxes_;
  mutable Detector detector_;
};

}  // namespace

std::vector<StructureEntry> engine_structures() {
  return {{"boxstream", box_work | ray_work | update_work | frame_work, make_structure<WorldAlone>},
          {"boxstream batch", pair_work | frame_work, make_structure<DetectorAlone>}};
}

}  // namespace boxstream::papers
