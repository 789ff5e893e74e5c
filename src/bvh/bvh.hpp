// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

#include "base/thresholds.hpp"
#include "bvh/bvh_batch.hpp"
#include "bvh/bvh_block.hpp"
#include "bvh/plane_test.hpp"

namespace boxstream::detail {

/// The index behind queries: a bounding volume hierarchy with eight children per node over slots (numbers that the
/// caller gives to boxes), followed by a tail of pending inserts: boxes that are not in the tree yet.
///
/// The tree is implicit. Leaf boxes lie in blocks of eight, in the order of `slot_at_`; box i of level L + 1 bounds
/// block i of level L, down from one root block. So there are no child pointers, all levels but the lowest are small,
/// refitting is a pass over arrays, and the depth is ceil(log8 n).
///
/// `mark` notes that a box changed; `refresh` brings the tree up to date with all marked boxes. Between the two,
/// queries see the state at the last refresh. Concurrent queries are safe, anything else is not.
template <class S>
class Bvh {
 public:
  using Box = BasicAabb<S>;
  using Block = BoxBlock<S>;

  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr unsigned most_levels = 11;  // 8^11 > 2^32

  /// Up to `least_tail` boxes have no tree.
  explicit Bvh(std::size_t least_tail = thresholds.least_tail) : least_tail_(least_tail) {}

  /// Room for all slots below `slots`; may throw.
  void reserve_slots(std::size_t slots);

  /// The box of the slot changed, or it came or went.
  void mark(std::uint32_t slot) noexcept {
    assert(slot < is_marked_.size() && marked_.size() < marked_.capacity() + is_marked_[slot]);
    if (is_marked_[slot]) return;
    is_marked_[slot] = true;
    marked_.push_back(slot);
  }

  /// `box_of(slot)` is the present box of a slot below `slots`; slots with an invalid box are found by no query.
  /// std::bad_alloc leaves an index that can be refreshed again. Nothing depends on the floating-point environment.
  template <class BoxOf>
  void refresh(BoxOf&& box_of);

  /// Instead of mark and refresh: a tree of all slots below `slots` that never changes, without the data for changes.
  template <class BoxOf>
  void build(std::size_t slots, BoxOf&& box_of);

  /// The same tree, of as many boxes as it has in tree order: `box_of(i)` is in slot `slot_of(i)`.
  template <class SlotOf, class BoxOf>
  void build_in_order(std::size_t boxes, SlotOf&& slot_of, BoxOf&& box_of);

  /// The tree of a refresh in parts, for an index that is not used meanwhile: `begin_build`, then `build_part` until it
  /// is true, then `refresh`, which takes in what was marked in between. A part costs about `work`, in halves of what
  /// a box costs in a batch of all. `with_room` leaves some for boxes to come.
  void begin_build(bool with_room = false);
  template <class BoxOf>
  bool build_part(std::uint64_t work, BoxOf&& box_of);
  /// Of all parts of so many boxes together: six for each to be collected and put in place, and one for each halving.
  static std::uint64_t work_of_build(std::size_t boxes) {
    return boxes * std::uint64_t{6 + static_cast<unsigned>(std::bit_width(boxes / Block::width))};
  }

  /// Number of boxes that a refresh would sort into a new tree: all if a rebuild is likely, else none. `recent` is the
  /// number of changes that the caller knows of; refits are not counted.
  std::size_t refresh_cost(std::size_t recent) const;

  /// True if boxes have come for which the tree had no place: a quarter of those with which a refresh makes it anew, or
  /// half of them, so that a new one had better be begun.
  bool lacks_room() const { return 4 * live_tail() > longest_tail(); }
  bool is_worn() const { return 2 * live_tail() > longest_tail(); }

  /// Gives slots other numbers, `to[slot]`, from 0 on in the same order. Slots without a valid box may have none.
  /// Nothing may be marked.
  void rename_slots(Span<const std::uint32_t> to) noexcept;
  std::size_t marks() const { return marked_.size(); }
  std::size_t slot_count() const { return place_.size(); }
  bool has_marks() const { return !marked_.empty(); }

  void clear() noexcept;
  /// What only the next rebuild needs.
  void drop_scratch() noexcept { std::vector<Centre>().swap(centres_); }

  /// Calls `visit(slot)` for each box that shares a point with `box`, which is valid, until it returns false. Where
  /// denormal numbers are taken for zero, for some more.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit&& visit) const;

  /// Calls `sink` with all pairs of (box, slot) that share a point, for valid boxes, in portions. This one and the
  /// walks below need a DefaultFloatEnvironment.
  void find_overlaps(Span<const Box> boxes, BatchWalk<S>& walk, FunctionRef<void(Span<const Pair>)> sink) const;

  /// Visits boxes near the ray first; `visit(slot, enter, length)` returns the new length, negative to stop.
  template <class Visit>
  void for_each_hit(const RaySlabs<S>& ray, Visit&& visit) const;

  /// Calls `visit(slot)` for each box that is behind none of the planes, until it returns false.
  template <class Visit>
  void for_each_not_behind(Span<const PlaneTest> planes, Visit&& visit) const;

  Box bounds() const;

