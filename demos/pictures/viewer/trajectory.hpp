// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace boxstream::view {

/// A value through time, as the keyframes that it takes to give back every sample exactly by interpolation: those in
/// the middle of a time in which nothing changes are left out. A value that never changes has none.
template <std::size_t components>
class Trajectory {
 public:
  using Value = std::array<float, components>;

  /// Frames come in order.
  void add(std::uint32_t frame, const Value& value) {
    if (!has_value_ || value == last_) {
      if (!has_value_) last_ = value;
      has_value_ = true;
      last_is_key_ = false;
    } else {
      if (!last_is_key_) push(last_frame_);
      last_ = value;
      push(frame);
      last_is_key_ = true;
    }
    last_frame_ = frame;
  }

  const std::vector<std::uint32_t>& frames() const { return frames_; }
  /// `components` floats for each of `frames()`.
  const std::vector<float>& values() const { return values_; }

 private:
  void push(std::uint32_t frame) {
    frames_.push_back(frame);
    values_.insert(values_.end(), last_.begin(), last_.end());
  }

  std::vector<std::uint32_t> frames_;
  std::vector<float> values_;
  Value last_{};
  std::uint32_t last_frame_ = 0;
  bool has_value_ = false;
  bool last_is_key_ = false;
};

}  // namespace boxstream::view
