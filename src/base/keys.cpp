// SPDX-License-Identifier: MIT
#include "base/keys.hpp"

#include "base/even_parts.hpp"

namespace boxstream::detail {

namespace {

constexpr int window_bits = 30;
constexpr std::size_t most_samples = 64;
// A side of this many keys is distinguished from its neighbours well enough.
constexpr std::int64_t long_enough = 256;

// Where a window begins that has nothing in it: with leading bits.
constexpr std::int64_t nothing = INT64_MAX;

/// Ends of sampled boxes, per axis, as order keys, low and high in turn.
struct Ends {
  std::int64_t keys[3][2 * most_samples];
  std::size_t count = 0;  // on each axis

  Span<const std::int64_t> of_axis(int axis) const { return {keys[axis], count}; }
};

void draw(Ends& ends, Span<const BasicAabb<double>> boxes) {
  const std::size_t samples = std::min(std::clamp(boxes.size() / 32, most_samples / 4, most_samples), boxes.size());
  for (std::size_t i = 0; i < samples; ++i) {
    const BasicAabb<double>& box = boxes[begin_of_part(boxes.size(), i, samples)];
    if (!has_valid_keys(box)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      ends.keys[axis][ends.count] = order_key(box.min[axis]);
      ends.keys[axis][ends.count + 1] = order_key(box.max[axis]);
    }
    ends.count += 2;
  }
}

/// A few boxes far out, such as planes, must not widen the window for all: bounds beyond it share its end keys.
void extend(std::int64_t& lowest, std::int64_t& highest, Span<const std::int64_t> ends) {
  if (ends.empty()) return;
  std::int64_t keys[2 * most_samples];
  std::int64_t* const end = std::copy(ends.begin(), ends.end(), keys);
  const std::size_t outliers = ends.size() / 16;
  std::nth_element(keys, keys + outliers, end);
  lowest = std::min(lowest, keys[outliers]);
  std::nth_element(keys, end - 1 - outliers, end);
  highest = std::max(highest, *(end - 1 - outliers));
}

}  // namespace

void KeyMap<double>::fit(Span<const BasicAabb<double>> a, Span<const BasicAabb<double>> b) {
  Ends ends[2];
  draw(ends[0], a);
  draw(ends[1], b);
  for (int axis = 0; axis < 3; ++axis) {
    std::int64_t lowest_key = INT64_MAX, highest_key = INT64_MIN;
    for (const Ends& e : ends) extend(lowest_key, highest_key, e.of_axis(axis));
    if (lowest_key > highest_key) continue;
    set_window(lowest_key, highest_key, axis);
    for (const Ends& e : ends)
      if (loses_extents(e.of_axis(axis), axis)) leading_[axis] = -1;
    if (leading_[axis] != 0) first_[axis] = nothing;
  }
  for (std::size_t i = 3; i < lanes; ++i) {
    most_[i] = most_[i % 4 % 3];
    top_[i] = top_[i % 4 % 3];
    first_[i] = first_[i % 4 % 3];
    last_[i] = last_[i % 4 % 3];
    shift_[i] = shift_[i % 4 % 3];
    leading_[i] = leading_[i % 4 % 3];
  }
}

void KeyMap<double>::set_leading_bits() {
  std::fill_n(most_, lanes, infinity_key<double>);
  std::fill_n(top_, lanes, infinity_key<double> >> 52);
  std::fill_n(first_, lanes, nothing);
  std::fill_n(last_, lanes, std::int64_t{0});
  std::fill_n(shift_, lanes, std::uint64_t{0});
  std::fill_n(leading_, lanes, -1);
}

void KeyMap<double>::set_window(std::int64_t lowest_key, std::int64_t highest_key, int axis) {
  const auto exponent = [](std::int64_t key) { return std::max((key ^ (key >> 63)) >> 52, std::int64_t{1}); };
  // One binade more, for what the sample did not see. Infinities become the largest number.
  constexpr std::int64_t largest_exponent = 2046;
  top_[axis] = std::min(std::max(exponent(lowest_key), exponent(highest_key)) + 1, largest_exponent);
  most_[axis] = ((top_[axis] + 1) << 52) - 1;
  const std::int64_t lower = fixed_point(lowest_key, axis), upper = fixed_point(highest_key, axis);
  // For the same reason half as much again on both sides, or a few millions, whichever is more.
  const std::int64_t spare = (upper - lower) / 2 + (std::int64_t{1} << 22);
  constexpr std::int64_t end = (hidden_bit << (headroom + 1)) - (std::int64_t{1} << headroom) - 1;  // below the largest
  first_[axis] = lower < spare - end ? -end : lower - spare;
  last_[axis] = upper > end - spare ? end : upper + spare;
  const auto size = static_cast<std::uint64_t>(last_[axis]) - static_cast<std::uint64_t>(first_[axis]);
  shift_[axis] = static_cast<std::uint64_t>(std::max(0, static_cast<int>(std::bit_width(size)) - window_bits));
  // So that multiples of what a key stands for lose no bits.
  const std::int64_t unit = std::int64_t{1} << shift_[axis];
  first_[axis] = (first_[axis] + unit - 1) & -unit;
  leading_[axis] = 0;
}

/// Whether more than a sixteenth of the boxes would become flat in the window where leading bits keep their extent, as
/// those of a dense cluster inside a far larger one.
bool KeyMap<double>::loses_extents(Span<const std::int64_t> ends, int axis) const {
  std::size_t flat = 0;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    const std::int64_t side = std::int64_t{window_key(ends[i + 1], axis)} - window_key(ends[i], axis);
    flat += side < long_enough && side < (ends[i + 1] >> 32) - (ends[i] >> 32) ? 1 : 0;
  }
  return flat * 32 > ends.size();
}

}  // namespace boxstream::detail
