// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/even_parts.hpp"
#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "bvh/bvh.hpp"

namespace boxstream::detail {

namespace {

constexpr std::size_t most_samples = thresholds.pivot_samples;

/// Moves elements that `is_left` accepts to the front and returns their number. Without branches on the data, so it is
/// several times faster than std::partition on random data.
template <class T, class IsLeft>
std::size_t partition_without_branches(T* first, std::size_t count, IsLeft&& is_left) {
  std::size_t left = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const T moving = first[i];
    first[i] = first[left];
    first[left] = moving;
    left += is_left(moving);
  }
  return left;
}

/// Like std::nth_element by one coordinate, with pivots from samples near the wanted place.
template <class Centre>
void select(Centre* first, std::size_t count, std::size_t wanted, int axis) {
  const auto less = [axis](const Centre& a, const Centre& b) { return a.at[axis] < b.at[axis]; };
  while (count > thresholds.few_centres) {
    Centre sample[most_samples];
    for (std::size_t i = 0; i < most_samples; ++i) sample[i] = first[begin_of_part(count, i, most_samples)];
    Centre* const pivot = sample + begin_of_part(most_samples, wanted, count);
    std::nth_element(sample, pivot, sample + most_samples, less);
    const auto at = pivot->at[axis];
    std::size_t left = partition_without_branches(first, count, [=](const Centre& c) { return c.at[axis] < at; });
    if (wanted >= left) {
      // Setting aside what equals the pivot makes each round smaller, even when all are equal.
      const std::size_t equal =
          partition_without_branches(first + left, count - left, [=](const Centre& c) { return c.at[axis] <= at; });
      if (wanted < left + equal) return;
      left += equal;
      first += left;
      count -= left;
      wanted -= left;
    } else {
      count = left;
    }
  }
  std::nth_element(first, first + wanted, first + count, less);
}

}  // namespace

template <class S>
void Bvh<S>::reserve_slots(std::size_t slots) {
  if (slots <= place_.size()) return;
  if (slots > marked_.capacity()) {
    const std::size_t capacity = std::max<std::size_t>(16, marked_.capacity() == 0 ? slots : slots + slots / 2);
    place_.reserve(capacity);
    is_marked_.reserve(capacity);
    marked_.reserve(capacity);  // the last one, because its capacity says whether all have room
  }
  place_.resize(slots, none);
  is_marked_.resize(slots, false);
}

template <class S>
void Bvh<S>::clear() noexcept {
  leaves_.clear();
  slot_at_.clear();
  place_.clear();
  tail_holes_.clear();
  tree_size_ = 0;
  nodes_.clear();
  levels_.clear();
  built_girth_.clear();
  free_lanes_.clear();
  marked_.clear();
  is_marked_.clear();
  building_.step = Building::done;
}

template <class S>
std::size_t Bvh<S>::longest_tail_of(std::size_t tree_size) const {
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(tree_size)));
  return least_tail_ + thresholds.tail_of_root * root;
}

template <class S>
std::size_t Bvh<S>::refresh_cost(std::size_t recent) const {
  // Pending inserts are counted only if they can be many.
  std::size_t pending = live_tail();
  if (marked_.size() + pending > longest_tail())
    for (const std::uint32_t slot : marked_) pending += place_[slot] == none;
  const bool rebuild = was_rebuilt_ || pending > longest_tail() || marked_.size() > recent + tree_size_ / Block::width;
  return rebuild ? place_.size() : 0;
}

/// A tree that has had no place for boxes that came gets some for those to come: a lane in eight.
template <class S>
void Bvh<S>::begin_build(bool with_room) {
  centres_.clear();
  centres_.reserve(place_.size());
  building_.step = Building::collecting;
  building_.at = 0;
  building_.slots = place_.size();
  building_.in_leaf = Block::width - with_room;
}

