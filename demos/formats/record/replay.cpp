// SPDX-License-Identifier: MIT
#include "formats/record/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "formats/record/expected_pairs.hpp"
#include "formats/record/op.hpp"
#include "measure/stopwatch.hpp"

namespace boxstream::record {
namespace {

// A stream without batches must not be held in memory as a whole, nor what its box queries hit.
constexpr std::size_t most_ops_at_once = 65536;
constexpr std::uint64_t most_hits_at_once = 1 << 20;

/// The first value that only one of two sorted lists has, and whether it is `expected`; a value given twice in one and
/// once in the other counts.
template <class T>
std::optional<std::pair<T, bool>> first_of_one_list(const std::vector<T>& expected, const std::vector<T>& found) {
  const auto [e, f] = std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  if (e == expected.end() && f == found.end()) return std::nullopt;
  const bool missing = f == found.end() || (e != expected.end() && *e < *f);
  return std::pair{missing ? *e : *f, missing};
}

class Replay {
 public:
  Replay(const std::vector<std::unique_ptr<Player>>& players, std::uint64_t most_pairs, ReplayResult& result)
      : players_(players), most_pairs_(most_pairs), result_(result), hits_(players.size()) {
    result_.milliseconds.resize(players.size());
  }

  /// Up to and including the next batch at most. False at a difference.
  bool run(Span<const Op> ops) {
    const Batch* const batch = ops.empty() ? nullptr : std::get_if<Batch>(&ops[ops.size() - 1]);
    const Span<const Op> before(ops.data(), ops.size() - (batch != nullptr ? 1 : 0));
    play(before);
    for (std::size_t i = 0; i < players_.size(); ++i) hits_[i] = players_[i]->take_hits();
    std::size_t query = 0;
    for (const Op& op : before) {
      expected_.apply(op);
      if (const auto* const box = std::get_if<BoxQuery>(&op)) compare_hits(box->box, query++);
      if (result_.difference) return false;
    }
    if (batch == nullptr) return true;
    const std::vector<Pair>& expected =
        expected_.pairs(most_pairs_);  // which are too many before a player has found them
    play({&ops[ops.size() - 1], 1});
    compare_pairs(batch->pairs, expected);
    return !result_.difference;
  }

 private:
  void play(Span<const Op> ops) {
    for (std::size_t i = 0; i < players_.size(); ++i) {
      const auto start = measure::now();
      for (const Op& op : ops) players_[i]->apply(op);
      result_.milliseconds[i] += measure::milliseconds(measure::now() - start);
    }
  }

  void compare_pairs(const PairDigest& recorded, const std::vector<Pair>& expected) {
    const PairDigest digest = digest_of(expected);
    ++result_.batches;
    result_.pairs += expected.size();
    Difference difference;
    difference.batch = result_.batches;
    difference.counts.emplace_back("recording", recorded.count);
    for (const auto& player : players_) {
      std::vector<Pair> held = player->held();
      held.erase(std::remove_if(held.begin(), held.end(), [&](Pair pair) { return !expected_.overlap(pair); }),
                 held.end());
      difference.counts.emplace_back(player->name(), held.size());
      if (!difference.party.empty()) continue;
      if (const auto first = first_of_one_list(expected, held)) {
        difference.party = player->name();
        blame(difference, {first->first.a, first->first.b}, first->second);
      }
    }
    difference.counts.emplace_back("search", expected.size());
    if (difference.party.empty() && recorded != digest) blame_recording(difference, recorded, digest);
    if (!difference.party.empty()) result_.difference = std::move(difference);
  }

  void compare_hits(const Aabb64& box, std::size_t query) {
    const std::vector<std::uint32_t> expected = expected_.in_box(box);
    Difference difference;
    difference.batch = result_.batches + 1;
    difference.query = ++queries_;
    for (std::size_t i = 0; i < players_.size(); ++i) {
      std::vector<std::uint32_t>& hits = hits_[i][query];
      hits.erase(
          std::remove_if(hits.begin(), hits.end(), [&](std::uint32_t id) { return !expected_.overlap(id, box); }),
          hits.end());
      difference.counts.emplace_back(players_[i]->name(), hits.size());
      if (!difference.party.empty()) continue;
      if (const auto first = first_of_one_list(expected, hits)) {
        difference.party = players_[i]->name();
        blame(difference, {first->first}, first->second);
      }
    }
    difference.counts.emplace_back("search", expected.size());
    if (!difference.party.empty()) result_.difference = std::move(difference);
  }

