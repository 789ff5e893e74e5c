// SPDX-License-Identifier: MIT
#include "boxes/output_forms.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "peers/peer.hpp"

namespace boxstream::report {
namespace {

using Boxes = std::vector<Aabb>;
using Pairs = std::vector<Pair>;

class Count final : public OutputForm {
  void run(const Boxes& boxes) override {
    count_ = 0;
    detector_.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      count_ += pairs.size();
      return true;
    });
  }
  bool agrees(const TwoFrames& input) const override { return count_ == input.count; }
  Detector detector_;
  std::uint64_t count_ = 0;
};

class Stream final : public OutputForm {
  void run(const Boxes& boxes) override {
    sum_ = 0;
    detector_.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      for (const Pair& pair : pairs) sum_ += key_of(pair);
      return true;
    });
  }
  bool agrees(const TwoFrames& input) const override { return sum_ == input.sum; }
  Detector detector_;
  std::uint64_t sum_ = 0;
};

class List : public OutputForm {
 public:
  explicit List(bool sorted) : sorted_(sorted) {}
  void run(const Boxes& boxes) override {
    detector_.find_pairs(Span<const Aabb>(boxes), pairs_);
    if (sorted_) std::sort(pairs_.begin(), pairs_.end());
  }
  bool agrees(const TwoFrames& input) const override {
    return bench::summarize(pairs_) == input.pairs && (!sorted_ || std::is_sorted(pairs_.begin(), pairs_.end()));
  }

 protected:
  Pairs pairs_;

 private:
  bool sorted_;
  Detector detector_;
};

class PeerList final : public OutputForm {
 public:
  explicit PeerList(std::unique_ptr<bench::Peer> peer) : peer_(std::move(peer)) {}
  void run(const Boxes& boxes) override { peer_->find_pairs(boxes, pairs_); }
  bool agrees(const TwoFrames& input) const override { return bench::summarize(pairs_) == input.pairs; }

 private:
  std::unique_ptr<bench::Peer> peer_;
  Pairs pairs_;
};

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
  bool agrees(const TwoFrames& input) const override { return changes_of(begun_, ended_) == input.changes; }

 private:
  Pairs before_, begun_, ended_;
};

/// Changes by a World.
class WorldChanges final : public OutputForm {
  void first(const Boxes& boxes) override {
    ids_.resize(boxes.size());
    world_.create(boxes, {}, ids_);
    world_.update();
  }
  void run(const Boxes& boxes) override {
    world_.move(ids_, boxes);
    world_.update();
  }
  bool agrees(const TwoFrames& input) const override {
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

}  // namespace

bench::PairSummary changes_of(Span<const Pair> begun, Span<const Pair> ended) {
  bench::PairSummary all = bench::summarize(begun), gone = bench::summarize(ended);
  // The two are told apart: what begins where another ends is no less wrong than what is missing.
  all.count += gone.count;
  all.hash += 3 * gone.hash;
  return all;
}

std::unique_ptr<OutputForm> make_output_form(const std::string& name) {
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

}  // namespace boxstream::report
