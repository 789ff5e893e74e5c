// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <boxstream/detector.hpp>
#include <boxstream/span.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/cuts/wide_tree.hpp"
#include "batch/front/filter_numbers.hpp"
#include "batch/front/two_sets.hpp"

namespace boxstream::detail {

/// Boxes of a search grouped by filters, so that boxes whose filters refuse each other are not compared. Boxes with
/// equal filters form a class, and classes that accept the same classes are merged. A class that accepts nothing is
/// left out. Each other class is joined with itself, if it accepts itself, then with all accepted classes not joined
/// with it yet. A function of the filters alone.
class Classes {
 public:
  /// Reads the filters: none, or one a box; of a few boxes at first. For a single set, `b` is that of `a`. Holds memory
  /// of `arena` until the frame ends.
  Classes(Span<const Filter> a, std::size_t size_a, Span<const Filter> b, std::size_t size_b, bool self, Arena& arena);

  /// True if `join` is faster than one search of all boxes that tests the filters of each pair found.
  bool are_worth_it() const { return worth_it_; }

  /// Whether `join` may find pairs that filters refuse.
  bool need_filters() const { return need_filters_; }

  /// Joins the classes that accept each other. Pairs need no filter test unless `need_filters()`. Sources contain all
  /// boxes of a set. Invalid ones are counted in the stats of `two_sets`. False when the search is to stop.
  template <class S>
  bool join(const BoxSource<S>& a, const BoxSource<S>& b, WideTree& tree, CrossSearch& two_sets) const;

 private:
  static constexpr unsigned most = FilterNumbers::most;

  /// Classes as bits.
  using Set = std::uint64_t;
  static Set only(unsigned c) { return Set{1} << c; }

  /// One of the two sets of a search.
  struct Side {
    Span<const Filter> filters;
    std::size_t size;
    FilterNumbers numbers;
    const std::uint8_t* of_box = nullptr;  // null: all are of the first class
  };

  /// The valid boxes of each class.
  struct Parts {
    Span<const Record> of[most];
    Span<const Record> merged(Set classes, Arena& arena) const;
  };

  const Side& other() const { return self_ ? a_ : b_; }
  bool read_some(Side& side);
  bool read_all(Side& side, Arena& arena);
  bool estimate_benefit();
  void find_acceptance();
  void merge_duplicates(const Side& side);
  std::uint64_t boxes_of(Set classes) const;
  Set find_standing() const;
  bool choose_standing();

  /// Calls `visit(class, with_itself, others)` for each of the joins, until one returns false. No `others`: none.
  template <class Visit>
  bool for_each_join(const Visit& visit) const;

  /// If few boxes are not standing: joins them with each other and with the standing boxes that they may overlap, at
  /// once. Nothing if most standing boxes would remain.
  template <class S>
  std::optional<bool> join_with_standing(const BoxSource<S>& boxes, WideTree& tree, CrossSearch& search) const;

  template <class Source>
  void gather(const Source& boxes, const Side& side, Parts& parts, Arena& arena, Stats& stats) const;

  bool self_;
  bool worth_it_ = false;
  Side a_, b_;
  Set standing_ = 0;                // classes that do not accept each other, if most boxes are of these
  bool need_filters_ = false;       // without the boxes that only overlap standing ones
  Set active_ = 0;                  // classes that accept any, one for each merged group
  std::uint64_t boxes_[most] = {};  // merged classes included
  Set accepts_[most] = {};
  std::uint8_t merged_into_[most] = {};
};

}  // namespace boxstream::detail
