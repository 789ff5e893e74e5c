// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/thresholds.hpp"
#include "witness.hpp"

namespace boxstream::tests {

/// Changes of a World and of its model alike; what each call says is compared.
template <class S, class World>
class Changes : protected Witness<S, World> {
 public:
  using Witness<S, World>::Witness;

 protected:
  using Base = Witness<S, World>;
  using Base::all_births;
  using Base::births;
  using Base::box_of_;
  using Base::id;
  using Base::model_;
  using Base::world_;

  void create(unsigned value) {
    const auto box = box_of_(value);
    const Filter filter = filter_from(value);
    const ProxyId made = world_.create(box, filter, value);
    ASSERT_TRUE(made);
    model_.create(made, box, filter, value);
  }
  static Filter filter_from(unsigned value) { return value % 7 == 0 ? Filter{value % 3, ~0u} : Filter{}; }

  /// Filters and user words may be left out.
  void bulk_create(unsigned count, unsigned value) {
    std::vector<BasicAabb<S>> boxes;
    std::vector<Filter> filters;
    std::vector<std::uint64_t> users;
    for (unsigned i = 0; i < count; ++i) {
      boxes.push_back(box_of_(value + i));
      if (value % 2 == 0) filters.push_back(filter_from(value + i));
      if (value % 3 == 0) users.push_back(value + i);
    }
    std::vector<ProxyId> made(count);
    world_.create(Span<const BasicAabb<S>>(boxes), Span<const Filter>(filters), Span<ProxyId>(made),
                  Span<const std::uint64_t>(users));
    for (unsigned i = 0; i < count; ++i) {
      ASSERT_TRUE(made[i]);
      model_.create(made[i], boxes[i], filters.empty() ? Filter{} : filters[i], users.empty() ? 0 : users[i]);
    }
  }

  /// Some of the living and some of the dead, repetitions included, mostly in order of creation.
  std::vector<Birth> mixture(unsigned which, unsigned value) const {
    std::vector<Birth> chosen;
    const auto& all = model_.proxies();
    if (all.empty()) return chosen;
    const std::size_t stride = 1 + which % 5;
    for (std::size_t i = which % stride; i < all.size(); i += stride) chosen.push_back(i);
    if (value % 2 == 0) std::reverse(chosen.begin(), chosen.end());
    for (unsigned i = 0; i < value % 4; ++i) chosen.push_back((which + 31 * i) % all.size());
    return chosen;
  }

  void bulk_destroy(unsigned which, unsigned value) {
    auto chosen = mixture(which, value);
    chosen.resize(std::min<std::size_t>(chosen.size(), value % 64));
    std::vector<ProxyId> ids{ProxyId{}};
    std::size_t live = 0;
    for (const Birth b : chosen) {
      ids.push_back(id(b));
      live += model_.proxies()[b].alive;
      model_.destroy(b);
    }
    EXPECT_EQ(world_.destroy(Span<const ProxyId>(ids)), live);
  }

  void bulk_move(unsigned which, unsigned value) {
    std::vector<ProxyId> ids{ProxyId{}};
    std::vector<BasicAabb<S>> boxes{box_of_(value)};
    std::size_t live = 0;
    for (const Birth b : mixture(which, value)) {
      auto& proxy = model_.proxies()[b];
      const bool goes = (value / 4 + b) % 3 != 0;
      const auto box = goes ? box_of_(value + static_cast<unsigned>(b)) : proxy.box;
      ids.push_back(proxy.id);
      boxes.push_back(box);
      if (proxy.alive) {
        ++live;
        note_move(proxy, box);
      }
    }
    EXPECT_EQ(world_.move(Span<const ProxyId>(ids), Span<const BasicAabb<S>>(boxes)), live);
  }

  void destroy(Birth b) {
    ASSERT_TRUE(world_.destroy(id(b)));
    model_.destroy(b);
    EXPECT_FALSE(world_.contains(id(b)));
    EXPECT_FALSE(world_.destroy(id(b)));
  }
  void move(Birth b, unsigned value) {
    const auto box = box_of_(value);
    auto& proxy = model_.proxies()[b];
    ASSERT_TRUE(world_.move(proxy.id, box));
    note_move(proxy, box);
  }
  /// Some go to a box whose number is near that of their first one, and the last one anywhere.
  void nudge_few(unsigned which, unsigned value) {
    const auto living = model_.alive();
    const std::size_t count = std::min<std::size_t>(living.size(), 2 + value % 6);
    for (std::size_t i = 0; i < count; ++i) {
      const Birth b = living[(which + 7919 * i) % living.size()];
      move(b, i + 1 == count ? value : static_cast<unsigned>(model_.proxies()[b].user) + value % 3);
    }
  }
  static void note_move(typename Model<S>::Proxy& proxy, const BasicAabb<S>& box) {
    const bool same = makes_sense(box) ? proxy.box == box : !makes_sense(proxy.box);
    proxy.box = box;
    proxy.moved |= !same;
    proxy.touched |= !same;
  }
  void filter(Birth b, unsigned value) {
    const Filter f{value % 4, value / 4 % 4};
    ASSERT_TRUE(world_.set_filter(id(b), f));
    auto& proxy = model_.proxies()[b];
    proxy.touched |= f.group != proxy.filter.group || f.mask != proxy.filter.mask;
    proxy.filter = f;
  }
  void refilter(Birth b) {
    ASSERT_TRUE(world_.refilter(id(b)));
    model_.proxies()[b].touched = true;
  }
  void refilter() {
    world_.refilter();
    for (auto& proxy : model_.proxies()) proxy.touched = true;
  }

