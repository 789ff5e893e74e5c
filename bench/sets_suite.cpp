// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "peers/cross.hpp"
#include "peers/sorted_sweep.hpp"
#include "predictor.hpp"
#include "set_cases.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

/// How somebody finds the pairs of a case.
struct Way {
  std::string name, family;
  std::function<void(std::vector<Pair>&)> run;
  bool yardstick = false;  ///< other pairs, or the same at another price
};

class SetsContest {
 public:
  SetsContest(const Options& options, Report& report, Progress& progress)
      : options_(options), report_(report), progress_(progress) {}

  void run(const std::string& name, std::size_t n) {
    row_ = {};
    row_.suite = "sets";
    row_.case_name = name;
    row_.n = n;
    if (name.rfind("few-many:", 0) == 0)
      run_two(few_against_many(std::stoul(name.substr(9)), n, options_.seed));
    else if (name == "turned")
      run_two(turned_meshes(n));
    else if (name == "static90")
      run_filtered(mostly_static(n, options_.seed));
    else if (name == "groups")
      run_filtered(ten_groups(n, options_.seed));
    else
      run_double(name.substr(0, 1));
  }

 private:
  void run_two(const TwoSets& sets) {
    std::vector<CrossPeerConfig> peers = make_cross_peers();
    std::vector<Way> ways;
    for (const CrossPeerConfig& peer : peers) {
      // All against all is no rival where both are many.
      if (peer.family == "block-loop" && std::min(sets.a.size(), sets.b.size()) > 20000) continue;
      ways.push_back({peer.name, peer.family,
                      [&peer, &sets](std::vector<Pair>& pairs) { peer.peer->find_pairs(sets.a, sets.b, pairs); }});
    }
    compete([&](std::vector<Pair>& pairs) { detector_.find_pairs(sets.a, sets.b, pairs); }, ways);
  }

  void run_filtered(const Filtered& filtered) {
    const std::vector<Way> ways = {
        {"by-hand", "by-hand", by_hand(filtered)},
        {"unfiltered", "unfiltered",
         [&](std::vector<Pair>& pairs) { other_detector_.find_pairs(filtered.boxes, pairs); }, true}};
    compete([&](std::vector<Pair>& pairs) { detector_.find_pairs(filtered.boxes, pairs, filtered.filters); }, ways);
  }

  /// One search a part, whose boxes lie together beforehand; the pairs get the places in the batch.
  std::function<void(std::vector<Pair>&)> by_hand(const Filtered& filtered) {
    hand_.clear();
    for (const Filtered::Part& part : filtered.parts) {
      TwoSets boxes;
      for (const std::uint32_t i : part.a) boxes.a.push_back(filtered.boxes[i]);
      for (const std::uint32_t i : part.b) boxes.b.push_back(filtered.boxes[i]);
      hand_.push_back(std::move(boxes));
    }
    return [this, &filtered](std::vector<Pair>& pairs) {
      pairs.clear();
      for (std::size_t p = 0; p < hand_.size(); ++p) {
        const Filtered::Part& part = filtered.parts[p];
        const bool one = part.b.empty();
        const std::vector<std::uint32_t>& places_b = one ? part.a : part.b;
        const auto add = [&](Span<const Pair> found) {
          for (const Pair pair : found) {
            const std::uint32_t a = part.a[pair.a], b = places_b[pair.b];
            pairs.push_back({std::min(a, b), std::max(a, b)});
          }
          return true;
        };
        if (one)
          other_detector_.stream_pairs(hand_[p].a, add);
        else
          other_detector_.stream_pairs(hand_[p].a, hand_[p].b, add);
      }
    };
  }

