// SPDX-License-Identifier: MIT
#include "bvh/bvh_batch.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

#ifndef BOXSTREAM_SRC_BVH_BATCH_ONCE
#define BOXSTREAM_SRC_BVH_BATCH_ONCE

namespace boxstream::detail {

/// The numbers of the bits that are set in each byte, lowest first. Looking them up is what compressing a vector by
/// a mask comes down to, at the same cost on every processor.
struct SetBits {
  alignas(8) std::uint8_t of[256][8] = {};

  constexpr SetBits() {
    for (unsigned byte = 0; byte < 256; ++byte)
      for (unsigned bit = 0, count = 0; bit < 8; ++bit)
        if ((byte >> bit & 1) != 0) of[byte][count++] = static_cast<std::uint8_t>(bit);
  }
};
constexpr SetBits set_bits;

}  // namespace boxstream::detail

#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/bvh_batch.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "bvh/overlapping-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

template <class S>
HWY_ATTR void visit(const Visits& visits, const BoxBlock<S>* HWY_RESTRICT blocks,
                    const BasicAabb<S>* HWY_RESTRICT boxes, Visits& found) {
  constexpr std::size_t width = BoxBlock<S>::width;
  const hn::CappedTag<std::uint32_t, width> d32;
  const hn::Rebind<std::uint8_t, decltype(d32)> d8;
  const std::size_t lanes = hn::Lanes(d32);
  std::uint32_t* HWY_RESTRICT const out_boxes = found.boxes;
  std::uint32_t* HWY_RESTRICT const out_blocks = found.blocks;
  std::size_t size = 0;
  for (std::size_t v = 0; v < visits.count; ++v) {
    const std::uint32_t at_box = visits.boxes[v];
    const std::uint32_t at_block = visits.blocks[v];
    const unsigned touched = overlapping(blocks[at_block], boxes[at_box]);
    const auto first = hn::Set(d32, static_cast<std::uint32_t>(at_block * width));
    for (std::size_t i = 0; i < width; i += lanes) {
      const auto lanes_set = hn::PromoteTo(d32, hn::Load(d8, set_bits.of[touched] + i));
      hn::StoreU(hn::Add(first, lanes_set), d32, out_blocks + size + i);
      hn::StoreU(hn::Set(d32, at_box), d32, out_boxes + size + i);
    }
    size += static_cast<std::size_t>(std::popcount(touched));
  }
  found.count = size;
}

HWY_ATTR void Visit32(const Visits& visits, const BoxBlock<float>* blocks, const Aabb* boxes, Visits& found) {
  visit(visits, blocks, boxes, found);
}

HWY_ATTR void Visit64(const Visits& visits, const BoxBlock<double>* blocks, const Aabb64* boxes, Visits& found) {
  visit(visits, blocks, boxes, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Visit32);
HWY_EXPORT(Visit64);

void visit_blocks(const Visits& visits, const BoxBlock<float>* blocks, const Aabb* boxes, Visits& found) {
  HWY_DYNAMIC_DISPATCH(Visit32)(visits, blocks, boxes, found);
  assert(found.count <= visits.count * BoxBlock<float>::width);
}

void visit_blocks(const Visits& visits, const BoxBlock<double>* blocks, const Aabb64* boxes, Visits& found) {
  HWY_DYNAMIC_DISPATCH(Visit64)(visits, blocks, boxes, found);
  assert(found.count <= visits.count * BoxBlock<double>::width);
}

template <class S>
void BatchWalk<S>::find(Span<const BoxBlock<S>* const> levels, Span<const BasicAabb<S>> boxes, Sink sink) {
  if (lists_.size() < 2 * levels.size() * list_size) lists_.resize(2 * levels.size() * list_size);
  std::uint32_t numbers[portion];
  std::uint32_t roots[portion];
  std::fill_n(roots, std::min(portion, boxes.size()), 0);
  for (std::size_t first = 0; first < boxes.size(); first += portion) {
    const std::size_t count = std::min(portion, boxes.size() - first);
    std::iota(numbers, numbers + count, static_cast<std::uint32_t>(first));
    descend(levels, levels.size() - 1, boxes, {numbers, roots, count}, sink);
  }
}

template <class S>
void BatchWalk<S>::descend(Span<const BoxBlock<S>* const> levels, std::size_t level, Span<const BasicAabb<S>> boxes,
                           const Visits& visits, Sink sink) {
  Visits found = list(level);
  for (std::size_t first = 0; first < visits.count; first += portion) {
    const std::size_t count = std::min(portion, visits.count - first);
    visit_blocks({visits.boxes + first, visits.blocks + first, count}, levels[level], boxes.data(), found);
    if (found.count == 0) continue;
    if (level == 0)
      sink(found);
    else
      descend(levels, level - 1, boxes, found, sink);
  }
}

template <class S>
void BatchWalk<S>::find_in_row(const BoxBlock<S>* blocks, std::size_t first, std::size_t count,
                               Span<const BasicAabb<S>> boxes, Sink sink) {
  if (lists_.size() < 2 * list_size) lists_.resize(2 * list_size);
  Visits found = list(0);
  std::uint32_t numbers[portion];
  std::uint32_t places[portion];
  Visits visits{numbers, places, 0};
  const auto flush = [&] {
    if (visits.count == 0) return;
    visit_blocks(visits, blocks, boxes.data(), found);
    if (found.count != 0) sink(found);
    visits.count = 0;
  };
  for (std::uint32_t box = 0; box < boxes.size(); ++box)
    for (std::size_t i = first; i < first + count; ++i) {
      numbers[visits.count] = box;
      places[visits.count] = static_cast<std::uint32_t>(i);
      if (++visits.count == portion) flush();
    }
  flush();
}

template class BatchWalk<float>;
template class BatchWalk<double>;

}  // namespace boxstream::detail
#endif
