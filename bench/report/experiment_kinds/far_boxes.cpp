// SPDX-License-Identifier: MIT
// A grid of boxes that touch, or just do not, far from the origin, searched in several number formats.
// Expected pairs: doubles, all against all.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include <boxstream/detector.hpp>

#include "boxes/conversions.hpp"
#include "boxes/pair_difference.hpp"
#include "experiment_kinds/kinds.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

using Convert = Aabb (*)(const Aabb64&);

/// How the pairs of boxes of doubles are found.
struct Numbers {
  std::function<void(Span<const Aabb64> boxes, std::vector<Pair>& pairs)> find_pairs;
  Convert convert = nullptr;  ///< to floats
};

Numbers doubles() {
  return {[detector = std::make_shared<Detector>()](Span<const Aabb64> boxes, std::vector<Pair>& pairs) {
    detector->find_pairs(boxes, pairs);
  }};
}

Numbers floats(Convert convert) {
  const auto find_pairs = [convert, detector = std::make_shared<Detector>(), converted = std::vector<Aabb>()](
                              Span<const Aabb64> boxes, std::vector<Pair>& pairs) mutable {
    converted.resize(boxes.size());
    std::transform(boxes.begin(), boxes.end(), converted.begin(), convert);
    detector->find_pairs(converted, pairs);
  };
  return {find_pairs, convert};
}

/// Bullet's sweep over integers, in a world that reaches from one far place to the opposite one.
template <class Sweep>
void find_by_integers(Span<const Aabb64> boxes, std::vector<Pair>& pairs) {
  double reach = 0;
  for (const Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) reach = std::max({reach, -box.min[d], box.max[d]});
  const auto half = static_cast<btScalar>(reach);
  Sweep sweep({-half, -half, -half}, {half, half, half}, static_cast<unsigned short>(boxes.size() + 1), nullptr, true);
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

struct Candidate {
  std::string name;
  Numbers numbers;
  const std::vector<Aabb64>* boxes;
  double offset;
  PairDifference difference;
  std::size_t expected = 0, cut_off = 0;  ///< boxes whose conversion does not contain them
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

Numbers numbers_named(const std::string& name) {
  if (name == "double") return doubles();
  if (name == "float") return floats(nearest_floats);
  if (name == "float, outward") return floats(outward_floats);
  if (name == "AxisSweep16") return {find_by_integers<btAxisSweep3>};
  if (name == "AxisSweep32") return {find_by_integers<bt32BitAxisSweep3>};
  throw std::invalid_argument("no numbers \"" + name +
                              "\"; there are double, float, \"float, outward\", AxisSweep16 and AxisSweep32");
}

void check(Candidate& candidate) {
  const Span<const Aabb64> boxes = *candidate.boxes;
  const std::vector<Pair> expected = all_against_all(boxes);
  std::vector<Pair> pairs;
  candidate.numbers.find_pairs(boxes, pairs);
  candidate.expected = expected.size();
  candidate.difference = compare_pairs(expected, pairs);
  if (const Convert convert = candidate.numbers.convert)
    candidate.cut_off = static_cast<std::size_t>(
        std::count_if(boxes.begin(), boxes.end(), [&](const Aabb64& box) { return !contains(convert(box), box); }));
  candidate.found = bench::summarize(pairs);
  // Extra pairs are what is measured here; doubles have no reason for any.
  candidate.failure = candidate.difference.complaint(candidate.name != "double");
}

double timed(Candidate& candidate) {
  std::vector<Pair> pairs;
  const double ms = measure::time_once([&] { candidate.numbers.find_pairs(*candidate.boxes, pairs); });
  if (bench::summarize(pairs) != candidate.found && candidate.failure.empty())
    candidate.failure = "other pairs in a timed run than in the one that was checked";
  return 1e6 * ms / static_cast<double>(candidate.boxes->size());
}

void measure_grids(const json& input, Measurement& measurement) {
  const json& settings = measurement.settings();
  const std::string panel = input.at("name").get<std::string>();
  const auto offsets = settings.at("offsets").get<std::vector<double>>();
  const auto edge = settings.at("edge").get<std::size_t>();
  // The 16-bit sweep has no room for more.
  if (edge < 2 || edge > 30) throw std::invalid_argument("\"edge\" is from 2 to 30");
  std::vector<std::vector<Aabb64>> grids;
  for (const double offset : offsets)
    grids.push_back(grid(edge, input.value("side", 1.0), input.value("gap", 0.0), offset));
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    for (const json& name : settings.at("numbers"))
      candidates.push_back({name, numbers_named(name), &grids[i], offsets[i], {}, 0, 0, {}, {}});
  for (Candidate& candidate : candidates) {
    measurement.progress(fmt::format("{}: {} at {:g}", panel, candidate.name, candidate.offset));
    check(candidate);
  }
  measurement.add_points(panel, candidates, timed, [&](const Candidate& candidate, const auto&) {
    const auto n = static_cast<double>(candidate.boxes->size());
    return Point{.series = candidate.name,
                 .setting = fmt::format("{:g} m", candidate.offset),
                 .x = candidate.offset,
                 .values = {static_cast<double>(candidate.difference.missed),
                            static_cast<double>(candidate.difference.duplicates),
                            static_cast<double>(candidate.difference.extra) / n,
                            static_cast<double>(candidate.expected) / n, static_cast<double>(candidate.cut_off) / n},
                 .failure = candidate.failure};
  });
}

}  // namespace

void measure_far_boxes(Measurement& measurement) {
  for (const json& input : measurement.settings().at("inputs")) measure_grids(input, measurement);
}

}  // namespace boxstream::report
