// SPDX-License-Identifier: MIT
#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "world/core.hpp"
#include "world/fat_boxes/fat_boxes_simd.hpp"

namespace boxstream::detail {

/// Where what is near is found without an index being made. Without memory there are none.
template <class S>
void WorldParts<S>::fit_rooms() noexcept {
  const DefaultFloatEnvironment environment;
  const std::size_t ranks = proxies_.ranks();
  const bool scans = ranks <= thresholds.scanned_for_one || !index_.is_ready(0);
  if (scans && ranks > thresholds.scanned_for_rooms) return;
  try {
    const auto visit_near = [&](const Box& box, auto visit) {
      if (!scans)
        return index_.fresh(proxies_).for_each_overlap(box, [&](std::uint32_t slot) {
          visit(proxies_.rank_of_slot(slot));
          return true;
        });
      std::uint32_t touching[thresholds.portion];
      for (std::size_t first = 0; first < ranks; first += thresholds.portion) {
        const std::size_t size = std::min(thresholds.portion, ranks - first);
        const std::size_t count = find_overlapping(proxies_.boxes().data() + first, size, box, touching);
        for (std::size_t i = 0; i < count; ++i) visit(static_cast<std::uint32_t>(first) + touching[i]);
      }
    };
    if (!rooms_.fit(proxies_, pairs_, visit_near)) search_.choice().rooms_lasted(0);
  } catch (...) {
    rooms_.forget();
  }
}

template void WorldParts<float>::fit_rooms() noexcept;
template void WorldParts<double>::fit_rooms() noexcept;

}  // namespace boxstream::detail
