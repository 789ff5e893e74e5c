// SPDX-License-Identifier: MIT
// One batch, more and more of its pairs touching, and what each form of the answer costs: counted, streamed, listed,
// sorted, as changes since the frame before.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "batches/random.hpp"
#include "boxes/pair_difference.hpp"
#include "motion.hpp"
#include "pair_hash.hpp"
#include "peers/peer.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using Boxes = std::vector<Aabb>;
using Pairs = std::vector<Pair>;

/// Two frames, what there is in the second, and what changed.
struct Input {
  double share;  ///< of all pairs, that touch
  Boxes before, now;
  std::uint64_t count = 0, begun = 0, ended = 0;
  bench::PairSummary pairs, changes;
};

/// A form of the answer. `first` sees the frame before, and is not timed; `run` is.
class Output {
 public:
  virtual ~Output() = default;
  virtual void first(const Boxes& boxes) { run(boxes); }
  virtual void run(const Boxes& boxes) = 0;
  /// Whether the last run was right.
  virtual bool agrees(const Input& input) const = 0;
};

class Count final : public Output {
  void run(const Boxes& boxes) override {
    count_ = 0;
    detector_.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      count_ += pairs.size();
      return true;
    });
  }
  bool agrees(const Input& input) const override { return count_ == input.count; }
  Detector detector_;
  std::uint64_t count_ = 0;
};

class Stream final : public Output {
  void run(const Boxes& boxes) override {
    seen_ = {};
    detector_.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      for (const Pair& pair : pairs) seen_.add(pair.a, pair.b);
      return true;
    });
  }
  bool agrees(const Input& input) const override { return seen_ == input.pairs; }
  Detector detector_;
  bench::PairSummary seen_;
};

class List : public Output {
 public:
  explicit List(bool sorted) : sorted_(sorted) {}
  void run(const Boxes& boxes) override {
    detector_.find_pairs(Span<const Aabb>(boxes), pairs_);
    if (sorted_) std::sort(pairs_.begin(), pairs_.end());
  }
  bool agrees(const Input& input) const override {
    return bench::summarize(pairs_) == input.pairs && (!sorted_ || std::is_sorted(pairs_.begin(), pairs_.end()));
  }

 protected:
  Pairs pairs_;

 private:
  bool sorted_;
  Detector detector_;
};

class PeerList final : public Output {
 public:
  explicit PeerList(std::unique_ptr<bench::Peer> peer) : peer_(std::move(peer)) {}
  void run(const Boxes& boxes) override { peer_->find_pairs(boxes, pairs_); }
  bool agrees(const Input& input) const override { return bench::summarize(pairs_) == input.pairs; }

 private:
  std::unique_ptr<bench::Peer> peer_;
  Pairs pairs_;
};

bench::PairSummary changes_of(Span<const Pair> begun, Span<const Pair> ended) {
  bench::PairSummary all = bench::summarize(begun), gone = bench::summarize(ended);
  // The two are told apart: what begins where another ends is no less wrong than what is missing.
  all.count += gone.count;
  all.hash += 3 * gone.hash;
  return all;
}

/// Changes by merging two sorted lists.
class MergedChanges final : public List {
 public:
  MergedChanges() : List(true) {}
  void run(const Boxes& boxes) override {
    before_.swap(pairs_);
    List::run(boxes);
    begun_.clear();
    ended_.clear();
    std::set_difference(pairs_.begin(), pairs_.end(), before_.begin(), before_.end(), std::back_inserter(begun_));
    std::set_difference(before_.begin(), before_.end(), pairs_.begin(), pairs_.end(), std::back_inserter(ended_));
  }
  bool agrees(const Input& input) const override { return changes_of(begun_, ended_) == input.changes; }

 private:
  Pairs before_, begun_, ended_;
};

/// Changes by a World.
class WorldChanges final : public Output {
  void first(const Boxes& boxes) override {
    ids_.resize(boxes.size());
    world_.create(boxes, {}, ids_);
    world_.update();
  }
  void run(const Boxes& boxes) override {
    world_.move(ids_, boxes);
    world_.update();
  }
  bool agrees(const Input& input) const override {
    const auto plain = [](Span<const ProxyPair> changes) {
      Pairs pairs;
      for (const ProxyPair& pair : changes) pairs.push_back({pair.a.slot, pair.b.slot});
      return pairs;
    };
    return world_.pair_count() == input.count &&
           changes_of(plain(world_.begun()), plain(world_.ended())) == input.changes;
  }
  World world_;
  std::vector<ProxyId> ids_;
};