/// All centres together are ordered so that each run of 8^k of them, counted from the first, is a compact group for
/// every k. Halves of a range are cut at multiples of the largest such power that fits, so that blocks are full but for
/// the last. (Where blocks have room, 7 times 8^(k-1).) This cuts the next range, and returns how many centres it has.
template <class S>
std::uint64_t Bvh<S>::arrange_next() {
  constexpr S inf = std::numeric_limits<S>::infinity();
  const typename Building::Range range = building_.pending[--building_.top];
  if (range.count <= building_.in_leaf) return 1;
  Centre* const first = centres_.data() + range.first;
  std::size_t chunk = building_.in_leaf;
  while (chunk * Block::width < range.count) chunk *= Block::width;
  const std::size_t chunks = (range.count + chunk - 1) / chunk;
  const std::size_t middle = chunks / 2 * chunk;

  // A far half-space in the sample may decide for its axis, but only in the one part of each split that has it.
  S least[3] = {inf, inf, inf};
  S most[3] = {-inf, -inf, -inf};
  const std::size_t samples = std::min(most_samples, range.count);
  for (std::size_t i = 0; i < samples; ++i)
    for (int d = 0; d < 3; ++d) {
      const S at = first[i * range.count / samples].at[d];
      least[d] = at < least[d] ? at : least[d];
      most[d] = most[d] < at ? at : most[d];
    }
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (most[d] / 2 - least[d] / 2 > most[axis] / 2 - least[axis] / 2) axis = d;
  select(first, range.count, middle, axis);
  building_.pending[building_.top++] = {range.first, middle};
  building_.pending[building_.top++] = {range.first + middle, range.count - middle};
  return range.count;
}

/// Makes room for a tree of `tree_size` boxes and its longest tail, rounded up to a block: during a refit nothing may
/// throw between a node and its parent.
template <class S>
void Bvh<S>::reserve_places(std::size_t tree_size) {
  const std::size_t places = tree_size + longest_tail_of(tree_size) + Block::width;
  slot_at_.reserve(places);
  leaves_.reserve(places / Block::width + 1);
  tail_holes_.reserve(places - tree_size);
}

/// For that many boxes; their places come with `grow_to`, so that memory is touched when it is filled.
template <class S>
void Bvh<S>::lay_out(std::size_t boxes) {
  const auto blocks_for = [](std::size_t n) { return (n + Block::width - 1) / Block::width; };
  const std::size_t leaf_blocks = (boxes + building_.in_leaf - 1) / building_.in_leaf;
  std::size_t nodes = 0;
  for (std::size_t blocks = leaf_blocks; blocks > 1; nodes += blocks) blocks = blocks_for(blocks);
  reserve_places(leaf_blocks * Block::width);
  built_girth_.reserve(leaf_blocks);
  free_lanes_.reserve(leaf_blocks);
  nodes_.reserve(nodes);
  levels_.reserve(most_levels);
  // Nothing throws from here on.
  tree_size_ = leaf_blocks * Block::width;
  leaves_.clear();
  slot_at_.clear();
  nodes_.assign(nodes, Block());
  levels_.clear();
  tail_holes_.clear();
  levels_.push_back({0, leaf_blocks});
  std::size_t first = 0;
  for (std::size_t blocks = leaf_blocks; blocks > 1;) {
    blocks = blocks_for(blocks);
    levels_.push_back({first, blocks});
    first += blocks;
  }
}

template <class S>
void Bvh<S>::grow_to(std::size_t places) noexcept {
  const std::size_t blocks = (places + Block::width - 1) / Block::width;
  leaves_.resize(blocks);
  slot_at_.resize(blocks * Block::width, none);
}

/// All levels from the leaves up.
template <class S>
void Bvh<S>::build_nodes() {
  bound_leaves(0, leaves_.size());
  bound_nodes();
}

/// The girths and free lanes of leaf blocks, and the level above them.
template <class S>
void Bvh<S>::bound_leaves(std::size_t first, std::size_t last) {
  if (first == 0) {
    built_girth_.clear();
    free_lanes_.clear();
  }
  for (std::size_t b = first; b < last; ++b) {
    const Box bounds = leaves_[b].bounds();
    built_girth_.push_back(girth(bounds));
    const std::uint32_t* const slots = slot_at_.data() + b * Block::width;
    free_lanes_.push_back(static_cast<std::uint8_t>(std::count(slots, slots + Block::width, none)));
    if (levels_.size() > 1) block(1, b / Block::width).set(b % Block::width, bounds);
  }
}

/// The levels above.
template <class S>
void Bvh<S>::bound_nodes() {
  for (unsigned level = 2; level < levels_.size(); ++level)
    for (std::size_t i = 0; i < levels_[level - 1].blocks; ++i)
      block(level, i / Block::width).set(i % Block::width, block(level - 1, i).bounds());
}

template <class S>
void Bvh<S>::forget_changes() {
  std::vector<std::uint32_t>().swap(place_);
  drop_scratch();
  std::vector<S>().swap(built_girth_);
  std::vector<std::uint8_t>().swap(free_lanes_);
}