  // Access for walks that live in other files.
  /// Zero if all boxes are pending.
  unsigned levels() const { return tree_size_ == 0 ? 0 : static_cast<unsigned>(levels_.size()); }
  /// Lane i of block b of a level bounds block 8 b + i of the level below; those of level 0 are boxes.
  const Block& block(unsigned level, std::size_t i) const {
    return level == 0 ? leaves_[i] : nodes_[levels_[level].first + i];
  }
  /// Leaf blocks from this one on hold pending inserts.
  const Block* leaves() const { return leaves_.data(); }
  std::size_t tree_blocks() const { return tree_size_ / Block::width; }
  std::size_t leaf_blocks() const { return leaves_.size(); }
  /// The box of a lane of leaf block place / 8, and its slot.
  Box box_at(std::size_t place) const { return leaves_[place / Block::width].get(place % Block::width); }
  std::uint32_t slot_at(std::size_t place) const { return slot_at_[place]; }
  const std::uint32_t* slots() const { return slot_at_.data(); }

  /// Throws std::logic_error naming the first broken invariant, `box_of` as in `refresh`. The index must be fresh.
  template <class BoxOf>
  void validate(BoxOf&& box_of) const;

 private:
  struct Centre {
    S at[3];
    std::uint32_t slot;
  };
  struct Level {
    std::size_t first;  // in nodes_
    std::size_t blocks;
  };

  Block& block(unsigned level, std::size_t i) { return level == 0 ? leaves_[i] : nodes_[levels_[level].first + i]; }

  template <class BoxOf>
  bool take_in_marked(BoxOf&& box_of);
  template <class BoxOf>
  void rebuild(BoxOf&& box_of);
  template <class BoxOf>
  void collect(std::size_t first, std::size_t last, BoxOf&& box_of);
  template <class BoxOf>
  void fill(std::size_t first, std::size_t last, BoxOf&& box_of);
  std::uint64_t arrange_next();
  void reserve_places(std::size_t tree_size);
  void lay_out(std::size_t boxes);
  void grow_to(std::size_t places) noexcept;
  void build_nodes();
  void bound_leaves(std::size_t first, std::size_t last);
  void bound_nodes();
  void forget_changes();
  void expect_dirt();
  bool refit() noexcept;
  void move_to_tail(std::size_t leaf_block) noexcept;
  Box bounds_of_leaf(std::size_t leaf) const {
    return levels_.size() == 1 ? leaves_[leaf].bounds() : block(1, leaf / Block::width).get(leaf % Block::width);
  }
  bool is_far(std::size_t leaf, const Box& box) const {
    return girth(merged(bounds_of_leaf(leaf), box)) / 2 > built_girth_[leaf];
  }
  std::uint32_t find_home(const Box& box) const;
  void put(std::uint32_t slot, const Box& box) noexcept;
  void put_at(std::size_t place, std::uint32_t slot, const Box& box) noexcept;
  void append(std::uint32_t slot, const Box& box) noexcept;
  void leave(std::uint32_t slot) noexcept;
  void drop_tail() noexcept;
  std::size_t tail() const { return slot_at_.size() - tree_size_; }
  /// Without the places that boxes have left.
  std::size_t live_tail() const { return tail() - tail_holes_.size(); }
  std::size_t longest_tail() const { return longest_tail_of(tree_size_); }
  std::size_t longest_tail_of(std::size_t tree_size) const;

  std::size_t least_tail_;
  // Leaf boxes: those of the tree, then pending inserts. place_ is the inverse of slot_at_.
  std::vector<Block> leaves_;
  std::vector<std::uint32_t> slot_at_;
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> tail_holes_;  // places in the tail that boxes have left: new ones take them
  std::uint32_t last_left_ = none;         // a place in the tree that a box has left, and perhaps another has taken
  bool was_rebuilt_ = false;               // by the last refresh
  std::size_t tree_size_ = 0;              // places in the tree, a multiple of the block width

  std::vector<Block> nodes_;              // levels 1 and up
  std::vector<Level> levels_;             // levels_[0] is leaves_
  std::vector<S> built_girth_;            // of each leaf block of the tree, when it was built
  std::vector<std::uint8_t> free_lanes_;  // of each of them, how many lanes have no box

  std::vector<std::uint32_t> marked_;
  std::vector<std::uint8_t> is_marked_;
  std::vector<std::uint64_t> dirty_;  // a bit for each block of a level, while it is refitted
  std::vector<std::uint64_t> dirty_above_;
  std::vector<Centre> centres_;

  /// A tree is built in this order. `at` is how far a step has come.
  struct Building {
    enum Step { collecting, arranging, filling, bounding, done } step = done;
    std::size_t at = 0, slots = 0;
    std::size_t in_leaf = Block::width;  ///< boxes of a leaf block: with fewer there is room for some that come
    /// Ranges of centres that are not arranged, depth first with the smaller part done later: at most one for each
    /// halving.
    struct Range {
      std::size_t first, count;
    } pending[64];
    unsigned top = 0;
  } building_;
};

extern template class Bvh<float>;
extern template class Bvh<double>;

}  // namespace boxstream::detail

#include "bvh/bvh_planes.hpp"
#include "bvh/bvh_refresh.hpp"
#include "bvh/bvh_walk.hpp"
