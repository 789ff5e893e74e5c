// SPDX-License-Identifier: MIT
#include "boxes/output_forms.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include <boxstream/detector.hpp>
#include <boxstream/world.hpp>

#include "peers/ours.hpp"

namespace boxstream::report {
namespace {

using Boxes = std::vector<Aabb>;
using Pairs = std::vector<Pair>;

struct Count {
  void run(const Boxes& boxes) {
    count = 0;
    detector.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      count += pairs.size();
      return true;
    });
  }
  bool agrees(const TwoFrames& input) const { return count == input.count; }
  Detector detector;
  std::uint64_t count = 0;
};

struct Stream {
  void run(const Boxes& boxes) {
    sum = 0;
    detector.stream_pairs(Span<const Aabb>(boxes), [this](Span<const Pair> pairs) {
      for (const Pair& pair : pairs) sum += key_of(pair);
      return true;
    });
  }
  bool agrees(const TwoFrames& input) const { return sum == input.sum; }
  Detector detector;
  std::uint64_t sum = 0;
};

struct List {
  void run(const Boxes& boxes) {
    peer->find_pairs(boxes, pairs);
    if (sorted) std::sort(pairs.begin(), pairs.end());
  }
  bool agrees(const TwoFrames& input) const {
    return bench::summarize(pairs) == input.pairs && (!sorted || std::is_sorted(pairs.begin(), pairs.end()));
  }
  std::unique_ptr<bench::Peer> peer;
  bool sorted;
  Pairs pairs{};
};

/// Changes by merging two sorted lists.
struct MergedChanges {
  void run(const Boxes& boxes) {
    before.swap(now.pairs);
    now.run(boxes);
    begun.clear();
    ended.clear();
    std::set_difference(now.pairs.begin(), now.pairs.end(), before.begin(), before.end(), std::back_inserter(begun));
    std::set_difference(before.begin(), before.end(), now.pairs.begin(), now.pairs.end(), std::back_inserter(ended));
  }
  bool agrees(const TwoFrames& input) const { return changes_of(begun, ended) == input.changes; }
  List now{bench::make_detector(nullptr), true};
  Pairs before, begun, ended;
};

/// Changes by a World.
struct WorldChanges {
  void run(const Boxes& boxes) {
    if (ids.empty()) {
      ids.resize(boxes.size());
      world.create(boxes, {}, ids);
    } else {
      world.move(ids, boxes);
    }
    world.update();
  }
  bool agrees(const TwoFrames& input) const {
    const auto plain = [](Span<const ProxyPair> changes) {
      Pairs pairs;
      for (const ProxyPair& pair : changes) pairs.push_back({pair.a.slot, pair.b.slot});
      return pairs;
    };
    return world.pair_count() == input.count && changes_of(plain(world.begun()), plain(world.ended())) == input.changes;
  }
  World world;
  std::vector<ProxyId> ids;
};

template <class Form, class... Arguments>
OutputForm form(Arguments&&... arguments) {
  const std::shared_ptr<Form> made(new Form{std::forward<Arguments>(arguments)...});
  return {[made](const Boxes& boxes) { made->run(boxes); },
          [made](const TwoFrames& input) { return made->agrees(input); }};
}

}  // namespace

bench::PairSummary changes_of(Span<const Pair> begun, Span<const Pair> ended) {
  bench::PairSummary all = bench::summarize(begun), gone = bench::summarize(ended);
  // A pair that begins where another should end must change the sum.
  all.count += gone.count;
  all.hash += 3 * gone.hash;
  return all;
}

OutputForm make_output_form(const std::string& name) {
  if (name == "counted") return form<Count>();
  if (name == "streamed") return form<Stream>();
  if (name == "listed") return form<List>(bench::make_detector(nullptr), false);
  if (name == "sorted") return form<List>(bench::make_detector(nullptr), true);
  if (name == "changes, merged") return form<MergedChanges>();
  if (name == "changes, world") return form<WorldChanges>();
  for (bench::PeerConfig& config : bench::make_peers(1))
    if (config.name == name) return form<List>(std::move(config.peer), false);
  throw std::invalid_argument("no form of output \"" + name + "\"");
}

}  // namespace boxstream::report
