// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <boxstream/world.hpp>

#include "core/oracle.hpp"
#include "world/point_distance.hpp"

namespace boxstream::tests {

/// A proxy by the number of creations before it. Never reused, so that histories stay distinct.
using Birth = std::size_t;
using Births = std::pair<Birth, Birth>;

/// The contract of BasicWorld in the slowest and plainest way: everything is looked at each time.
template <class S>
class Model {
 public:
  struct Proxy {
    ProxyId id;
    BasicAabb<S> box;
    Filter filter;
    std::uint64_t user;
    bool alive;
    bool moved;
    bool touched;  // moved, or its filter is another one, or it is to be asked about again
  };
  struct Changes {
    std::vector<Births> begun;
    std::vector<Births> ended;
  };

  explicit Model(bool sticky_filters) : sticky_(sticky_filters) {}

  void create(ProxyId id, const BasicAabb<S>& box, Filter filter, std::uint64_t user) {
    birth_[{id.slot, id.generation}] = proxies_.size();
    proxies_.push_back({id, box, filter, user, true, true, true});
  }
  void destroy(Birth b) { proxies_[b].alive = false; }
  void clear() {
    proxies_.clear();
    birth_.clear();
    held_.clear();
    forgotten_.clear();
  }
  /// True if the pair was held.
  bool release(const Births& pair) {
    forgotten_.insert(pair);
    return held_.erase(pair) != 0;
  }

  std::vector<Proxy>& proxies() { return proxies_; }
  const std::vector<Proxy>& proxies() const { return proxies_; }
  Birth birth(ProxyId id) const { return birth_.at({id.slot, id.generation}); }
  const std::set<Births>& held() const { return held_; }
  std::set<Births>& held() { return held_; }

  std::vector<Birth> alive() const {
    std::vector<Birth> all;
    for (Birth b = 0; b < proxies_.size(); ++b)
      if (proxies_[b].alive) all.push_back(b);
    return all;
  }

  bool can_begin(Birth a, Birth b) const {
    return touch(a, b) && permit(proxies_[a].filter, proxies_[b].filter) && held_.count({a, b}) == 0;
  }

  /// If no earlier update has asked about it in vain since something changed.
  bool is_news(const Births& pair) const {
    return proxies_[pair.first].touched || proxies_[pair.second].touched || forgotten_.count(pair) != 0;
  }

  /// `accept(births)` is called for the pairs that World must ask about, in the order in which it must ask.
  template <class Accept>
  Changes update(Accept&& accept) {
    Changes changes;
    std::set<Births> next;
    for (const Births& pair : held_) {
      const bool filters = permit(proxies_[pair.first].filter, proxies_[pair.second].filter);
      if (touch(pair.first, pair.second) && (sticky_ || filters))
        next.insert(pair);
      else
        changes.ended.push_back(pair);
    }
    const auto living = alive();
    for (std::size_t i = 0; i < living.size(); ++i)
      for (std::size_t j = i + 1; j < living.size(); ++j) {
        const Births pair{living[i], living[j]};
        if (!can_begin(pair.first, pair.second) || !is_news(pair) || !accept(pair)) continue;
        next.insert(pair);
        changes.begun.push_back(pair);
      }
    held_ = next;
    forgotten_.clear();
    for (Proxy& p : proxies_) p.moved = p.touched = false;
    return changes;
  }

  std::vector<Birth> in_box(const BasicAabb<S>& box) const {
    std::vector<Birth> found;
    for (const Birth b : alive())
      if (makes_sense(box) && makes_sense(proxies_[b].box) && tests::touch(box, proxies_[b].box)) found.push_back(b);
    return found;
  }

  /// Where the ray enters each box that it meets, by the formula of the contract.
  std::map<Birth, S> on_ray(const BasicRay<S>& ray) const {
    std::map<Birth, S> found;
    for (const Birth b : alive()) {
      S enter = 0;
      if (makes_sense(proxies_[b].box) && meets(ray, proxies_[b].box, enter)) found[b] = enter;
    }
    return found;
  }

  std::vector<Birth> nearest(const S (&point)[3], std::size_t count) const {
    std::vector<std::pair<PointDistance, Birth>> all;
    for (const Birth b : alive())
      if (makes_sense(proxies_[b].box)) all.push_back({PointDistance(point, proxies_[b].box), b});
    std::sort(all.begin(), all.end());
    all.resize(std::min(count, all.size()));
    std::vector<Birth> found;
    for (const auto& [distance, b] : all) found.push_back(b);
    return found;
  }

 private:
  bool touch(Birth a, Birth b) const {
    const Proxy& p = proxies_[a];
    const Proxy& q = proxies_[b];
    return p.alive && q.alive && makes_sense(p.box) && makes_sense(q.box) && tests::touch(p.box, q.box);
  }

  static bool meets(const BasicRay<S>& ray, const BasicAabb<S>& box, S& enter) {
    const auto is_nan = [](S x) { return x != x; };
    if (!(ray.length >= 0)) return false;
    S leave = std::min(ray.length, std::numeric_limits<S>::max());
    enter = 0;
    for (int d = 0; d < 3; ++d) {
      if (ray.inverse_direction[d] == 0) leave = std::min(leave, S(0));
      if (is_nan(ray.origin[d]) || is_nan(ray.inverse_direction[d]) || is_nan(ray.extent_min[d]) ||
          is_nan(ray.extent_max[d]))
        return false;
      const S below = box.min[d] - ray.extent_max[d] - ray.origin[d];
      const S above = box.max[d] - ray.extent_min[d] - ray.origin[d];
      // Rounding is all that the contract allows: what overflows on the way is no farther off for that.
      const auto t_at = [&](S distance, S bound, S extent) {
        constexpr S most = std::numeric_limits<S>::max();
        if (distance >= -most && distance <= most) return distance * ray.inverse_direction[d];
        return (bound / 4 - extent / 4 - ray.origin[d] / 4) * (4 * ray.inverse_direction[d]);
      };
      if (ray.inverse_direction[d] == 0 || std::abs(ray.inverse_direction[d]) == std::numeric_limits<S>::infinity()) {
        if (below > 0 || above < 0) return false;
        continue;
      }
      S t_near = t_at(below, box.min[d], ray.extent_max[d]);
      S t_far = t_at(above, box.max[d], ray.extent_min[d]);
      if (ray.inverse_direction[d] < 0) std::swap(t_near, t_far);
      if (t_near > enter) enter = t_near;
      if (t_far < leave) leave = t_far;
    }
    return enter <= leave;
  }

  bool sticky_;
  std::vector<Proxy> proxies_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Birth> birth_;
  std::set<Births> held_;
  std::set<Births> forgotten_;  // released since the last update
};

}  // namespace boxstream::tests
