// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "support.hpp"

namespace boxstream::fcl_test {

/// What a manager is to say after any history, with groups, static objects, margin and source of boxes.
template <class S>
class Model {
 public:
  using Object = BoxObject<S>;
  using Groups = boxstream::fcl::Groups;

  struct State {
    Groups groups;
    bool is_static = false;
  };

  void put(Object& object) {
    oracle_.put(object);
    states_.try_emplace(object.name());
  }
  void put_static(Object& object) {
    put(object);
    states_[object.name()].is_static = true;
  }
  void erase(Object& object) {
    oracle_.erase(object);
    states_.erase(object.name());
  }
  void clear() {
    oracle_.entries.clear();
    states_.clear();
    looks_different_ = false;
  }
  void look(Object& object) { oracle_.look(object); }
  /// Static objects are looked at only if they may look different.
  void look() {
    for (auto& entry : oracle_.entries)
      if (!states_.at(entry.object->name()).is_static || looks_different_) entry.box = oracle_.read(*entry.object);
    looks_different_ = false;
  }
  void set_margin(S margin) {
    const S before = oracle_.reach;
    oracle_.reach = margin > 0 ? std::min(margin / 2, largest<S>) : S(0);
    looks_different_ |= oracle_.reach != before && !oracle_.entries.empty();
  }
  void set_source(typename Manager<S>::BoxSource source) {
    looks_different_ |= source != oracle_.source && !oracle_.entries.empty();
    oracle_.source = source;
  }
  bool set_groups(const Object& object, Groups groups) {
    const auto known = states_.find(object.name());
    if (known != states_.end()) known->second.groups = groups;
    return known != states_.end();
  }
  bool set_static(const Object& object, bool is_static) {
    const auto known = states_.find(object.name());
    if (known != states_.end()) known->second.is_static = is_static;
    return known != states_.end();
  }

  /// As it was last read.
  FclBox<S> box(const Object& object) const { return oracle_.find(&object)->box; }

  std::vector<fcl_test::Object<S>*> objects() const {
    std::vector<fcl_test::Object<S>*> all;
    for (const auto& entry : oracle_.entries) all.push_back(entry.object);
    return all;
  }

  Calls collide() const {
    return allowed(oracle_.collide(), [this](int a, int b) { return pairs(states_.at(a), states_.at(b)); });
  }
  /// A query object has the bits with which it is managed, and is looked for among static ones too.
  Calls collide(const Object& object) const {
    return allowed(oracle_.collide(object), [this](int a, int b) { return pairs(states_.at(a), as_query(b)); });
  }
  Calls collide(const Model& other) const {
    return allowed(oracle_.collide(other.oracle_),
                   [&](int a, int b) { return pairs(states_.at(a), other.states_.at(b)); });
  }

  /// What a distance query calls back with if callbacks set no limit, in some order.
  struct Near {
    Calls all;
    /// Those at a distance that is below the limit that queries begin with, the largest number. A query that comes to
    /// others before any callback leaves them out.
    Calls certain;
  };
  Near all_pairs() const {
    Near near;
    for (std::size_t i = 0; i < oracle_.entries.size(); ++i)
      for (std::size_t j = i + 1; j < oracle_.entries.size(); ++j) {
        const auto &a = oracle_.entries[i], &b = oracle_.entries[j];
        if (pairs(states_.at(a.object->name()), states_.at(b.object->name()))) add(a, b, near);
      }
    return near;
  }
  Near all_pairs(const Object& object) const {
    Near near;
    const typename Oracle<S>::Entry query{const_cast<Object*>(&object), oracle_.read(object)};
    for (const auto& entry : oracle_.entries)
      if (entry.object != &object && pairs(states_.at(entry.object->name()), as_query(object.name())))
        add(entry, query, near);
    return near;
  }
  Near all_pairs(const Model& other) const {
    Near near;
    for (const auto& a : oracle_.entries)
      for (const auto& b : other.oracle_.entries)
        if (a.object != b.object && pairs(states_.at(a.object->name()), other.states_.at(b.object->name())))
          add(a, b, near);
    return near;
  }

 private:
  static bool can_touch(const FclBox<S>& box) { return !is_inside_out(box); }

  static void add(const typename Oracle<S>::Entry& a, const typename Oracle<S>::Entry& b, Near& near) {
    if (!can_touch(a.box) || !can_touch(b.box)) return;
    const auto call = std::pair(a.object->name(), b.object->name());
    near.all.push_back(call);
    if (distance(a.box, b.box) < largest<S>) near.certain.push_back(call);
  }
  static long double distance(const FclBox<S>& a, const FclBox<S>& b) {
    long double gaps[3];
    for (int d = 0; d < 3; ++d) {
      const bool a_first = a.max_[d] < b.min_[d];
      const long double low = a_first ? a.max_[d] : b.max_[d], high = a_first ? b.min_[d] : a.min_[d];
      gaps[d] = low < high ? high - low : 0;
    }
    return std::hypot(gaps[0], gaps[1], gaps[2]);
  }

  State as_query(int name) const {
    const auto known = states_.find(name);
    return known == states_.end() ? State{} : State{known->second.groups, false};
  }

  static bool pairs(const State& a, const State& b) {
    return (a.groups.group & b.groups.mask) != 0 && (b.groups.group & a.groups.mask) != 0 &&
           !(a.is_static && b.is_static);
  }

  template <class Accept>
  static Calls allowed(Calls calls, Accept accept) {
    calls.erase(
        std::remove_if(calls.begin(), calls.end(), [&](const auto& call) { return !accept(call.first, call.second); }),
        calls.end());
    return calls;
  }

  Oracle<S> oracle_;
  std::map<int, State> states_;
  bool looks_different_ = false;
};

}  // namespace boxstream::fcl_test
