// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include <boxstream/detector.hpp>

#include "cliffs/keeper.hpp"

namespace boxstream::bench {

namespace {

/// Nothing is held but scratch: histories are searches of other boxes before.
class DetectorKeeper final : public Keeper {
 public:
  void fill(Span<const Aabb> boxes) override { boxes_.assign(boxes.begin(), boxes.end()); }
  void remove(std::uint32_t i) override { boxes_[i] = Aabb{}; }
  void add(std::uint32_t i, const Aabb& box) override { boxes_[i] = box; }
  void come(const Aabb& box) override { boxes_.push_back(box); }
  void leave() override { boxes_.pop_back(); }
  void move(Span<const std::uint32_t>, Span<const Aabb> boxes) override { fill(boxes); }
  void update() override { detector.find_pairs(boxes_, found); }
  PairSummary pairs(Span<const Aabb>) override { return {}; }

  Detector detector;
  std::vector<Pair> found;
  Neighbours neighbours;

 private:
  std::vector<Aabb> boxes_;
};

std::unique_ptr<Keeper> make_detector_keeper() {
  return std::make_unique<DetectorKeeper>();
}

std::uint64_t one_set(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  return of.detector.find_pairs(scene.frame(0), of.found).pairs;
}

std::uint64_t halves(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  const Span<const Aabb> boxes = scene.frame(0);
  const std::size_t half = boxes.size() / 2;
  return of.detector.find_pairs(boxes.subspan(0, half), boxes.subspan(half, boxes.size() - half), of.found).pairs;
}

std::uint64_t twentieth(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  const Span<const Aabb> boxes = scene.frame(0);
  return of.detector.find_pairs(boxes.subspan(0, (boxes.size() + 19) / 20), boxes, of.found).pairs;
}

std::uint64_t neighbours(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  return of.detector.find_neighbours(scene.frame(0), of.neighbours).pairs;
}

std::uint64_t with_tolerance(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  PairRules rules;
  rules.tolerance = 0.1;
  return of.detector.find_pairs(scene.frame(0), of.found, rules).pairs;
}

std::uint64_t first_pair(Keeper& keeper, const CliffScene& scene) {
  auto& of = static_cast<DetectorKeeper&>(keeper);
  of.detector.stream_pairs(scene.frame(0), [](Span<const Pair>) { return false; });
  return 0;
}

std::uint64_t once(Keeper&, const CliffScene& scene) {
  return find_pairs(scene.frame(0)).size();
}

}  // namespace

std::vector<CliffCall> detector_calls() {
  std::vector<CliffCall> calls;
  const auto add = [&](const char* name, const char* description, auto run, bool has_history = true) {
    calls.push_back({"Detector", name, description, make_detector_keeper, nullptr, run, has_history});
  };
  add("find_pairs", "of one set", one_set);
  add("two halves", "find_pairs between two sets of half the boxes", halves);
  add("5 % and all", "find_pairs between a twentieth and all", twentieth);
  add("find_neighbours", "of one set", neighbours);
  add("tolerance", "find_pairs with a tolerance", with_tolerance);
  add("first pair", "stream_pairs to a sink that stops at once", first_pair);
  add("once", "the free function, whose Detector is new", once, false);
  return calls;
}

}  // namespace boxstream::bench
