// SPDX-License-Identifier: MIT
// Boxes from frame to frame; each method of finding their pairs is checked, and timed.
#include <algorithm>

#include <fmt/format.h>

#include "boxes/inputs.hpp"
#include "boxes/methods.hpp"
#include "boxes/pair_difference.hpp"
#include "experiment_kinds/kinds.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;

/// One value of the input's own knob: the number of boxes, or the share of them that moves.
struct Variant {
  std::string label;
  double x;
  Frames frames;

  std::size_t n() const { return frames.boxes.front().size(); }
};

/// A method on a variant.
struct Candidate {
  const Variant* variant;
  Method* method;
  PairDifference difference;
  std::uint64_t extra = 0;  ///< pairs held or returned beyond the expected ones, in the frames that are timed
  bench::PairSummary last;  ///< what it returned for the last frame
  std::string failure;
};

/// Frames that are checked and not timed: the first fills structures, and in the next ones methods that keep them learn
/// how boxes move.
constexpr std::size_t first_timed = 4;

std::size_t frames_of(const json& settings, std::size_t n) {
  // Few boxes take too little time for the clock.
  const auto least = settings.value("frames", std::size_t{6});
  return std::clamp<std::size_t>(settings.value("boxes_in_all", std::size_t{100000}) / n, least, 60) + first_timed;
}

std::vector<Variant> variants_of(const json& input, Measurement& measurement) {
  const json& settings = measurement.settings();
  std::vector<Variant> variants;
  for (const json& size : input.value("sizes", settings.value("sizes", json::array({10000})))) {
    const auto n = size.get<std::size_t>();
    const std::size_t frames = frames_of(settings, n);
    const std::string name = input.at("name").get<std::string>();
    measurement.progress(fmt::format("{}, {} boxes", name, n));
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

/// Once through all frames, each checked.
void check(Candidate& candidate) {
  const Frames& frames = candidate.variant->frames;
  bench::Peer& peer = *candidate.method->peer;
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
  candidate.failure = candidate.difference.complaint(candidate.method->superset);
  if (!candidate.failure.empty() && !candidate.method->known_difference.empty())
    candidate.failure += "; known: it " + candidate.method->known_difference;
}

/// Nanoseconds for a box in a frame.
double timed(Candidate& candidate) {
  const Frames& frames = candidate.variant->frames;
  bench::Peer& peer = *candidate.method->peer;
  std::vector<Pair> pairs;
  peer.prepare(frames.boxes.front());
  peer.find_pairs(frames.boxes.front(), pairs);
  for (std::size_t frame = 1; frame < first_timed; ++frame) peer.next_frame(frames.boxes[frame], frames.moved, pairs);
  const double ms = measure::time_once([&] {
    for (std::size_t frame = first_timed; frame < frames.boxes.size(); ++frame)
      peer.next_frame(frames.boxes[frame], frames.moved, pairs);
  });
  if (bench::summarize(pairs) != candidate.last && candidate.failure.empty())
    candidate.failure = "other pairs in a timed run than in the one that was checked";
  peer.release();
  return 1e6 * ms / static_cast<double>((frames.boxes.size() - first_timed) * candidate.variant->n());
}

/// `by_method`: the knob is one of the methods, not the number of boxes or the share that moves.
Point point_of(const Candidate& candidate, bool by_method) {
  const Method& method = *candidate.method;
  const Variant& variant = *candidate.variant;
  const Frames& frames = variant.frames;
  std::size_t expected = 0;
  for (std::size_t frame = first_timed; frame < frames.pairs.size(); ++frame) expected += frames.pairs[frame].size();
  const auto boxes = static_cast<double>(variant.n() * (frames.pairs.size() - first_timed));
  const double touching = frames.in_contact * static_cast<double>(expected);
  return {
      .series = method.series,
      .setting = by_method ? method.setting : variant.label,
      .x = by_method ? method.x : variant.x,
      .values = {static_cast<double>(candidate.difference.missed), static_cast<double>(candidate.difference.duplicates),
                 static_cast<double>(candidate.extra) / boxes, static_cast<double>(expected) / boxes,
                 1 - touching / static_cast<double>(expected + candidate.extra)},
      .failure = candidate.failure};
}

void measure_input(const json& input, std::vector<Method>& methods, Measurement& measurement) {
  const std::string panel = input.at("name").get<std::string>();
  const std::vector<Variant> variants = variants_of(input, measurement);
  const bool by_method =
      std::any_of(methods.begin(), methods.end(), [](const Method& method) { return !method.setting.empty(); });
  if (by_method && variants.size() > 1) throw std::invalid_argument(panel + ": two knobs, of boxes and of methods");
  std::vector<Candidate> candidates;
  for (const Variant& variant : variants)
    for (Method& method : methods)
      if (method.most == 0 || variant.n() <= method.most) candidates.push_back({&variant, &method, {}, 0, {}, {}});
  const auto announce = [&](const Candidate& candidate) {
    measurement.progress(fmt::format("{}: {} of {}", panel, candidate.method->series, candidate.variant->label));
  };
  for (Candidate& candidate : candidates) {
    announce(candidate);
    check(candidate);
  }
  const auto timed_one = [&](Candidate& candidate) {
    announce(candidate);
    return timed(candidate);
  };
  measurement.add_points(panel, candidates, timed_one,
                         [&](const Candidate& candidate, const auto&) { return point_of(candidate, by_method); });
}

}  // namespace

void measure_frames(Measurement& measurement) {
  std::vector<Method> methods = read_methods(measurement.settings().at("ways"));
  for (const json& input : measurement.settings().at("inputs")) measure_input(input, methods, measurement);
}

}  // namespace boxstream::report
