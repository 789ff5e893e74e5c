// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/decomposition.hpp>
#include <boxstream/detail/float_environment.hpp>
#include <boxstream/mpi/detail/changes.hpp>
#include <boxstream/out_of_core.hpp>
#include <boxstream/world.hpp>

namespace boxstream::mpi::detail {

/// The boxes that touch the part of one rank, and the events of pairs that are its own. A pair may begin for this rank
/// because a box came from elsewhere, or because the pair is another rank's no longer: neither is an event, and changes
/// have the boxes of the last frame with them so that this is seen.
template <class S>
class PartOfWorld {
 public:
  explicit PartOfWorld(Executor* executor) : world_({executor}) {}

  /// Brings boxes and pairs up to date. `before` and `now` are the decompositions of the last frame and of this one.
  void update(Span<const Change<S>> changes, const BasicDecomposition<S>& before, const BasicDecomposition<S>& now,
              std::size_t part) {
    changes_ = changes;
    apply(now, part);
    world_.update();
    const boxstream::detail::DefaultFloatEnvironment environment;
    const auto is_own = [part](const BasicDecomposition<S>& division, const Boxes& boxes) {
      return (division.before(part, boxes.a) & division.before(part, boxes.b)) == 0;
    };
    begun_.clear();
    for (const ProxyPair pair : world_.begun())
      if (!touch(boxes_before(pair)) && is_own(now, boxes_now(pair))) begun_.push_back(wide(pair));
    ended_.clear();
    for (const ProxyPair pair : world_.ended())
      if (!touch(boxes_now(pair)) && is_own(before, boxes_before(pair))) ended_.push_back(wide(pair));
    changes_ = {};
    std::fill(change_of_.begin(), change_of_.end(), 0);
  }

  void clear() {
    world_.clear();
    proxies_.clear();
    ids_.clear();
    change_of_.clear();
    changes_ = {};
    begun_.clear();
    ended_.clear();
  }

  std::size_t size() const { return world_.size(); }
  Span<const WidePair> begun() const { return begun_; }
  Span<const WidePair> ended() const { return ended_; }

  template <class Visit>
  void for_each_pair(const BasicDecomposition<S>& now, std::size_t part, Visit&& visit) const {
    world_.for_each_pair([&](ProxyPair pair) {
      return (now.before(part, world_.box(pair.a)) & now.before(part, world_.box(pair.b))) != 0 || visit(wide(pair));
    });
  }

 private:
  struct Boxes {
    BasicAabb<S> a, b;
  };

  static bool touch(const Boxes& boxes) { return is_valid(boxes.a) && is_valid(boxes.b) && overlaps(boxes.a, boxes.b); }

  /// Those that go come last: a slot gets no new id while an event may still have the old one.
  void apply(const BasicDecomposition<S>& now, std::size_t part) {
    Batch come, move, go;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      bool touches = false;
      now.for_each_touched(changes_[i].now, [&](std::size_t touched) { touches = touches || touched == part; });
      const auto found = proxies_.find(changes_[i].id);
      if (found != proxies_.end())
        (touches ? move : go).add(i, changes_[i].now, found->second);
      else if (touches)
        come.add(i, changes_[i].now, {});
    }
    world_.create(come.boxes, {}, come.proxies);
    for (std::size_t i = 0; i < come.proxies.size(); ++i) note_new(changes_[come.changes[i]].id, come.proxies[i]);
    world_.move(move.proxies, move.boxes);
    world_.destroy(go.proxies);
    for (const std::size_t i : go.changes) proxies_.erase(changes_[i].id);
    for (const Batch* batch : {&come, &move, &go})
      for (std::size_t i = 0; i < batch->changes.size(); ++i)
        change_of_[batch->proxies[i].slot] = batch->changes[i] + 1;
  }

  struct Batch {
    void add(std::size_t change, const BasicAabb<S>& box, ProxyId proxy) {
      changes.push_back(change);
      boxes.push_back(box);
      proxies.push_back(proxy);
    }

    std::vector<std::size_t> changes;
    std::vector<BasicAabb<S>> boxes;
    std::vector<ProxyId> proxies;
  };

  void note_new(std::uint64_t id, ProxyId proxy) {
    proxies_.emplace(id, proxy);
    if (proxy.slot >= ids_.size()) {
      ids_.resize(proxy.slot + 1);
      change_of_.resize(proxy.slot + 1);
    }
    ids_[proxy.slot] = id;
  }

  const Change<S>* change_of(ProxyId proxy) const {
    const std::size_t place = change_of_[proxy.slot];
    return place == 0 ? nullptr : &changes_[place - 1];
  }
  BasicAabb<S> box_before(ProxyId proxy) const {
    const Change<S>* change = change_of(proxy);
    return change != nullptr ? change->before : world_.box(proxy);
  }
  BasicAabb<S> box_now(ProxyId proxy) const {
    const Change<S>* change = change_of(proxy);
    return change != nullptr ? change->now : world_.box(proxy);
  }
  Boxes boxes_before(ProxyPair pair) const { return {box_before(pair.a), box_before(pair.b)}; }
  Boxes boxes_now(ProxyPair pair) const { return {box_now(pair.a), box_now(pair.b)}; }

  WidePair wide(ProxyPair pair) const {
    const auto [a, b] = std::minmax(ids_[pair.a.slot], ids_[pair.b.slot]);
    return {a, b};
  }

  boxstream::BasicWorld<S> world_;
  std::unordered_map<std::uint64_t, ProxyId> proxies_;
  std::vector<std::uint64_t> ids_;      // of slots
  std::vector<std::size_t> change_of_;  // of slots: 1 + the index of its change in this frame; 0: none
  Span<const Change<S>> changes_;       // of this frame
  std::vector<WidePair> begun_, ended_;
};

}  // namespace boxstream::mpi::detail
