// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "batch/records/columns.hpp"
#include "out_of_core/numbered_boxes.hpp"
#include "out_of_core/regions.hpp"

namespace boxstream::detail {

/// How the memory is used. At one time it has the boxes that are searched and what the search takes; at another,
/// besides those boxes, a block of each region that is written; and once the sample with what Regions makes of it.
struct Budget {
  static constexpr std::uint64_t least = 64 << 10;
  static constexpr std::uint64_t least_shared = 64 << 20;

  /// From `least_shared` on there may be threads, with which a search holds back pairs. The order of pairs must not
  /// depend on whether there are.
  template <class S>
  static Budget of(std::uint64_t memory) {
    if (memory < least) throw std::invalid_argument("boxstream: searches out of core need 64 KiB of memory");
    const std::uint64_t quarter = memory / 4, block = std::clamp(quarter / most_regions, least_block, most_block);
    return {boxes_in<S>(memory - memory / 8 - (memory < least_shared ? 0 : held_back)), static_cast<std::size_t>(block),
            static_cast<std::size_t>(std::min(quarter / block, most_regions)),
            static_cast<std::size_t>(std::min(quarter / copies_of_sample / sizeof(KeyBox<S>), most_sampled)),
            static_cast<std::size_t>(std::min(memory / 16 / sizeof(WidePair), most_pairs))};
  }

  std::size_t boxes;    // in memory at once
  std::size_t block;    // bytes
  std::size_t regions;  // written at once
  std::size_t sample;   // boxes
  std::size_t pairs;    // passed on at once

 private:
  static constexpr std::uint64_t least_block = 4 << 10, most_block = 1 << 20, most_regions = 256;
  static constexpr std::uint64_t most_sampled = 1 << 16, most_pairs = 1024;
  static constexpr std::uint64_t copies_of_sample = 4;  // what Regions makes of it is in the parts of its leaves
  // Of a new Detector: 200 bytes a box for most sets; 300 for long bars, which it copies to many cells. It has none for
  // sets up to thresholds.most_small.
  static constexpr std::uint64_t scratch = 64 << 10, scratch_of_box = 320;
  // Of a Detector's tasks, 8 bytes a box included.
  static constexpr std::uint64_t held_back = 18 << 20;

  template <class S>
  static std::size_t boxes_in(std::uint64_t memory) {
    constexpr std::uint64_t of_box = sizeof(NumberedBox<S>) + 1 + scratch_of_box;
    const std::uint64_t boxes = memory < scratch ? 0 : (memory - scratch) / of_box;
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(boxes, thresholds.most_small, UINT32_MAX - 1));
  }
};

}  // namespace boxstream::detail
