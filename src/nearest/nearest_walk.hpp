// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <boxstream/detail/float_environment.hpp>

#include "bvh/bvh.hpp"
#include "nearest/box_walk.hpp"
#include "nearest/nearest_block.hpp"
#include "nearest/nearest_distance.hpp"

namespace boxstream::detail {

/// One side of a walk: the boxes of an index.
template <class S>
class NearSide {
 public:
  explicit NearSide(const Bvh<S>& bvh) : bvh_(&bvh) {}

  /// Where to begin: the root, if any, and blocks of pending inserts.
  struct Top {
    std::uint8_t level;
    std::uint32_t at;
  };
  bool has_nodes() const { return bvh_->levels() > 1; }
  std::size_t tops() const { return has_root() + bvh_->leaf_blocks() - bvh_->tree_blocks(); }
  Top top(std::size_t i) const {
    if (i < has_root()) return {static_cast<std::uint8_t>(bvh_->levels()), 0};
    return {1, static_cast<std::uint32_t>(bvh_->tree_blocks() + i - has_root())};
  }

  BasicAabb<S> box(std::size_t place) const { return bvh_->box_at(place); }
  const BoxBlock<S>& block(unsigned level, std::uint32_t block) const { return bvh_->block(level - 1, block); }

  /// A leaf whose boxes have nothing in common.
  bool is_pending_block(unsigned level, std::uint32_t at) const { return level == 1 && at >= bvh_->tree_blocks(); }

  /// Of a box or a block. Of blocks of the tree, the ones above have them.
  BasicAabb<S> bounds(unsigned level, std::uint32_t at) const {
    if (level == 0) return box(at);
    if (level >= bvh_->levels() || is_pending_block(level, at)) return block(level, at).bounds();
    return block(level + 1, at / BoxBlock<S>::width).get(at % BoxBlock<S>::width);
  }

  bool operator==(const NearSide&) const = default;

 private:
  std::size_t has_root() const { return bvh_->levels() != 0; }

  const Bvh<S>* bvh_;
};

/// A pair of boxes.
struct NearPlaces {
  std::uint32_t a, b;
};

template <class S, class Offer>
class NearVisits;

/// Pairs of the boxes in one block, whose places are `8 block + lane`.
template <class S, class Offer>
void visit_near(const BoxBlock<S>& boxes, std::uint32_t block, NearVisits<S, Offer>& visits) {
  constexpr std::uint32_t width = BoxBlock<S>::width;
  S squared[width * width];
  for (unsigned first = 0; first < width && !visits.limit().is_over();) {
    visits.come_in();
    const auto mask = lanes_near_each_other(boxes, visits.limit().reach(), first, squared);
    visits.visit(mask, squared, [=](unsigned bit) {
      return NearPlaces{width * block + bit / width, width * block + bit % width};
    });
  }
}

/// Blocks yet to be compared, of two indexes or of one: of leaves (level 1) or of nodes (above). One side may be a box
/// (level 0, by place).
template <class S>
struct NearStep {
  S squared;  // distance, about
  std::uint32_t a;
  std::uint32_t b;
  std::uint8_t level_a;
  std::uint8_t level_b;
  std::uint16_t first;  // of those that were found with it, which lie side by side
};

/// Calls `offer(limit, place in x, place in y, squared)` for pairs of boxes that may be nearer than the limit.
/// `squared` is an estimate of their squared distance. `offer` may change the limit. Near pairs come first as long as
/// the limit falls; after that, pairs come as they are found.
template <class S, class Offer>
class NearVisits {
 public:
  /// Constructs the Offer in place from `of`: copying what was just written would stall.
  template <class... Of>
  explicit NearVisits(S limit, Of&&... of) : NearVisits(NearLimit<S>(limit), std::forward<Of>(of)...) {}
  template <class... Of>
  explicit NearVisits(const NearLimit<S>& limit, Of&&... of) : limit_(limit), offer_(std::forward<Of>(of)...) {}

  /// For callers that set no limit before they have many: it falls in the end, but until then boxes come as they are
  /// found.
  void expect_late_limit() {
    most_idle_ = ~0u;
    is_late_ = true;
  }

  const NearLimit<S>& limit() const { return limit_; }
  /// True while sorting by distance pays.
  bool is_falling() const { return idle_ < most_idle_; }
  /// True before the first box is offered that is to set the limit: only a way to one is sought then.
  bool seeks_first() const { return !limit_.is_finite() && !is_late_ && is_falling(); }

