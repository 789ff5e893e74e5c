// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/check.hpp"
#include "bvh/bvh.hpp"

namespace boxstream::detail {

template <class S>
template <class BoxOf>
void Bvh<S>::refresh(BoxOf&& box_of) {
  if (marked_.empty()) return;
  const DefaultFloatEnvironment environment;
  std::size_t pending = 0;
  for (const std::uint32_t slot : marked_) pending += place_[slot] == none;
  const bool is_first = tree_size_ == 0;
  const bool is_poor = live_tail() + pending > longest_tail() || !take_in_marked(box_of);
  if (is_poor) rebuild(box_of);
  was_rebuilt_ = is_poor && !is_first;
  for (const std::uint32_t slot : marked_) is_marked_[slot] = false;
  marked_.clear();
}

/// False if the tree has become too poor to be kept.
template <class S>
template <class BoxOf>
bool Bvh<S>::take_in_marked(BoxOf&& box_of) {
  expect_dirt();
  // Where many move there is no use in finding them other places.
  const bool few = marked_.size() <= tree_size_ / Block::width;
  for (const std::uint32_t slot : marked_) {
    const std::uint32_t place = place_[slot];
    const Box box = box_of(slot);
    if (!is_valid(box)) {
      if (place != none) leave(slot);
      continue;
    }
    if (place == none) {
      put(slot, box);
      continue;
    }
    const std::size_t leaf = place / Block::width;
    if (few && place < tree_size_ && is_far(leaf, box)) {
      if (const std::uint32_t home = find_home(box); home != none) {
        leave(slot);
        put_at(home, slot, box);
        continue;
      }
    }
    leaves_[leaf].set(place % Block::width, box);
    if (place < tree_size_) dirty_[leaf / 64] |= std::uint64_t{1} << leaf % 64;
  }
  return refit();
}

/// What is done at once whatever the work: the first cuts, and the upper levels of the tree, a 64th of it.
template <class S>
template <class BoxOf>
bool Bvh<S>::build_part(std::uint64_t work, BoxOf&& box_of) {
  const DefaultFloatEnvironment environment;
  constexpr std::uint64_t most = ~std::uint64_t{0};
  Building& now = building_;
  const auto end_of = [&](std::size_t end, std::uint64_t price) {
    const std::uint64_t count = work / price;
    return count < end - now.at ? now.at + static_cast<std::size_t>(count) : end;
  };
  const auto spend = [&](std::uint64_t spent) { work = work == most ? most : work - std::min(work, spent); };
  while (now.step != Building::done && work > 0) {
    const std::size_t from = now.at;
    switch (now.step) {
      case Building::collecting:
        now.at = end_of(now.slots, 1);
        collect(from, now.at, box_of);
        spend(now.at - from);
        if (now.at < now.slots) break;
        now.pending[0] = {0, centres_.size()};
        now.top = 1;
        now.step = Building::arranging;
        break;
      case Building::arranging:
        if (now.top > 0) spend(arrange_next());
        if (now.top > 0) break;
        lay_out(centres_.size());
        std::fill(place_.begin(), place_.end(), none);
        spend(centres_.size() / 4);
        now.at = 0;
        now.step = Building::filling;
        break;
      case Building::filling:
        now.at = end_of(centres_.size(), 4);
        fill(from, now.at, box_of);
        spend(4 * (now.at - from) + 4);
        if (now.at < centres_.size()) break;
        now.at = 0;
        now.step = Building::bounding;
        break;
      case Building::bounding:
        now.at = end_of(leaves_.size(), 8);
        bound_leaves(from, now.at);
        spend(8 * (now.at - from) + 8);
        if (now.at < leaves_.size()) break;
        bound_nodes();
        now.step = Building::done;
        break;
      case Building::done:
        break;
    }
  }
  return now.step == Building::done;
}

template <class S>
template <class BoxOf>
void Bvh<S>::rebuild(BoxOf&& box_of) {
  begin_build(tree_size_ != 0 && lacks_room());
  build_part(~std::uint64_t{0}, box_of);
}

template <class S>
template <class BoxOf>
void Bvh<S>::collect(std::size_t first, std::size_t last, BoxOf&& box_of) {
  for (std::size_t slot = first; slot < last; ++slot) {
    const Box box = box_of(static_cast<std::uint32_t>(slot));
    if (!is_valid(box)) continue;
    Centre c{};
    c.slot = static_cast<std::uint32_t>(slot);
    // A place to sort by, made from the bounds cut to finite numbers and halved first: it cannot overflow, and how well
    // it suits a half-space matters only for speed.
    constexpr S most = std::numeric_limits<S>::max();
    for (int d = 0; d < 3; ++d) c.at[d] = std::max(box.min[d], -most) / 2 + std::min(box.max[d], most) / 2;
    centres_.push_back(c);
  }
}

/// Boxes as they are by now: those that have changed since they were collected are marked.
template <class S>
template <class BoxOf>
void Bvh<S>::fill(std::size_t first, std::size_t last, BoxOf&& box_of) {
  const std::size_t in_leaf = building_.in_leaf;
  grow_to((last + in_leaf - 1) / in_leaf * Block::width);
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t slot = centres_[i].slot;
    const std::size_t leaf = i / in_leaf;
    const auto lane = static_cast<unsigned>(i % in_leaf);
    slot_at_[leaf * Block::width + lane] = slot;
    place_[slot] = static_cast<std::uint32_t>(leaf * Block::width + lane);
    leaves_[leaf].set(lane, box_of(slot));
  }
}

