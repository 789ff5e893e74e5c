// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "bvh.hpp"
#include "world_reserve.hpp"

namespace boxstream::detail {

namespace {

// Samples per choice of an axis: enough to tell which one spreads most, cheap beside the partition that follows.
constexpr std::size_t axis_samples = 32;

}  // namespace

template <class S>
void Bvh<S>::reserve_slot(std::uint32_t slot) {
  if (slot < place_.size()) return;
  const std::size_t size = std::size_t{slot} + 1;
  if (size > place_.capacity()) {
    const std::size_t capacity = std::max<std::size_t>(16, 2 * size);
    place_.reserve(capacity);
    is_marked_.reserve(capacity);
    marked_.reserve(capacity);
  }
  place_.resize(size, none);
  is_marked_.resize(size, false);
}

template <class S>
void Bvh<S>::clear() noexcept {
  leaves_.clear();
  slot_at_.clear();
  place_.clear();
  tree_size_ = 0;
  nodes_.clear();
  levels_.clear();
  built_girth_.clear();
  marked_.clear();
  is_marked_.clear();
}

template <class S>
std::size_t Bvh<S>::longest_tail() const {
  // Every query scans the tail and every newcomer pays its share of the next rebuild: n log n over the tail's length.
  // The sum is least for a tail that grows with the square root of n.
  return 64 + 4 * static_cast<std::size_t>(std::sqrt(static_cast<double>(tree_size_)));
}

template <class S>
std::size_t Bvh<S>::refresh_cost() const {
  return marked_.size();
}

/// Orders `centres` so that each run of 8^k of them, counted from the first, is a compact group for every k.
/// Halves of a range are cut at multiples of the largest such power that fits, so that blocks are full but for the last.
template <class S>
void Bvh<S>::arrange(Centre* centres, std::size_t count) {
  struct Range {
    Centre* first;
    std::size_t count;
  };
  // Depth first with the smaller part done later: at most one pending range per halving.
  Range pending[64];
  unsigned top = 0;
  pending[top++] = {centres, count};
  while (top > 0) {
    const Range range = pending[--top];
    if (range.count <= Block::width) continue;
    std::size_t chunk = Block::width;
    while (chunk * Block::width < range.count) chunk *= Block::width;
    const std::size_t chunks = (range.count + chunk - 1) / chunk;
    const std::size_t middle = chunks / 2 * chunk;

    int axis = 0;
    S widest = -1;
    const std::size_t samples = std::min(axis_samples, range.count);
    for (int d = 0; d < 3; ++d) {
      S sample[axis_samples];
      for (std::size_t i = 0; i < samples; ++i) sample[i] = range.first[i * range.count / samples].at[d];
      // Between the eighths rather than the ends, so that one far half-space does not decide.
      const std::size_t low = samples / 8;
      const std::size_t high = samples - 1 - low;
      std::nth_element(sample, sample + low, sample + samples);
      const S from = sample[low];
      std::nth_element(sample + low, sample + high, sample + samples);
      const S spread = sample[high] / 2 - from / 2;
      if (spread > widest) {
        widest = spread;
        axis = d;
      }
    }
    std::nth_element(range.first, range.first + middle, range.first + range.count, [axis](const Centre& a, const Centre& b) {
      return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.slot < b.slot;
    });
    pending[top++] = {range.first, middle};
    pending[top++] = {range.first + middle, range.count - middle};
  }
}

template <class S>
void Bvh<S>::lay_out(std::size_t boxes) {
  const auto blocks_for = [](std::size_t n) { return (n + Block::width - 1) / Block::width; };
  const std::size_t leaf_blocks = blocks_for(boxes);
  std::size_t nodes = 0;
  for (std::size_t blocks = leaf_blocks; blocks > 1; nodes += blocks) blocks = blocks_for(blocks);
  leaves_.reserve(leaf_blocks);
  slot_at_.reserve(leaf_blocks * Block::width);
  built_girth_.reserve(leaf_blocks);
  nodes_.reserve(nodes);
  levels_.reserve(most_levels);
  // Nothing throws from here on.
  tree_size_ = leaf_blocks * Block::width;
  leaves_.assign(leaf_blocks, Block());
  slot_at_.assign(tree_size_, none);
  nodes_.assign(nodes, Block());
  levels_.clear();
  levels_.push_back({0, leaf_blocks});
  std::size_t first = 0;
  for (std::size_t blocks = leaf_blocks; blocks > 1;) {
    blocks = blocks_for(blocks);
    levels_.push_back({first, blocks});
    first += blocks;
  }
}

template <class S>
void Bvh<S>::refit() {
  for (unsigned level = 1; level < levels_.size(); ++level)
    for (std::size_t i = 0; i < levels_[level - 1].blocks; ++i)
      block(level, i / Block::width).set(i % Block::width, block(level - 1, i).bounds());
}

template <class S>
bool Bvh<S>::has_grown(std::size_t leaf_block) const {
  return girth(leaves_[leaf_block].bounds()) > 2 * built_girth_[leaf_block];
}

template <class S>
bool Bvh<S>::has_decayed() const {
  std::size_t grown = 0;
  for (std::size_t b = 0; b < built_girth_.size(); ++b) grown += has_grown(b);
  return grown > built_girth_.size() / 4;
}

template <class S>
void Bvh<S>::refit_path(std::size_t leaf_block) {
  std::size_t i = leaf_block;
  Box box = leaves_[leaf_block].bounds();
  for (unsigned level = 1; level < levels_.size(); ++level) {
    Block& parent = block(level, i / Block::width);
    const Box before = parent.get(i % Block::width);
    if (before == box) break;
    parent.set(i % Block::width, box);
    i /= Block::width;
    box = parent.bounds();
  }
}

template <class S>
void Bvh<S>::append(std::uint32_t slot, const Box& box) {
  reserve_one_more(slot_at_);
  const std::size_t place = slot_at_.size();
  if (place % Block::width == 0) leaves_.push_back(Block());
  slot_at_.push_back(slot);
  place_[slot] = static_cast<std::uint32_t>(place);
  leaves_[place / Block::width].set(place % Block::width, box);
}

template <class S>
typename Bvh<S>::Box Bvh<S>::bounds() const {
  Block all;
  if (!levels_.empty() && levels_.back().blocks != 0) all.set(0, block(static_cast<unsigned>(levels_.size() - 1), 0).bounds());
  for (std::size_t b = tree_blocks(); b < leaves_.size(); ++b) {
    const Box both[2] = {all.get(0), leaves_[b].bounds()};
    all.set(1, both[1]);
    all.set(0, all.bounds());
    all.clear(1);
  }
  return all.bounds();
}

template class Bvh<float>;
template class Bvh<double>;

}  // namespace boxstream::detail