  /// Those in `mask`. In the caller's environment: what is compared here is compared as integers.
  template <class PairOf>
  void visit(std::uint64_t mask, const S* squared, PairOf pair_of) {
    if (mask == 0) return;
    go_out();
    while (mask != 0 && !limit_.is_over()) {
      const bool is_any = (mask & (mask - 1)) == 0 || !is_falling() || (is_late_ && !limit_.is_finite());
      const unsigned bit = is_any ? static_cast<unsigned>(std::countr_zero(mask)) : nearest_of(mask, squared);
      if (mask == 0) return;
      mask &= ~(std::uint64_t{1} << bit);
      if (limit_.reaches(squared[bit])) offer(pair_of(bit), squared[bit]);
    }
  }

  /// Those of a leaf that are left and within reach, as number `8 block + lane` each, with 0 for what they are near to.
  void visit(NearLanes<S>& lanes) {
    go_out();
    while (!limit_.is_over()) {
      const auto key = lanes.least();
      if (key > reach()) return;
      if (!is_falling() || (is_late_ && !limit_.is_finite())) return visit_in_order(lanes);
      visit_one(lanes, key);
    }
  }
  /// Before arithmetic: visits leave the environment as it is for the caller's code.
  void come_in() {
    if constexpr (requires { offer_.come_in(); }) offer_.come_in();
  }
  /// No key of a box within the limit is larger.
  typename NearLanes<S>::Key reach() const { return NearLanes<S>::key_of(limit_.reach()); }

 private:
  void go_out() {
    if constexpr (requires { offer_.go_out(); }) offer_.go_out();
  }

  void visit_in_order(NearLanes<S>& lanes) {
    for (const auto key : lanes.keys)
      if (key <= reach() && !limit_.is_over()) visit_one(lanes, key);
  }

  void visit_one(NearLanes<S>& lanes, typename NearLanes<S>::Key key) {
    const unsigned lane = NearLanes<S>::lane_of(key);
    lanes.keys[lane] = NearLanes<S>::gone;
    offer(NearPlaces{0, lanes.block * NearLanes<S>::width + lane}, NearLanes<S>::squared_of(key));
  }

  template <class Pair>
  void offer(const Pair& boxes, S squared) {
    const auto before = limit_.bits();
    offer_(limit_, boxes.a, boxes.b, squared);
    // A visitor that has left the limit at infinity is likely to go on doing so.
    idle_ = limit_.bits() < before ? 0 : idle_ + (limit_.is_finite() ? 1 : 4);
  }

  /// The nearest lane within reach; `mask` keeps the lanes within reach. By integers, without branches, because which
  /// lane is nearer is unpredictable: numbers that are not negative have the order of their bits. The lowest bits hold
  /// the lane.
  unsigned nearest_of(std::uint64_t& mask, const S* squared) const {
    constexpr std::uint64_t places = 63;
    std::uint64_t least = ~std::uint64_t{0};
    std::uint64_t near = 0;
    for (std::uint64_t left = mask; left != 0; left &= left - 1) {
      const auto place = static_cast<unsigned>(std::countr_zero(left));
      const std::uint64_t key = (bits_of(squared[place]) & ~places) | place;
      if (key <= places) return place;  // none is nearer than one that touches
      least = key < least ? key : least;
      near |= std::uint64_t{limit_.reaches(squared[place])} << place;
    }
    mask = near;
    return static_cast<unsigned>(least & places);
  }
  static std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
  static std::uint64_t bits_of(float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)} << 32; }

  NearLimit<S> limit_;
  Offer offer_;
  unsigned most_idle_ = 4;  // offers without a lower limit after which the limit counts as final
  bool is_late_ = false;
  unsigned idle_ = 0;  // offers since the limit fell
};

/// Pairs of boxes of two sides, or of one index, each pair once. Depth first; the steps that are left lie on the
/// caller's stack.
template <class S, class Offer>
class NearWalk {
 public:
  /// Opens `most` blocks at most.
  NearWalk(NearSide<S> x, NearSide<S> y, NearVisits<S, Offer>& visits, std::size_t most)
      : x_(x), y_(y), is_same_(x == y), visits_(visits), limit_(visits.limit()), most_(most) {}