  void blame_recording(Difference& difference, const PairDigest& recorded, const PairDigest& expected) const {
    difference.party = "recording";
    difference.missing = recorded.count < expected.count;
    const auto pair =
        difference.missing ? single_difference(expected, recorded) : single_difference(recorded, expected);
    if (pair && expected_.is_alive(pair->a) && expected_.is_alive(pair->b))
      blame(difference, {pair->a, pair->b}, difference.missing);
  }

  void blame(Difference& difference, std::vector<std::uint32_t> proxies, bool missing) const {
    difference.missing = missing;
    for (const std::uint32_t id : proxies) difference.boxes.push_back(expected_.box(id));
    difference.proxies = std::move(proxies);
  }

  const std::vector<std::unique_ptr<Player>>& players_;
  std::uint64_t most_pairs_;
  ReplayResult& result_;
  std::vector<std::vector<std::vector<std::uint32_t>>> hits_;  // of each player and query
  ExpectedPairs expected_;
  std::uint64_t queries_ = 0;
};

struct Counter {
  Census census;
  std::uint64_t alive = 0;

  void check(const Aabb64& box) { census.invalid_boxes += is_valid(box) ? 0 : 1; }
  void operator()(const Create& op) {
    ++census.created;
    check(op.box);
    census.most_alive = std::max(census.most_alive, ++alive);
  }
  void operator()(const Move& op) {
    ++census.moves;
    check(op.box);
  }
  void operator()(const Destroy&) {
    ++census.destroyed;
    --alive;
  }
  void operator()(const Refilter&) { ++census.refilters; }
  void operator()(const BoxQuery&) { ++census.box_queries; }
  void operator()(const RayQuery&) { ++census.ray_queries; }
  void operator()(const Batch&) { ++census.batches; }
  void operator()(const ResetPool&) { ++census.resets; }
};

}  // namespace

Census census_of(Span<const std::uint8_t> bytes, CutOff cut_off) {
  Reader reader(bytes, cut_off);
  Counter counter;
  while (const std::optional<Op> op = reader.next()) std::visit(counter, *op);
  return counter.census;
}

std::string describe(const Difference& difference, Scalar scalar) {
  std::string text = fmt::format("batch {}", difference.batch);
  if (difference.query != 0) text += fmt::format(", box query {}", difference.query);
  for (const auto& [party, count] : difference.counts)
    text += fmt::format("{}{} {}", &party == &difference.counts.front().first ? ": " : ", ", party, count);
  const char* const verb = difference.missing ? "lacks" : "has in excess";
  if (difference.proxies.empty()) return text + fmt::format("; the {} has other pairs", difference.party);
  text += fmt::format("; {} {}", difference.party, verb);
  if (difference.query != 0)
    text += fmt::format(" proxy {}", difference.proxies[0]);
  else
    text += fmt::format(" the pair of proxies {} and {}", difference.proxies[0], difference.proxies[1]);
  for (std::size_t i = 0; i < difference.proxies.size(); ++i)
    text += fmt::format(", box of {}: {}", difference.proxies[i], text_of(difference.boxes[i], scalar));
  return text;
}

ReplayResult replay(Span<const std::uint8_t> bytes, const std::vector<std::unique_ptr<Player>>& players, CutOff cut_off,
                    const std::function<void(std::uint64_t, std::uint64_t)>& progress, std::uint64_t most_pairs) {
  Reader reader(bytes, cut_off);
  ReplayResult result;
  Replay replay(players, most_pairs, result);
  Counter counter;
  std::vector<Op> ops;
  std::uint64_t hits = 0;
  for (std::optional<Op> op = reader.next(); op; op = reader.next()) {
    std::visit(counter, *op);
    const bool batch = std::holds_alternative<Batch>(*op);
    if (std::holds_alternative<BoxQuery>(*op)) hits += counter.alive;
    ops.push_back(std::move(*op));
    if (!batch && ops.size() < most_ops_at_once && hits < most_hits_at_once) continue;
    if (!replay.run(ops)) return result;
    ops.clear();
    hits = 0;
    if (batch && progress) progress(result.batches, result.pairs);
  }
  replay.run(ops);
  return result;
}

}  // namespace boxstream::record