template <class S>
template <class BoxOf>
void Bvh<S>::build(std::size_t slots, BoxOf&& box_of) {
  const DefaultFloatEnvironment environment;
  place_.assign(slots, none);
  rebuild(box_of);
  forget_changes();
}

template <class S>
template <class SlotOf, class BoxOf>
void Bvh<S>::build_in_order(std::size_t boxes, SlotOf&& slot_of, BoxOf&& box_of) {
  const DefaultFloatEnvironment environment;
  building_.in_leaf = Block::width;
  lay_out(boxes);
  grow_to(boxes);
  for (std::size_t i = 0; i < boxes; ++i) {
    slot_at_[i] = slot_of(i);
    leaves_[i / Block::width].set(i % Block::width, box_of(i));
  }
  build_nodes();
  forget_changes();
}

template <class S>
template <class BoxOf>
void Bvh<S>::validate(BoxOf&& box_of) const {
  const DefaultFloatEnvironment environment;
  check(marked_.empty(), "index: not fresh");
  for (std::uint32_t slot = 0; slot < place_.size(); ++slot) {
    const Box box = box_of(slot);
    const std::uint32_t place = place_[slot];
    if (place == none) {
      check(!is_valid(box), "index: a valid box is missing");
      continue;
    }
    check(place < slot_at_.size() && slot_at_[place] == slot, "index: places and slots disagree");
    const Box stored = leaves_[place / Block::width].get(place % Block::width);
    check(is_valid(box) ? stored == box : !is_valid(stored), "index: a box is out of date");
  }
  for (std::size_t place = 0; place < slot_at_.size(); ++place) {
    if (slot_at_[place] == none)
      check(!is_valid(leaves_[place / Block::width].get(place % Block::width)), "index: a box without a slot");
    else
      check(place_[slot_at_[place]] == place, "index: slots and places disagree");
  }
  check(leaves_.size() * Block::width >= slot_at_.size(), "index: fewer boxes than places");
  for (std::size_t leaf = 0; leaf < tree_blocks(); ++leaf) {
    std::size_t free = 0;
    for (std::size_t i = 0; i < Block::width; ++i) free += slot_at_[leaf * Block::width + i] == none;
    check(free_lanes_[leaf] == free, "index: wrong count of free places");
  }
  for (unsigned level = 1; level < levels_.size(); ++level)
    for (std::size_t i = 0; i < levels_[level - 1].blocks; ++i) {
      const Box children = block(level - 1, i).bounds();
      const Box stored = block(level, i / Block::width).get(i % Block::width);
      check(is_valid(children) ? stored == children : !is_valid(stored), "index: a node does not fit its children");
    }
}

}  // namespace boxstream::detail
