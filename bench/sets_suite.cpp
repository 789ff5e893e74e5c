// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "peers/cross.hpp"
#include "peers/sorted_sweep.hpp"
#include "race.hpp"
#include "set_cases.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

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
      ways.push_back(finds_pairs(peer.name, peer.family,
                                 [this, &peer, &sets] { peer.peer->find_pairs(sets.a, sets.b, theirs_); }));
    }
    compete([&] { detector_.find_pairs(sets.a, sets.b, pairs_); }, ways);
  }

  void run_filtered(const Filtered& filtered) {
    const std::vector<Way> ways = {finds_pairs("by-hand", "by-hand", by_hand(filtered)), yardstick("unfiltered", [&] {
                                     other_detector_.find_pairs(filtered.boxes, theirs_);
                                   })};
    compete([&] { detector_.find_pairs(filtered.boxes, pairs_, filtered.filters); }, ways);
  }

  /// One search a part, whose boxes lie together beforehand; the pairs get the places in the batch.
  std::function<void()> by_hand(const Filtered& filtered) {
    hand_.clear();
    for (const Filtered::Part& part : filtered.parts) {
      TwoSets boxes;
      for (const std::uint32_t i : part.a) boxes.a.push_back(filtered.boxes[i]);
      for (const std::uint32_t i : part.b) boxes.b.push_back(filtered.boxes[i]);
      hand_.push_back(std::move(boxes));
    }
    return [this, &filtered] {
      theirs_.clear();
      for (std::size_t p = 0; p < hand_.size(); ++p) {
        const Filtered::Part& part = filtered.parts[p];
        const bool one = part.b.empty();
        const std::vector<std::uint32_t>& places_b = one ? part.a : part.b;
        const auto add = [&](Span<const Pair> found) {
          for (const Pair pair : found) {
            const std::uint32_t a = part.a[pair.a], b = places_b[pair.b];
            theirs_.push_back({std::min(a, b), std::max(a, b)});
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
      ways.push_back(
          finds_pairs("sorted-sweep", "sorted-sweep", [&] { sorted_sweep<double>(boxes, order_, theirs_); }));
    ways.push_back(yardstick("float", [&] { other_detector_.find_pairs(floats, theirs_); }));
    compete([&] { detector_.find_pairs(boxes, pairs_); }, ways);
  }

  static std::vector<Pair> sorted(std::vector<Pair> pairs) {
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  Way finds_pairs(const std::string& name, const std::string& family, std::function<void()> run) {
    return {name, family, std::move(run), [this] { return sorted(theirs_) == expected_; }, false, ""};
  }
  static Way yardstick(const std::string& name, std::function<void()> run) {
    return {name, name, std::move(run), nullptr, true, ""};
  }

  void compete(const std::function<void()>& ours, std::vector<Way> ways) {
    ours();
    row_.k = pairs_.size();
    expected_ = sorted(pairs_);
    race(row_, ours, std::move(ways), options_, report_, progress_);
  }

  const Options& options_;
  Report& report_;
  Progress& progress_;
  Detector detector_, other_detector_;
  std::vector<Pair> pairs_, theirs_, expected_;
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
