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

  /// All that a distance query without a limit calls back with, in some order.
  Calls all_pairs() const {
    Calls calls;
    for (std::size_t i = 0; i < oracle_.entries.size(); ++i)
      for (std::size_t j = i + 1; j < oracle_.entries.size(); ++j) add_if_valid(i, oracle_, j, calls);
    return allowed(calls, [this](int a, int b) { return pairs(states_.at(a), states_.at(b)); });
  }
  Calls all_pairs(const Object& object) const {
    Calls calls;
    for (const auto& entry : oracle_.entries)
      if (entry.object != &object && can_touch(entry.box) && can_touch(oracle_.read(object)))
        calls.push_back({entry.object->name(), object.name()});
    return allowed(calls, [this](int a, int b) { return pairs(states_.at(a), as_query(b)); });
  }
  Calls all_pairs(const Model& other) const {
    Calls calls;
    for (std::size_t i = 0; i < oracle_.entries.size(); ++i)
      for (std::size_t j = 0; j < other.oracle_.entries.size(); ++j)
        if (oracle_.entries[i].object != other.oracle_.entries[j].object) add_if_valid(i, other.oracle_, j, calls);
    return allowed(calls, [&](int a, int b) { return pairs(states_.at(a), other.states_.at(b)); });
  }

 private:
  static bool can_touch(const FclBox<S>& box) { return !is_inside_out(box); }

  void add_if_valid(std::size_t i, const Oracle<S>& other, std::size_t j, Calls& calls) const {
    const auto &a = oracle_.entries[i], &b = other.entries[j];
    if (can_touch(a.box) && can_touch(b.box)) calls.push_back({a.object->name(), b.object->name()});
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
