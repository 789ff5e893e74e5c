// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "changes.hpp"

namespace boxstream::tests {

enum class Kind {
  create,
  create_many,
  destroy,
  destroy_many,
  move,
  move_many,
  move_all,
  move_nowhere,
  bulk_create,
  bulk_destroy,
  bulk_move,
  filter,
  update,
  update_refusing,
  release,
  begin_pairs,
  query,
  stale,
  clear,  // the last one that inputs of the fuzzer know by its number
  nudge_few,
  distances,
  refilter,
  refilter_all,
  shrink_to_fit
};

struct Op {
  Kind kind;
  unsigned which;
  unsigned value;
};

inline std::ostream& operator<<(std::ostream& out, const Op& op) {
  return out << '(' << int(op.kind) << ' ' << op.which << ' ' << op.value << ')';
}

/// Plays operations on a World and on the model, and compares all that can be seen after each.
template <class S, class World>
class Player : Changes<S, World> {
 public:
  using Changes<S, World>::Changes;

  /// How many proxies live.
  std::size_t size() const { return model_.alive().size(); }

  void play(const Op& op) {
    const auto living = model_.alive();
    const auto some = [&](unsigned i) { return living[(op.which + i * 7919u) % living.size()]; };
    switch (op.kind) {
      case Kind::create:
        create(op.value);
        break;
      case Kind::create_many:
        for (unsigned i = 0; i < 20 + op.which % 100; ++i) create(op.value + i);
        break;
      case Kind::destroy:
        if (!living.empty()) destroy(some(0));
        break;
      case Kind::destroy_many:
        for (unsigned i = 0; i < 60; ++i)
          if (!model_.alive().empty()) destroy(model_.alive()[(op.which + i * 31) % model_.alive().size()]);
        break;
      case Kind::move:
        if (!living.empty()) move(some(0), op.value);
        break;
      case Kind::move_many:
        for (unsigned i = 0; i < 30 && !living.empty(); ++i) move(some(i), op.value + i);
        break;
      case Kind::move_all:
        for (const Birth b : living) move(b, op.value + static_cast<unsigned>(b));
        break;
      case Kind::move_nowhere:
        for (const Birth b : living) EXPECT_TRUE(world_.move(id(b), model_.proxies()[b].box));
        break;
      case Kind::bulk_create:
        bulk_create(op.which % 150, op.value);
        break;
      case Kind::bulk_destroy:
        bulk_destroy(op.which, op.value);
        break;
      case Kind::bulk_move:
        bulk_move(op.which, op.value);
        break;
      case Kind::filter:
        if (!living.empty()) filter(some(0), op.value);
        break;
      case Kind::update:
        update(0);
        break;
      case Kind::update_refusing:
        update(2 + op.value % 3);
        break;
      case Kind::release:
        release(op.which, op.value);
        break;
      case Kind::begin_pairs:
        if (!living.empty()) begin_pairs(some(0), 1 + op.value % 3);
        break;
      case Kind::nudge_few:
        if (!living.empty()) nudge_few(op.which, op.value);
        break;
      case Kind::query:
        query(op.value);
        break;
      case Kind::distances:
        distances(op.value);
        break;
      case Kind::stale:
        stale(op.which);
        break;
      case Kind::refilter:
        if (!living.empty()) refilter(some(0));
        break;
      case Kind::refilter_all:
        refilter();
        break;
      case Kind::shrink_to_fit:
        world_.shrink_to_fit();
        break;
      case Kind::clear:
        clear();
        break;
    }
    compare_state();
  }

  using Changes<S, World>::compare_all;

 private:
  using Base = Changes<S, World>;
  using Base::begin_pairs;
  using Base::bulk_create;
  using Base::bulk_destroy;
  using Base::bulk_move;
  using Base::clear;
  using Base::compare_state;
  using Base::create;
  using Base::destroy;
  using Base::distances;
  using Base::filter;
  using Base::id;
  using Base::model_;
  using Base::move;
  using Base::nudge_few;
  using Base::query;
  using Base::refilter;
  using Base::release;
  using Base::stale;
  using Base::update;
  using Base::world_;
};

}  // namespace boxstream::tests
