// SPDX-License-Identifier: MIT
#include "cliffs/search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "measure/interleave.hpp"
#include "measure/stopwatch.hpp"

namespace boxstream::bench {

namespace {

constexpr double sample_ns = 20000;
/// What is made when it has paid off, such as an index of resting boxes, is there after that.
constexpr double warm_ns = 200000, warm_ns_of_box = 400;
constexpr int rounds = 5;
constexpr int again = 3;

/// Of a run of calls.
double time_of(const CliffCall& call, Keeper& keeper, const CliffScene& scene, int calls) {
  const auto begin = measure::now(call.clock);
  for (int i = 0; i < calls; ++i) call.run(keeper, scene);
  return static_cast<double>((measure::now(call.clock) - begin).count()) / calls;
}

/// Of one call of both.
bool agree(const CliffCall& call, std::vector<std::unique_ptr<Keeper>>& keepers, const CliffScene& scene) {
  std::vector<std::uint64_t> answers;
  for (auto& keeper : keepers) answers.push_back(call.run(*keeper, scene));
  if (keepers.size() < 2 || answers[0] != answers[1]) return keepers.size() < 2;
  if (!call.has_history) return true;
  return keepers[0]->pairs(scene.frame(keepers[0]->turn)) == keepers[1]->pairs(scene.frame(keepers[1]->turn));
}

}  // namespace

CliffPoint measure(const CliffCall& call, History history, std::size_t n, int makes) {
  const CliffScene scene(n);
  std::vector<double> ours, peer;
  CliffPoint point{n, n + scene.pairs()};
  for (int make = 0; make < makes; ++make) {
    std::vector<std::unique_ptr<Keeper>> keepers;
    keepers.push_back(call.make());
    if (call.make_peer != nullptr) keepers.push_back(call.make_peer());
    for (auto& keeper : keepers)
      if (call.has_history) live_through(history, *keeper, scene);
    double warm = 1e300, spent = 0;
    for (int calls = 2; spent < warm_ns + warm_ns_of_box * static_cast<double>(n); calls *= 2)
      for (auto& keeper : keepers) {
        const double each = time_of(call, *keeper, scene, calls);
        spent += each * calls;
        warm = std::min(warm, each);
      }
    // What is kept for some calls is a part of each: several in a row are one sample.
    const int calls = std::clamp(static_cast<int>(sample_ns / warm), 4, 64);
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < keepers.size(); ++i)
        (i == 0 ? ours : peer).push_back(time_of(call, *keepers[i], scene, calls));
    point.equal = agree(call, keepers, scene) && point.equal;
  }
  point.ours = measure::median(ours);
  if (!peer.empty()) point.peer = measure::median(peer);
  return point;
}

std::vector<std::size_t> cliff_sizes(std::size_t by_one, double step, std::size_t most) {
  std::vector<std::size_t> sizes;
  for (std::size_t n = 1; n <= most;) {
    sizes.push_back(n);
    n = n < by_one ? n + 1 : std::max(n + 1, static_cast<std::size_t>(std::llround(static_cast<double>(n) * step)));
  }
  return sizes;
}

namespace {

double jump_between(const CliffPoint& a, const CliffPoint& b) {
  return b.ours / static_cast<double>(b.things) / (a.ours / static_cast<double>(a.things));
}

void find_jumps(const CliffCall& call, History history, std::vector<CliffPoint>& points, double most_jump,
                CliffRow& row) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    double jump = jump_between(points[i - 1], points[i]);
    for (int time = 0; jump > most_jump && time < 2; ++time) {
      points[i - 1] = measure(call, history, points[i - 1].n, again);
      points[i] = measure(call, history, points[i].n, again);
      jump = jump_between(points[i - 1], points[i]);
    }
    if (jump > row.largest_jump) {
      row.largest_jump = jump;
      row.jump_from = points[i - 1].n;
      row.jump_to = points[i].n;
      row.jump_history = name_of(history);
    }
    if (jump > most_jump)
      row.cliffs.push_back(
          {call.owner + ": " + call.name, std::string(name_of(history)), points[i - 1].n, points[i].n, 0, jump, 0});
  }
}

void find_below(const CliffCall& call, History history, std::vector<CliffPoint>& points, CliffRow& row) {
  bool in_range = false;
  for (CliffPoint& point : points) {
    if (point.ratio() < 1) point = measure(call, history, point.n, again);
    const double ratio = point.ratio();
    if (ratio < row.least) {
      row.least = ratio;
      row.least_at = point.n;
      row.least_history = name_of(history);
    }
    if (ratio >= 1) {
      in_range = false;
      continue;
    }
    ++row.below;
    if (!in_range)
      row.cliffs.push_back({call.owner + ": " + call.name, std::string(name_of(history)), point.n, 0, 0, 0, 1});
    in_range = true;
    Cliff& range = row.cliffs.back();
    range.to = point.n;
    if (ratio < range.below) {
      range.below = ratio;
      range.worst = point.n;
    }
  }
}

}  // namespace

CliffRow search_cliffs(const CliffCall& call, const std::vector<std::size_t>& sizes, double most_jump,
                       const std::function<void(const std::string&)>& show) {
  CliffRow row{call.owner, call.name, call.description, sizes.size()};
  for (const History history : histories) {
    if (!call.has_history && history != History::fresh) continue;
    std::vector<CliffPoint> points;
    for (const std::size_t n : sizes) {
      show(call.owner + ": " + call.name + ", " + std::string(name_of(history)) + ", n = " + std::to_string(n));
      points.push_back(measure(call, history, n, 1));
    }
    find_jumps(call, history, points, most_jump, row);
    find_below(call, history, points, row);
    for (const CliffPoint& point : points) row.equal = row.equal && point.equal;
    if (history == History::fresh && call.make_peer != nullptr) row.fresh = points;
  }
  return row;
}

}  // namespace boxstream::bench
