// SPDX-License-Identifier: MIT
// A grid of boxes that touch, or just do not, moved far from the origin: what each kind of number makes of it. What
// there is is told by doubles, all against all.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include <boxstream/detector.hpp>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "boxes/conversions.hpp"
#include "boxes/pair_difference.hpp"
#include "pair_hash.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// From boxes of doubles to pairs.
class Numbers {
 public:
  virtual ~Numbers() = default;
  virtual void find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& pairs) = 0;
  /// Boxes that no longer contain what they were made of.
  virtual std::size_t cut_off(Span<const Aabb64>) const { return 0; }
};

class Doubles final : public Numbers {
  void find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& pairs) override { detector_.find_pairs(boxes, pairs); }
  Detector detector_;
};

class Floats final : public Numbers {
 public:
  using Convert = Aabb (*)(const Aabb64&);
  explicit Floats(Convert convert) : convert_(convert) {}

  void find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& pairs) override {
    boxes_.resize(boxes.size());
    std::transform(boxes.begin(), boxes.end(), boxes_.begin(), convert_);
    detector_.find_pairs(boxes_, pairs);
  }
  std::size_t cut_off(Span<const Aabb64> boxes) const override {
    return static_cast<std::size_t>(
        std::count_if(boxes.begin(), boxes.end(), [&](const Aabb64& box) { return !contains(convert_(box), box); }));
  }

 private:
  Convert convert_;
  std::vector<Aabb> boxes_;
  Detector detector_;
};

/// Bullet's sweep over integers, in a world as large as it takes to get from one far place to the opposite one.
template <class Sweep>
class Integers final : public Numbers {
  void find_pairs(Span<const Aabb64> boxes, std::vector<Pair>& pairs) override {
    double reach = 0;
    for (const Aabb64& box : boxes)
      for (int d = 0; d < 3; ++d) reach = std::max({reach, -box.min[d], box.max[d]});
    const auto half = static_cast<btScalar>(reach);
    Sweep sweep({-half, -half, -half}, {half, half, half}, static_cast<unsigned short>(boxes.size() + 1), nullptr,
                true);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      const Aabb box = nearest_floats(boxes[i]);
      sweep.createProxy({box.min[0], box.min[1], box.min[2]}, {box.max[0], box.max[1], box.max[2]}, 0,
                        reinterpret_cast<void*>(std::uintptr_t{i}), 1, 1, nullptr);
    }
    sweep.calculateOverlappingPairs(nullptr);
    pairs.clear();
    const btBroadphasePair* const held = sweep.getOverlappingPairCache()->getOverlappingPairArrayPtr();
    for (int i = 0; i < sweep.getOverlappingPairCache()->getNumOverlappingPairs(); ++i) {
      const auto a = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(held[i].m_pProxy0->m_clientObject));
      const auto b = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(held[i].m_pProxy1->m_clientObject));
      pairs.push_back({std::min(a, b), std::max(a, b)});
    }
  }
};

struct Candidate {
  std::string name;
  std::unique_ptr<Numbers> numbers;
  const std::vector<Aabb64>* boxes;
  double offset;
  PairDifference difference;
  std::size_t there_are = 0, cut_off = 0;
  bench::PairSummary found;
  std::string failure;
};

std::vector<Aabb64> grid(std::size_t edge, double side, double gap, double offset) {
  std::vector<Aabb64> boxes;
  for (std::size_t i = 0; i < edge * edge * edge; ++i) {
    const std::size_t cell[3] = {i % edge, i / edge % edge, i / (edge * edge)};
    Aabb64 box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = offset + static_cast<double>(cell[d]) * side;
      // Where the next one begins, but for the gap.
      box.max[d] = offset + static_cast<double>(cell[d] + 1) * side - gap;
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::unique_ptr<Numbers> numbers_named(const std::string& name) {
  if (name == "double") return std::make_unique<Doubles>();
  if (name == "float") return std::make_unique<Floats>(nearest_floats);
  if (name == "float, outward") return std::make_unique<Floats>(outward_floats);
  if (name == "AxisSweep16") return std::make_unique<Integers<btAxisSweep3>>();
  if (name == "AxisSweep32") return std::make_unique<Integers<bt32BitAxisSweep3>>();
  throw std::invalid_argument("no numbers \"" + name +
                              "\"; there are double, float, \"float, outward\", AxisSweep16 and AxisSweep32");
}

void check(Candidate& candidate) {
  const Span<const Aabb64> boxes = *candidate.boxes;
  const std::vector<Pair> expected = all_against_all(boxes);
  std::vector<Pair> pairs;
  candidate.numbers->find_pairs(boxes, pairs);
  candidate.there_are = expected.size();
  candidate.difference = compare_pairs(expected, pairs);
  candidate.cut_off = candidate.numbers->cut_off(boxes);
  candidate.found = bench::summarize(pairs);
  // Extra pairs are what is measured here; doubles have no reason for any.
  candidate.failure = candidate.difference.complaint(candidate.name != "double");
}

double timed(Candidate& candidate) {
  std::vector<Pair> pairs;
  const double ms = accuracy::stopwatch([&] { candidate.numbers->find_pairs(*candidate.boxes, pairs); });
  if (bench::summarize(pairs) != candidate.found && candidate.failure.empty())
    candidate.failure = "other pairs in a timed run than in the one that was looked at";
  return 1e6 * ms / static_cast<double>(candidate.boxes->size());
}

void run_grid(const json& input, const json& settings, const RunOptions& options, const Progress& progress,
              Results& results) {
  const std::string panel = input.at("name").get<std::string>();
  const auto offsets = settings.at("offsets").get<std::vector<double>>();
  const auto edge = settings.at("edge").get<std::size_t>();
  // The 16-bit sweep has room for so many.
  if (edge < 2 || edge > 30) throw std::invalid_argument("\"edge\" is from 2 to 30");
  std::vector<std::vector<Aabb64>> grids;
  for (const double offset : offsets)
    grids.push_back(grid(edge, input.value("side", 1.0), input.value("gap", 0.0), offset));
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    for (const json& name : settings.at("numbers"))
      candidates.push_back({name, numbers_named(name), &grids[i], offsets[i], {}, 0, 0, {}, {}});
  for (Candidate& candidate : candidates) {
    progress(fmt::format("{}: {} at {:g}", panel, candidate.name, candidate.offset));
    check(candidate);
  }
  const accuracy::Turns turns =
      accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) { return timed(candidates[i]); });
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const auto n = static_cast<double>(candidate.boxes->size());
    Point point;
    point.panel = panel;
    point.series = candidate.name;
    point.setting = fmt::format("{:g} m", candidate.offset);
    point.x = candidate.offset;
    point.cost = turns.costs[i];
    point.values = {static_cast<double>(candidate.difference.missed),
                    static_cast<double>(candidate.difference.duplicates),
                    static_cast<double>(candidate.difference.extra) / n, static_cast<double>(candidate.there_are) / n,
                    static_cast<double>(candidate.cut_off) / n};
    point.failure = candidate.failure;
    results.points.push_back(std::move(point));
  }
  results.twins.push_back({panel, turns.twin_spread});
}

}  // namespace

Results far_boxes_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ns per box";
    results.metrics = {"missed", "duplicates", "extra_per_box", "pairs_per_box", "share_cut_off"};
    for (const json& input : settings.at("inputs")) run_grid(input, settings, options, progress, results);
    return results;
  });
}

}  // namespace boxstream::report