/// May throw; then nothing has changed.
template <class S>
void Bvh<S>::expect_dirt() {
  reserve_places(tree_size_);
  const std::size_t words = tree_blocks() / 64 + 1;
  dirty_.assign(words, 0);
  dirty_above_.assign(words, 0);
}

/// Refits level by level: each block with changed boxes is visited once.
/// False if the tree should be rebuilt.
template <class S>
bool Bvh<S>::refit() noexcept {
  // When this many have moved, pending inserts of boxes that left their neighbours would only fill the tail.
  const bool many = marked_.size() > tree_size_ / Block::width;
  std::size_t grown = 0;
  for (unsigned level = 0; level < levels_.size(); ++level) {
    if (level != 0 && level + 1 == levels_.size()) break;  // above the root there is nothing to bound
    const std::size_t words = levels_[level].blocks / 64 + 1;
    std::fill_n(dirty_above_.begin(), words / Block::width + 1, 0);
    for (std::size_t w = 0; w < words; ++w) {
      std::uint32_t dirty[64];
      Box bounds[64];
      std::size_t count = 0;
      for (std::uint64_t left = dirty_[w]; left != 0; left &= left - 1)
        dirty[count++] = static_cast<std::uint32_t>(64 * w + static_cast<unsigned>(std::countr_zero(left)));
      if (count == 0) continue;
      for (std::size_t i = 0; i < count; ++i) bounds[i] = block(level, dirty[i]).bounds();
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = dirty[i];
        if (level == 0 && girth(bounds[i]) / 2 > built_girth_[at]) {
          ++grown;
          if (!many) {
            move_to_tail(at);
            if (tail() > longest_tail()) return false;
            bounds[i] = leaves_[at].bounds();
          }
        }
        if (level + 1 == levels_.size()) continue;
        Block& parent = block(level + 1, at / Block::width);
        if (parent.holds(at % Block::width, bounds[i])) continue;
        parent.set(at % Block::width, bounds[i]);
        dirty_above_[at / Block::width / 64] |= std::uint64_t{1} << at / Block::width % 64;
      }
    }
    dirty_.swap(dirty_above_);
  }
  return !(many && grown > built_girth_.size() / 4);
}

/// Makes pending inserts of the boxes of a leaf block that have left their neighbours, which keeps the block small.
template <class S>
void Bvh<S>::move_to_tail(std::size_t leaf_block) noexcept {
  for (unsigned lane = 0; lane < Block::width; ++lane) {
    const std::size_t place = leaf_block * Block::width + lane;
    const std::uint32_t slot = slot_at_[place];
    if (slot == none || !is_marked_[slot]) continue;
    const Box box = leaves_[leaf_block].get(lane);
    leaves_[leaf_block].clear(lane);
    slot_at_[place] = none;
    ++free_lanes_[leaf_block];
    append(slot, box);
  }
}

/// A free place where a box keeps its block small, or none: down the tree to where it makes bounds grow least. So
/// boxes that come take the places of those that leave, and objects that are taken out to be moved, and put in again,
/// leave the tree as it is.
template <class S>
std::uint32_t Bvh<S>::find_home(const Box& box) const {
  if (tree_size_ == 0) return none;
  std::size_t at = 0;
  S grown[Block::width];
  for (unsigned level = levels() - 1; level > 1; --level) {
    block(level, at).find_growth(box, grown);
    const std::size_t first = at * Block::width,
                      count = std::min<std::size_t>(Block::width, levels_[level - 1].blocks - first);
    at = first + static_cast<std::size_t>(std::min_element(grown, grown + count) - grown);
  }
  std::size_t best = at;
  bool has_best = levels() == 1 && free_lanes_[0] != 0 && !is_far(0, box);
  if (levels() > 1) {
    block(1, at).find_growth(box, grown);
    const std::size_t first = at * Block::width, count = std::min<std::size_t>(Block::width, tree_blocks() - first);
    for (std::size_t i = 0; i < count; ++i) {
      if (free_lanes_[first + i] == 0 || (has_best && !(grown[i] < grown[best - first])) || is_far(first + i, box))
        continue;
      best = first + i;
      has_best = true;
    }
  }
  if (!has_best) return none;
  const auto first = slot_at_.begin() + static_cast<std::ptrdiff_t>(best * Block::width);
  return static_cast<std::uint32_t>(std::find(first, first + Block::width, none) - slot_at_.begin());
}