  /// Returns how many blocks were opened: tests check that there are few.
  std::size_t run() {
    const std::size_t count_a = x_.tops(), count_b = y_.tops();
    if (!is_same_) {
      for (std::size_t a = 0; a < count_a; ++a)
        for (std::size_t b = 0; b < count_b; ++b) drain(x_.top(a), y_.top(b));
      return opened_;
    }
    // What was put into one block is likely to be near. So a leaf is the shortest way to a first pair.
    if (x_.has_nodes() && visits_.seeks_first()) {
      open({0, 0, 0, 1, 1, 0});
      first_is_open_ = true;
    }
    for (std::size_t a = 0; a < count_a; ++a) drain(x_.top(a), x_.top(a));
    for (std::size_t a = 0; a < count_a; ++a)
      for (std::size_t b = a + 1; b < count_a; ++b) drain(x_.top(a), x_.top(b));
    return opened_;
  }

 private:
  using Step = NearStep<S>;
  using Top = typename NearSide<S>::Top;
  static constexpr unsigned width = BoxBlock<S>::width;
  // A step goes and has at most 64 children; if its sides are on different levels, eight.
  static constexpr unsigned most_steps = 64 * (Bvh<S>::most_levels + 1);

  /// Once the walk is over, steps stay where they are, and there is no room for those of all tops.
  void drain(Top a, Top b) {
    if (is_over()) return;
    steps_[size_] = {0, a.at, b.at, a.level, b.level, static_cast<std::uint16_t>(size_)};
    ++size_;
    while (size_ != 0 && !is_over()) {
      const Step step = take();
      if (limit_.reaches(step.squared)) open(step);
    }
  }
  bool is_over() const { return limit_.is_over() || opened_ >= most_; }

  /// The nearest of the steps that were found last, while that pays; if it is out of reach, they all are. Most of them
  /// are by then, so they are not sorted before.
  Step take() {
    Step& last = steps_[size_ - 1];
    if (!visits_.is_falling()) return steps_[--size_];
    const unsigned first = last.first;
    unsigned least = --size_;
    for (unsigned i = size_; i-- > first;) least = bits_of(steps_[i]) < bits_of(steps_[least]) ? i : least;
    std::swap(steps_[least], last);
    const Step step = last;
    if (!limit_.reaches(step.squared)) size_ = first;
    return step;
  }
  /// In the caller's environment.
  static auto bits_of(const Step& step) { return std::bit_cast<typename NearLimit<S>::Bits>(step.squared); }

  /// Replaces the wider of the two by its children, or both. So a small set opens only what is near of a large one,
  /// whatever their levels are. A block of pending inserts is opened first.
  void open(const Step& at) {
    ++opened_;
    visits_.come_in();
    S squared[width * width];
    const std::uint8_t below_a = lower(at.level_a), below_b = lower(at.level_b);
    switch (side_to_open(at)) {
      case Open::a: {
        const auto mask =
            lanes_near(&x_.block(at.level_a, at.a), 1, y_.bounds(at.level_b, at.b), limit_.reach(), squared);
        go_on(mask, squared,
              [&](unsigned i) -> Step { return {squared[i], child(at.a, i), at.b, below_a, at.level_b, 0}; });
        break;
      }
      case Open::b: {
        const auto mask =
            lanes_near(&y_.block(at.level_b, at.b), 1, x_.bounds(at.level_a, at.a), limit_.reach(), squared);
        go_on(mask, squared,
              [&](unsigned j) -> Step { return {squared[j], at.a, child(at.b, j), at.level_a, below_b, 0}; });
        break;
      }
      case Open::both: {
        if (is_same_ && at.a == at.b) return open_one(at);
        const auto mask = lanes_near(x_.block(at.level_a, at.a), y_.block(at.level_b, at.b),
                                     y_.bounds(at.level_b, at.b), limit_.reach(), squared);
        const auto step_of = [&](unsigned bit) -> Step {
          return {squared[bit], child(at.a, bit / width), child(at.b, bit % width), below_a, below_b, 0};
        };
        return go_on(mask, squared, step_of);
      }
    }
  }