  void run_double(const std::string& batch) {
    const std::vector<Aabb64> boxes = batches::make64(batch, row_.n, options_.seed);
    const std::vector<Aabb> floats = batches::make(batch, row_.n, options_.seed);
    std::vector<Way> ways;
    if (row_.n <= 100000)
      ways.push_back({"sorted-sweep", "sorted-sweep",
                      [&](std::vector<Pair>& pairs) { sorted_sweep<double>(boxes, order_, pairs); }});
    ways.push_back(
        {"float", "float", [&](std::vector<Pair>& pairs) { other_detector_.find_pairs(floats, pairs); }, true});
    compete([&](std::vector<Pair>& pairs) { detector_.find_pairs(boxes, pairs); }, ways);
  }

  static std::vector<Pair> sorted(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  bool wanted(const Way& way) const {
    return options_.peers.empty() ||
           std::find(options_.peers.begin(), options_.peers.end(), way.family) != options_.peers.end();
  }

  void compete(const std::function<void(std::vector<Pair>&)>& ours, std::vector<Way> ways) {
    std::erase_if(ways, [&](const Way& way) { return !wanted(way); });
    std::vector<Pair> pairs, theirs;
    ours(pairs);
    row_.k = pairs.size();
    const std::vector<Pair> expected = sorted(pairs);
    std::vector<bool> equal;
    std::vector<Contestant> contestants;
    for (const Way& way : ways) {
      progress_.show(fmt::format("sets {} n={}: {}", row_.case_name, row_.n, way.name));
      way.run(theirs);
      equal.push_back(sorted(theirs) == expected);
      contestants.push_back({[&] { way.run(theirs); }});
    }
    contestants.push_back({[&] { ours(pairs); }});
    const std::vector<Series> series = measure_interleaved(contestants, options_.interleaving, [](int) {});
    progress_.clear();
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (equal[i] && !is_best_of_family(ways, series, i)) continue;
      Row row = row_;
      row.peer = ways[i].name;
      row.yardstick = ways[i].yardstick;
      row.ours_ms = series.back().median;
      row.ours_min = series.back().min;
      row.peer_ms = series[i].median;
      row.peer_min = series[i].min;
      row.samples = series[i].samples;
      if (ways[i].yardstick)
        row.pairs_equal.reset();
      else
        row.pairs_equal = equal[i];
      report_.add(std::move(row));
    }
  }

  static bool is_best_of_family(const std::vector<Way>& ways, const std::vector<Series>& series, std::size_t i) {
    for (std::size_t j = 0; j < ways.size(); ++j)
      if (ways[j].family == ways[i].family && series[j].median < series[i].median) return false;
    return true;
  }

  const Options& options_;
  Report& report_;
  Progress& progress_;
  Detector detector_, other_detector_;
  std::vector<TwoSets> hand_;
  std::vector<std::uint32_t> order_;
  Row row_;
};

const std::pair<std::string, const char*> cases[] = {
    {"few-many:1", "one box against n"},
    {"few-many:10", "ten"},
    {"few-many:100", "a hundred"},
    {"few-many:1000", "a thousand"},
    {"turned", "the boxes of n triangles against those of the same surface turned"},
    {"static90", "filters: nine in ten are static and refuse each other"},
    {"groups", "filters: ten groups, each of which meets itself alone"},
    {"U64", "double boxes beside float ones"},
    {"S64", "the same"},
    {"C64", "the same"},
};

}  // namespace

bool is_sets_case(const std::string& name) {
  return std::any_of(std::begin(cases), std::end(cases), [&](const auto& c) { return c.first == name; });
}

std::string describe_sets_cases() {
  std::string text;
  for (const auto& [name, description] : cases) text += fmt::format("  {:<13} {}\n", name, description);
  return text;
}

void run_sets_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{10000} : std::vector<std::size_t>{1000, 10000, 100000, 1000000};
  std::sort(sizes.begin(), sizes.end());
  SetsContest contest(options, report, progress);
  for (const std::size_t n : sizes)
    for (const auto& [name, description] : cases)
      if (options.cases.empty() || std::find(options.cases.begin(), options.cases.end(), name) != options.cases.end())
        contest.run(name, n);
}

}  // namespace boxstream::bench
