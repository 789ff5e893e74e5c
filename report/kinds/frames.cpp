// SPDX-License-Identifier: MIT
// Boxes from frame to frame, each way from them to pairs held against what there is, and timed.
#include <algorithm>

#include <fmt/format.h>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "boxes/inputs.hpp"
#include "boxes/pair_difference.hpp"
#include "boxes/ways.hpp"
#include "pair_hash.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// One value of the knob that is an input's own: how many boxes, or which share of them moves.
struct Variant {
  std::string label;
  double x;
  Frames frames;

  std::size_t n() const { return frames.boxes.front().size(); }
};

/// A way on a variant.
struct Candidate {
  const Variant* variant;
  Way* way;
  PairDifference difference;
  std::uint64_t extra = 0;  ///< pairs held or handed over beside those there are, in the frames that are timed
  bench::PairSummary last;  ///< what it handed over of the last frame
  std::string failure;
};

/// Frames that are looked at and not timed: the first fills, and the next ones find out how boxes move, which those who
/// keep something from frame to frame do only once.
constexpr std::size_t first_timed = 4;

std::size_t frames_of(const json& settings, std::size_t n) {
  // Few boxes are done with too soon for a clock.
  const auto least = settings.value("frames", std::size_t{6});
  return std::clamp<std::size_t>(settings.value("boxes_in_all", std::size_t{100000}) / n, least, 60) + first_timed;
}

std::vector<Variant> variants_of(const json& input, const json& settings, const Progress& progress) {
  std::vector<Variant> variants;
  for (const json& size : input.value("sizes", settings.value("sizes", json::array({10000})))) {
    const auto n = size.get<std::size_t>();
    const std::size_t frames = frames_of(settings, n);
    const std::string name = input.at("name").get<std::string>();
    progress(fmt::format("{}, {} boxes", name, n));
    if (input.contains("scene")) {
      variants.push_back(
          {fmt::format("{}", n), static_cast<double>(n),
           bake({input["scene"].get<std::string>(), n, input.value("warm_up", std::size_t{0}), frames})});
      continue;
    }
    const json shares = input.value("shares", json::array({1.0}));
    for (const json& entry : shares) {
      const auto share = entry.get<double>();
      Frames moved = brownian(input.at("batch").get<std::string>(), n, share, input.value("step", 0.1), frames);
      const bool by_share = shares.size() > 1;
      variants.push_back({by_share ? fmt::format("{:g} %", 100 * share) : fmt::format("{}", n),
                          by_share ? share : static_cast<double>(n), std::move(moved)});
    }
  }
  return variants;
}

/// Once through all frames, each looked at.
void check(Candidate& candidate) {
  const Frames& frames = candidate.variant->frames;
  bench::Peer& peer = *candidate.way->peer;
  std::vector<Pair> pairs;
  peer.prepare(frames.boxes.front());
  for (std::size_t frame = 0; frame < frames.boxes.size(); ++frame) {
    if (frame == 0)
      peer.find_pairs(frames.boxes[frame], pairs);
    else
      peer.next_frame(frames.boxes[frame], frames.moved, pairs);
    candidate.difference.add(compare_pairs(frames.pairs[frame], pairs));
    if (frame < first_timed) continue;
    const std::size_t held = std::max(peer.candidates(), pairs.size());
    candidate.extra += held - std::min(held, frames.pairs[frame].size());
  }
  candidate.last = bench::summarize(pairs);
  peer.release();
  candidate.failure = candidate.difference.complaint(candidate.way->superset);
  if (!candidate.failure.empty() && !candidate.way->known_difference.empty())
    candidate.failure += "; known: it " + candidate.way->known_difference;
}

/// Nanoseconds for a box in a frame.
double timed(Candidate& candidate) {
  const Frames& frames = candidate.variant->frames;
  bench::Peer& peer = *candidate.way->peer;
  std::vector<Pair> pairs;
  peer.prepare(frames.boxes.front());
  peer.find_pairs(frames.boxes.front(), pairs);
  for (std::size_t frame = 1; frame < first_timed; ++frame) peer.next_frame(frames.boxes[frame], frames.moved, pairs);
  const double ms = accuracy::stopwatch([&] {
    for (std::size_t frame = first_timed; frame < frames.boxes.size(); ++frame)
      peer.next_frame(frames.boxes[frame], frames.moved, pairs);
  });
  if (bench::summarize(pairs) != candidate.last && candidate.failure.empty())
    candidate.failure = "other pairs in a timed run than in the one that was looked at";
  peer.release();
  return 1e6 * ms / static_cast<double>((frames.boxes.size() - first_timed) * candidate.variant->n());
}

/// `by_way`: the knob is one that ways have, and not how many boxes there are or how many of them move.
Point point_of(const std::string& panel, const Candidate& candidate, const accuracy::Estimate& cost, bool by_way) {
  const Way& way = *candidate.way;
  const Variant& variant = *candidate.variant;
  const Frames& frames = variant.frames;
  std::size_t there_are = 0;
  for (std::size_t frame = first_timed; frame < frames.pairs.size(); ++frame) there_are += frames.pairs[frame].size();
  const auto boxes = static_cast<double>(variant.n() * (frames.pairs.size() - first_timed));
  const double touching = frames.in_contact * static_cast<double>(there_are);
  Point point;
  point.panel = panel;
  point.series = way.series;
  point.setting = by_way ? way.setting : variant.label;
  point.x = by_way ? way.x : variant.x;
  point.cost = cost;
  point.values = {static_cast<double>(candidate.difference.missed),
                  static_cast<double>(candidate.difference.duplicates), static_cast<double>(candidate.extra) / boxes,
                  static_cast<double>(there_are) / boxes,
                  1 - touching / static_cast<double>(there_are + candidate.extra)};
  point.failure = candidate.failure;
  return point;
}

void run_input(const json& input, const json& settings, std::vector<Way>& ways, const RunOptions& options,
               const Progress& progress, Results& results) {
  const std::string panel = input.at("name").get<std::string>();
  const std::vector<Variant> variants = variants_of(input, settings, progress);
  const bool by_way = std::any_of(ways.begin(), ways.end(), [](const Way& way) { return !way.setting.empty(); });
  if (by_way && variants.size() > 1) throw std::invalid_argument(panel + ": two knobs, of boxes and of ways");
  std::vector<Candidate> candidates;
  for (const Variant& variant : variants)
    for (Way& way : ways)
      if (way.most == 0 || variant.n() <= way.most) candidates.push_back({&variant, &way, {}, 0, {}, {}});
  for (Candidate& candidate : candidates) {
    progress(fmt::format("{}: {} of {}", panel, candidate.way->series, candidate.variant->label));
    check(candidate);
  }
  const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
    progress(fmt::format("{}: {} of {}", panel, candidates[i].way->series, candidates[i].variant->label));
    return timed(candidates[i]);
  });
  for (std::size_t i = 0; i < candidates.size(); ++i)
    results.points.push_back(point_of(panel, candidates[i], turns.costs[i], by_way));
  results.twins.push_back({panel, turns.twin_spread});
}

}  // namespace

Results frames_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ns per box and frame";
    results.metrics = {"missed", "duplicates", "extra_per_box", "pairs_per_box", "false_positive_rate"};
    std::vector<Way> ways = read_ways(settings.at("ways"));
    for (const json& input : settings.at("inputs")) run_input(input, settings, ways, options, progress, results);
    return results;
  });
}

}  // namespace boxstream::report