template <class S>
void Bvh<S>::put(std::uint32_t slot, const Box& box) noexcept {
  // What comes back is often what has gone.
  const bool was_left = last_left_ < tree_size_ && slot_at_[last_left_] == none;
  const std::uint32_t place = was_left && !is_far(last_left_ / Block::width, box) ? last_left_ : find_home(box);
  if (place == none) return append(slot, box);
  put_at(place, slot, box);
}

/// In the tree or behind it.
template <class S>
void Bvh<S>::put_at(std::size_t place, std::uint32_t slot, const Box& box) noexcept {
  const std::size_t leaf = place / Block::width;
  slot_at_[place] = slot;
  place_[slot] = static_cast<std::uint32_t>(place);
  leaves_[leaf].set(place % Block::width, box);
  if (place >= tree_size_) return;
  --free_lanes_[leaf];
  dirty_[leaf / 64] |= std::uint64_t{1} << leaf % 64;
}

template <class S>
void Bvh<S>::append(std::uint32_t slot, const Box& box) noexcept {
  if (!tail_holes_.empty()) {
    const std::uint32_t place = tail_holes_.back();
    tail_holes_.pop_back();
    return put_at(place, slot, box);
  }
  const std::size_t place = slot_at_.size();
  assert(place < slot_at_.capacity() && (place % Block::width != 0 || leaves_.size() < leaves_.capacity()));
  if (place % Block::width == 0) leaves_.push_back(Block());
  slot_at_.push_back(slot);
  put_at(place, slot, box);
}

/// Frees the place of a slot whose box is gone.
template <class S>
void Bvh<S>::leave(std::uint32_t slot) noexcept {
  const std::uint32_t place = std::exchange(place_[slot], none);
  const std::size_t leaf = place / Block::width;
  slot_at_[place] = none;
  leaves_[leaf].clear(place % Block::width);
  if (place >= tree_size_) {
    assert(tail_holes_.size() < tail_holes_.capacity());
    tail_holes_.push_back(place);
    if (live_tail() == 0) drop_tail();
    return;
  }
  dirty_[leaf / 64] |= std::uint64_t{1} << leaf % 64;
  ++free_lanes_[leaf];
  last_left_ = place;
}

/// So that walks have nothing to do with places that all boxes have left.
template <class S>
void Bvh<S>::drop_tail() noexcept {
  slot_at_.resize(tree_size_);
  leaves_.resize(tree_blocks());
  tail_holes_.clear();
}

template <class S>
void Bvh<S>::rename_slots(Span<const std::uint32_t> to) noexcept {
  assert(marked_.empty() && to.size() >= place_.size());
  std::size_t count = 0;
  for (std::uint32_t slot = 0; slot < place_.size(); ++slot) {
    assert(to[slot] != none || place_[slot] == none);
    if (to[slot] == none) continue;
    assert(to[slot] == count);
    ++count;
    place_[to[slot]] = place_[slot];
    if (place_[slot] != none) slot_at_[place_[slot]] = to[slot];
  }
  place_.resize(count);
  is_marked_.resize(count);
}

template <class S>
void Bvh<S>::find_overlaps(Span<const Box> boxes, BatchWalk<S>& walk, FunctionRef<void(Span<const Pair>)> sink) const {
  assert(std::all_of(boxes.begin(), boxes.end(), [](const Box& box) { return has_valid_keys(box); }));
  Pair named[BatchWalk<S>::list_size];
  const auto by_slot = [&](const Visits& found) {
    for (std::size_t i = 0; i < found.count; ++i) named[i] = {found.boxes[i], slot_at_[found.blocks[i]]};
    sink(Span<const Pair>(named, found.count));
  };
  walk.find_in_row(leaves_.data(), tree_blocks(), leaves_.size() - tree_blocks(), boxes, by_slot);
  if (tree_size_ == 0) return;
  const Block* firsts[most_levels];
  for (unsigned level = 0; level < levels_.size(); ++level) firsts[level] = &block(level, 0);
  walk.find(Span<const Block* const>(firsts, levels_.size()), boxes, by_slot);
}

template <class S>
typename Bvh<S>::Box Bvh<S>::bounds() const {
  Box all = levels() != 0 ? block(levels() - 1, 0).bounds() : Block().bounds();
  for (std::size_t b = tree_blocks(); b < leaves_.size(); ++b) all = merged(all, leaves_[b].bounds());
  return all;
}

template class Bvh<float>;
template class Bvh<double>;

}  // namespace boxstream::detail