  /// `modulus` 0: without a callback. Else the callback refuses one pair in `modulus`.
  void update(unsigned modulus) {
    const auto living = model_.alive();
    std::uint64_t invalid = 0;
    std::uint64_t moved = 0;
    for (const Birth b : living) {
      invalid += !makes_sense(model_.proxies()[b].box);
      moved += model_.proxies()[b].moved;
    }
    std::vector<Births> asked;
    const auto verdict = [&](const Births& p) { return modulus == 0 || (p.first * 5 + p.second * 3) % modulus != 0; };
    const auto accept = [&](ProxyId a, ProxyId b) {
      asked.push_back(births({a, b}));
      return verdict(asked.back());
    };
    const WorldStats stats = modulus == 0 ? world_.update() : world_.update(accept);

    std::vector<Births> to_be_asked;
    const auto changes = model_.update([&](const Births& p) {
      if (modulus != 0) to_be_asked.push_back(p);
      return verdict(p);
    });
    if (asked.size() >= detail::thresholds.asked_at_once) std::sort(asked.begin(), asked.end());
    EXPECT_EQ(asked, to_be_asked);
    EXPECT_EQ(all_births(world_.begun()), changes.begun);
    EXPECT_EQ(all_births(world_.ended()), changes.ended);
    EXPECT_EQ(stats.proxies, living.size());
    EXPECT_EQ(stats.invalid, invalid);
    EXPECT_EQ(stats.moved, moved);
    EXPECT_EQ(stats.pairs, model_.held().size());
    EXPECT_EQ(stats.begun, changes.begun.size());
    EXPECT_EQ(stats.ended, changes.ended.size());
    follow_update();
  }

  /// One that is held, or any.
  void release(unsigned which, unsigned value) {
    const auto& held = model_.held();
    const auto& all = model_.proxies();
    Births pair;
    if (value % 4 < 3) {
      if (held.empty()) return;
      pair = *std::next(held.begin(), static_cast<std::ptrdiff_t>(which % held.size()));
    } else {
      if (all.size() < 2) return;
      const Birth first = which % all.size();
      pair = std::minmax(first, (first + 1 + value / 4 % (all.size() - 1)) % all.size());
    }
    ProxyId a = id(pair.first);
    ProxyId b = id(pair.second);
    if (value % 2 == 1) std::swap(a, b);
    const bool alive = all[pair.first].alive && all[pair.second].alive;
    const auto place = world_.pair_place(a, b);
    const bool released = world_.release(a, b);  // before the model has done it: the World may be looked at meanwhile
    EXPECT_EQ(released, alive && model_.release(pair));
    EXPECT_FALSE(world_.release(a, b));
    EXPECT_EQ(place.has_value(), released);
    if (place) beside_.erase(beside_.begin() + std::ptrdiff_t(*place));
  }

  void begin_pairs(Birth b, unsigned modulus) {
    std::vector<Births> asked;
    std::vector<Births> begun;
    world_.begin_pairs_of(
        id(b),
        [&](ProxyId x, ProxyId y) {
          asked.push_back(births({x, y}));
          return modulus == 1 || (asked.back().first + asked.back().second) % modulus != 0;
        },
        [&](ProxyPair p) {
          begun.push_back(births(p));
          beside_.insert(beside_.begin() + std::ptrdiff_t(world_.pair_place(p.b, p.a).value()), begun.back());
        });
    std::vector<Births> to_be_asked;
    std::vector<Births> to_begin;
    for (const Birth other : model_.alive()) {
      const Births pair = std::minmax(b, other);
      if (other == b || !model_.can_begin(pair.first, pair.second)) continue;
      to_be_asked.push_back(pair);
      if (modulus == 1 || (pair.first + pair.second) % modulus != 0) to_begin.push_back(pair);
    }
    for (const Births& pair : to_begin) model_.held().insert(pair);
    if (asked.size() >= detail::thresholds.asked_at_once) std::sort(asked.begin(), asked.end());
    EXPECT_EQ(asked, to_be_asked);
    EXPECT_EQ(begun, to_begin);
  }

  void clear() {
    world_.clear();
    model_.clear();
    EXPECT_TRUE(world_.begun().empty());
    EXPECT_TRUE(world_.ended().empty());
    EXPECT_TRUE(world_.changes().empty());
    beside_.clear();
  }

 private:
  /// What a user keeps beside the pairs goes where they go.
  void follow_update() {
    const Splice changes = world_.changes();
    const std::vector<Births> begun = all_births(world_.begun()), ended = all_births(world_.ended());
    ASSERT_EQ(changes.inserted.size(), begun.size());
    ASSERT_EQ(changes.removed.size(), ended.size());
    for (std::size_t i = 0; i < ended.size(); ++i) ASSERT_EQ(beside_.at(changes.removed[i]), ended[i]);
    splice(beside_, changes);
    for (std::size_t i = 0; i < begun.size(); ++i) beside_.at(changes.inserted[i]) = begun[i];
    EXPECT_TRUE(std::equal(beside_.begin(), beside_.end(), model_.held().begin(), model_.held().end()));
  }

  std::vector<Births> beside_;
};

}  // namespace boxstream::tests