  /// A block and itself.
  void open_one(const Step& at) {
    if (at.level_a == 1 && at.a == 0 && first_is_open_) return;
    const BoxBlock<S>& block = x_.block(at.level_a, at.a);
    if (at.level_a == 1) return visit_near(block, at.a, visits_);
    const std::uint8_t below = lower(at.level_a);
    S squared[width * width];
    // Boxes of one block are likely to be near each other: once their distances set the limit, the order of the others
    // does not matter.
    for (unsigned first = 0; first < width;) {
      const auto mask = lanes_near_each_other(block, limit_.reach(), first, squared);
      push(mask, [&](unsigned bit) -> Step {
        return {squared[bit], child(at.a, bit / width), child(at.b, bit % width), below, below, 0};
      });
    }
    push(block.filled(), [&](unsigned i) -> Step { return {0, child(at.a, i), child(at.a, i), below, below, 0}; });
  }

  enum class Open { a, b, both };

  Open side_to_open(const Step& at) const {
    if (at.level_a == 0) return Open::b;
    if (at.level_b == 0) return Open::a;
    const bool is_a_pending = x_.is_pending_block(at.level_a, at.a),
               is_b_pending = y_.is_pending_block(at.level_b, at.b);
    if (is_a_pending != is_b_pending) return is_a_pending ? Open::a : Open::b;
    // Blocks of one tree on one level are about as wide.
    if (is_same_ && at.level_a == at.level_b) return Open::both;
    // To a first pair, eight are looked at here and eight there, not sixty-four.
    if (visits_.seeks_first()) return at.level_a < at.level_b ? Open::b : Open::a;
    if (at.level_a == 1 && at.level_b == 1) return Open::both;  // whose lanes are compared with bounds first
    const S a = girth(x_.bounds(at.level_a, at.a)), b = girth(y_.bounds(at.level_b, at.b));
    return a > 2 * b ? Open::a : b > 2 * a ? Open::b : Open::both;
  }

  template <class StepOf>
  void go_on(std::uint64_t mask, const S* squared, StepOf&& step_of) {
    if (mask == 0) return;
    const Step first = step_of(0);
    if ((first.level_a | first.level_b) == 0)
      visits_.visit(mask, squared, step_of);
    else
      push(mask, step_of);
  }

  template <class StepOf>
  void push(std::uint64_t mask, StepOf&& step_of) {
    const auto first = static_cast<std::uint16_t>(size_);
    for (; mask != 0; mask &= mask - 1) {
      Step& step = steps_[size_++] = step_of(static_cast<unsigned>(std::countr_zero(mask)));
      step.first = first;
    }
  }

  static std::uint32_t child(std::uint32_t block, unsigned lane) { return block * width + lane; }
  static std::uint8_t lower(std::uint8_t level) { return static_cast<std::uint8_t>(level - 1); }

  const NearSide<S> x_;
  const NearSide<S> y_;
  const bool is_same_;
  NearVisits<S, Offer>& visits_;
  const NearLimit<S>& limit_;
  const std::size_t most_;
  std::size_t opened_ = 0;
  bool first_is_open_ = false;  // the first leaf and itself
  unsigned size_ = 0;
  Step steps_[most_steps];
};

/// Pairs of boxes of two sides that may be nearer than the limit, of one side each pair once. Returns how many blocks
/// were opened for them, `most` at most.
template <class S, class Offer>
std::size_t visit_near(NearSide<S> x, NearSide<S> y, NearVisits<S, Offer>& visits,
                       std::size_t most = std::numeric_limits<std::size_t>::max()) {
  return NearWalk<S, Offer>(x, y, visits, most).run();
}

/// Pairs of the boxes in block `a` of some and block `b` of others, or of the same.
template <class S, class Offer>
void visit_near(const BoxBlock<S>* as, std::uint32_t a, const BoxBlock<S>* bs, std::uint32_t b,
                NearVisits<S, Offer>& visits) {
  constexpr std::uint32_t width = BoxBlock<S>::width;
  constexpr S inf = std::numeric_limits<S>::infinity();
  constexpr BasicAabb<S> all{{-inf, -inf, -inf}, {inf, inf, inf}};
  if (&as[a] == &bs[b]) return visit_near(as[a], a, visits);
  if (visits.limit().is_over()) return;
  S squared[width * width];
  visits.come_in();
  const S reach = visits.limit().reach();
  // Bounds leave nothing out before there is a limit.
  const auto mask = lanes_near(as[a], bs[b], reach < inf ? bs[b].bounds() : all, reach, squared);
  visits.visit(mask, squared, [=](unsigned bit) {
    return NearPlaces{width * a + bit / width, width * b + bit % width};
  });
}

