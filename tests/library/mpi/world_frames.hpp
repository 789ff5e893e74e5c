// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <boxstream/world.hpp>

#include "core/box_sets.hpp"
#include "shares.hpp"

namespace boxstream::mpi_test {

using WidePairs = std::vector<WidePair>;

inline WidePairs sorted(WidePairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

inline WidePairs all_of(Span<const WidePair> own) {
  WidePairs all;
  for (const auto& pairs : from_all(WidePairs(own.begin(), own.end())))
    all.insert(all.end(), pairs.begin(), pairs.end());
  return sorted(std::move(all));
}

/// The events and pairs of boxes by their ids, on one machine.
template <class S>
class Reference {
 public:
  void update(const std::map<std::uint64_t, BasicAabb<S>>& boxes) {
    for (auto i = proxies_.begin(); i != proxies_.end();)
      i = boxes.count(i->first) == 0 ? (world_.destroy(i->second), proxies_.erase(i)) : std::next(i);
    for (const auto& [id, box] : boxes) {
      const auto found = proxies_.find(id);
      if (found == proxies_.end())
        proxies_[id] = world_.create(box, {}, id);
      else
        world_.move(found->second, box);
    }
    world_.update();
    const WidePairs before = pairs_;
    pairs_.clear();
    world_.for_each_pair([&](ProxyPair pair) {
      const auto [a, b] = std::minmax({world_.user(pair.a), world_.user(pair.b)});
      pairs_.push_back({a, b});
      return true;
    });
    pairs_ = sorted(std::move(pairs_));
    begun = without(pairs_, before);
    ended = without(before, pairs_);
  }

  const WidePairs& pairs() const { return pairs_; }
  WidePairs begun, ended;

 private:
  static WidePairs without(const WidePairs& these, const WidePairs& those) {
    WidePairs left;
    std::set_difference(these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(left));
    return left;
  }

  boxstream::BasicWorld<S> world_;
  std::map<std::uint64_t, ProxyId> proxies_;
  WidePairs pairs_;
};

/// Boxes that all ranks make in the same way, and each gives its share of.
template <class S>
class Frames {
 public:
  explicit Frames(std::uint64_t seed) : random_(seed) {
    const auto boxes = tests::box_set<S>("dense").make(300, seed);
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[id_of(i)] = boxes[i];
  }

  const std::map<std::uint64_t, BasicAabb<S>>& boxes() const { return boxes_; }
  std::mt19937_64& random() { return random_; }
  auto& any() { return *std::next(boxes_.begin(), static_cast<std::ptrdiff_t>(random_() % boxes_.size())); }
  S up_to(S most) { return most * static_cast<S>(random_() % 1001) / 1000; }

  void tremble(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) shift(any().second, up_to(2) - 1, up_to(2) - 1, up_to(2) - 1);
  }
  void drift(S step) {
    for (auto& [id, box] : boxes_) shift(box, step * static_cast<S>(id >> 40), 0, 0);
  }
  void teleport(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) std::swap(any().second, any().second);
  }
  void grow(std::size_t count) {
    constexpr S inf = std::numeric_limits<S>::infinity();
    for (std::size_t i = 0; i < count; ++i) any().second.max[random_() % 3] = inf;
  }
  void spoil(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) any().second.min[1] = std::numeric_limits<S>::quiet_NaN();
  }
  void come_and_go(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const BasicAabb<S> box = any().second;
      boxes_.erase(any().first);
      boxes_[id_of(1000 + random_() % 100)] = box;
    }
  }
  void gather() {
    for (auto& [id, box] : boxes_) box = {{0, 0, 0}, {1, 1, 1}};
  }
  void scatter() {
    for (auto& [id, box] : boxes_) {
      box = {{0, 0, 0}, {1, 1, 1}};
      shift(box, up_to(9), up_to(9), up_to(9));
    }
  }

 private:
  static void shift(BasicAabb<S>& box, S x, S y, S z) {
    const S by[] = {x, y, z};
    for (int d = 0; d < 3; ++d) {
      box.min[d] += by[d];
      box.max[d] += by[d];
    }
  }

  std::map<std::uint64_t, BasicAabb<S>> boxes_;
  std::mt19937_64 random_;
};

}  // namespace boxstream::mpi_test
