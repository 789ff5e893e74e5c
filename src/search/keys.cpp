// SPDX-License-Identifier: MIT
#include "search/keys.hpp"

namespace boxstream::detail {

namespace {

// Within so many binades order keys grow evenly enough: buckets at one end are at most 2^3 times as wide as at the
// other.
constexpr std::int64_t widest_window = std::int64_t{3} << 52;
// More than 2^31 keys would leave none for the padding of the sweep.
constexpr int window_bits = 31;
constexpr std::size_t most_samples = 64;

}  // namespace

void KeyMap<double>::fit(Span<const BasicAabb<double>> boxes) {
  const std::size_t samples = std::min(most_samples, boxes.size());
  for (int d = 0; d < 3; ++d) {
    std::int64_t keys[2 * most_samples];
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples; ++i) {
      const BasicAabb<double>& box = boxes[boxes.size() * i / samples];
      if (!has_valid_keys(box)) continue;
      keys[count++] = order_key(box.min[d]);
      keys[count++] = order_key(box.max[d]);
    }
    if (count == 0) continue;
    // A few boxes far out, planes for instance, must not widen the window for all: what lies beyond shares its end
    // keys.
    const std::size_t outliers = count / 16;
    std::nth_element(keys, keys + outliers, keys + count);
    const std::int64_t lower = keys[outliers];
    std::nth_element(keys, keys + (count - 1 - outliers), keys + count);
    const std::int64_t upper = keys[count - 1 - outliers];

    Axis& axis = axes_[d];
    axis.lowest = std::min(axis.lowest, lower);
    axis.highest = std::max(axis.highest, upper);
    axis.shift = -1;
    // The difference of two keys may not fit, that of their halves does.
    if (axis.highest / 2 - axis.lowest / 2 > widest_window / 2) continue;
    // The sample does not see every box: half as much again on both sides, or a few millions, whichever is more.
    const std::int64_t spare = (axis.highest - axis.lowest) / 2 + (std::int64_t{1} << 22);
    axis.first = std::max(axis.lowest, ~infinity_key<double> + spare) - spare;
    axis.last = std::min(axis.highest, infinity_key<double> - spare) + spare;
    const auto size = static_cast<std::uint64_t>(axis.last - axis.first);
    axis.shift = std::max(0, static_cast<int>(std::bit_width(size)) - window_bits);
  }
}

}  // namespace boxstream::detail