std::unique_ptr<Output> output_named(const std::string& name) {
  if (name == "counted") return std::make_unique<Count>();
  if (name == "streamed") return std::make_unique<Stream>();
  if (name == "listed") return std::make_unique<List>(false);
  if (name == "sorted") return std::make_unique<List>(true);
  if (name == "changes, merged") return std::make_unique<MergedChanges>();
  if (name == "changes, world") return std::make_unique<WorldChanges>();
  for (bench::PeerConfig& config : bench::make_peers(1))
    if (config.name == name) return std::make_unique<PeerList>(std::move(config.peer));
  throw std::invalid_argument("no form of output \"" + name + "\"");
}

/// Cubes scattered over the unit cube, of which a share `wanted` of all pairs touches.
Input make_input(std::size_t n, double wanted) {
  // Two intervals of length s with starts uniform on [0, 1] meet with probability 2 s - s^2.
  const auto side = static_cast<float>(1 - std::sqrt(std::max(0.0, 1 - std::cbrt(wanted))));
  batches::Random random(1);
  Input input{};
  for (std::size_t i = 0; i < n; ++i) {
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(random.unit());
      box.max[d] = box.min[d] + side;
    }
    input.before.push_back(box);
  }
  bench::MovingBoxes moving(input.before, bench::Brownian{1, 0.1}, 1);
  moving.next_frame();
  input.now.assign(moving.boxes().begin(), moving.boxes().end());
  const Pairs old = reference_pairs(input.before), pairs = reference_pairs(input.now);
  Pairs begun, ended;
  std::set_difference(pairs.begin(), pairs.end(), old.begin(), old.end(), std::back_inserter(begun));
  std::set_difference(old.begin(), old.end(), pairs.begin(), pairs.end(), std::back_inserter(ended));
  const auto all = static_cast<double>(n) * static_cast<double>(n - 1) / 2;
  input.share = static_cast<double>(pairs.size()) / all;
  input.count = pairs.size();
  input.pairs = bench::summarize(pairs);
  input.changes = changes_of(begun, ended);
  input.begun = begun.size();
  input.ended = ended.size();
  return input;
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

struct Candidate {
  const Input* input;
  std::string name;
  double bytes = 0;
  std::string failure;
};

/// Milliseconds; notes the memory that is held afterwards.
double timed(Candidate& candidate) {
  const std::size_t before = bytes_in_use();
  const std::unique_ptr<Output> output = output_named(candidate.name);
  output->first(candidate.input->before);
  const double ms = accuracy::stopwatch([&] { output->run(candidate.input->now); });
  candidate.bytes = static_cast<double>(bytes_in_use() - before);
  if (!output->agrees(*candidate.input)) candidate.failure = "not the pairs, or the changes, that there are";
  return ms;
}

}  // namespace

Results outputs_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  return with_settings_of(experiment, [&](const json& settings) {
    Results results;
    results.cost_unit = "ms per batch";
    results.metrics = {"ns_per_pair", "bytes_per_pair", "pairs", "changes", "wrong"};
    const auto n = settings.at("boxes").get<std::size_t>();
    const std::string panel = fmt::format("{} boxes", n);
    std::vector<std::unique_ptr<Input>> inputs;
    std::vector<Candidate> candidates;
    for (const auto share : settings.at("shares").get<std::vector<double>>()) {
      progress(fmt::format("{:g} of all pairs", share));
      inputs.push_back(std::make_unique<Input>(make_input(n, share)));
      for (const json& name : settings.at("outputs")) {
        (void)output_named(name);
        candidates.push_back({inputs.back().get(), name, 0, {}});
      }
    }
    const accuracy::Turns turns = accuracy::take_turns(candidates.size(), options.repeats, [&](std::size_t i) {
      progress(fmt::format("{:.2g} of all pairs: {}", candidates[i].input->share, candidates[i].name));
      return timed(candidates[i]);
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& candidate = candidates[i];
      const Input& input = *candidate.input;
      const auto pairs = static_cast<double>(input.count);
      results.points.push_back({panel,
                                candidate.name,
                                fmt::format("{:.2g}", input.share),
                                input.share,
                                turns.costs[i],
                                NAN,
                                {1e6 * turns.costs[i].median / pairs, candidate.bytes / pairs, pairs,
                                 static_cast<double>(input.begun + input.ended), candidate.failure.empty() ? 0.0 : 1.0},
                                candidate.failure});
    }
    results.twins.push_back({panel, turns.twin_spread});
    return results;
  });
}

}  // namespace boxstream::report