/// Pairs within each of a few blocks.
template <class S, class Offer>
void visit_near_within(const BoxBlock<S>* blocks, std::size_t count, NearVisits<S, Offer>& visits) {
  for (std::uint32_t i = 0; i < count && !visits.limit().is_over(); ++i) visit_near(blocks[i], i, visits);
}

/// Pairs of the boxes in a few blocks, likewise.
template <class S, class Offer>
void visit_near(const BoxBlock<S>* blocks, std::size_t count, NearVisits<S, Offer>& visits) {
  for (std::uint32_t offset = 0; offset < count; ++offset)  // what is in one block is likely to be near
    for (std::uint32_t a = 0, b = offset; b < count; ++a, ++b) visit_near(blocks, a, blocks, b, visits);
}

/// Pairs of the boxes in a few blocks and in a few others.
template <class S, class Offer>
void visit_near(const BoxBlock<S>* as, std::size_t count_a, const BoxBlock<S>* bs, std::size_t count_b,
                NearVisits<S, Offer>& visits) {
  for (std::uint32_t a = 0; a < count_a; ++a)
    for (std::uint32_t b = 0; b < count_b; ++b) visit_near(as, a, bs, b, visits);
}

/// The boxes in no tree that may be nearer to one box than the limit, eight blocks after the other.
template <class S, class Offer>
class NearPending {
 public:
  NearPending(const BasicAabb<S>& box, const Bvh<S>& bvh, NearVisits<S, Offer>& visits)
      : box_(box), bvh_(bvh), visits_(visits), next_(bvh.tree_blocks()) {
    open();
  }

  /// Of the eight blocks, the one of the box that is nearest.
  typename NearLanes<S>::Key least() const { return row_.nearest.least(); }

  void visit_all() {
    for (; !visits_.limit().is_over(); open()) {
      for (auto key = least(); key <= visits_.reach() && !visits_.limit().is_over(); key = least()) {
        const unsigned i = NearLanes<S>::lane_of(key);
        row_.nearest.keys[i] = NearLanes<S>::gone;
        visits_.visit(row_.blocks[i]);
      }
      if (next_ == bvh_.leaf_blocks()) return;
    }
  }

 private:
  void open() {
    const std::size_t count = std::min<std::size_t>(NearLanes<S>::width, bvh_.leaf_blocks() - next_);
    visits_.come_in();
    open_row(bvh_.leaves(), next_, count, box_, row_);
    next_ += count;
  }

  const BasicAabb<S>& box_;
  const Bvh<S>& bvh_;
  NearVisits<S, Offer>& visits_;
  std::size_t next_;  // block
  BoxRow<S> row_;
};

/// The boxes of an index that may be nearer to one box than the limit, the nearest ones first as long as the limit
/// falls. The first place offered is 0.
template <class S, class Offer>
void visit_near(const BasicAabb<S>& box, const Bvh<S>& bvh, NearVisits<S, Offer>& visits) {
  if (bvh.levels() == 0) {
    if (bvh.leaf_blocks() == 1) {  // whose order is that of its lanes
      BoxRow<S> row;
      visits.come_in();
      open_row(bvh.leaves(), 0, 1, box, row);
      visits.visit(row.blocks[0]);
      return;
    }
    if (bvh.leaf_blocks() != 0) NearPending<S, Offer>(box, bvh, visits).visit_all();
    return;
  }
  const auto visit_tree = [&](BoxWalk<S>& walk) {
    while (!visits.limit().is_over()) {
      visits.come_in();
      if (!find_next(bvh, box, visits.reach(), walk)) return;
      visits.visit(walk.leaf());
    }
  };
  BoxWalk<S> walk;
  begin_walk(bvh, box, walk);
  if (bvh.leaf_blocks() == bvh.tree_blocks()) return visit_tree(walk);
  NearPending<S, Offer> pending(box, bvh, visits);
  const bool is_pending_nearer = !find_next(bvh, box, visits.reach(), walk) || pending.least() < walk.leaf().least();
  if (is_pending_nearer) pending.visit_all();
  visit_tree(walk);
  if (!is_pending_nearer) pending.visit_all();
}

}  // namespace boxstream::detail
