// SPDX-License-Identifier: MIT
#include "pictures/viewer/series.hpp"

#include <cstdlib>

namespace boxstream::view {
namespace {

constexpr std::int32_t longest_step = 126;
constexpr std::uint8_t leap_mark = 255;
constexpr std::uint32_t no_number = 1U << 28;

std::int32_t nearest_quantum(std::int32_t value) {
  return (value + Series::fine / 2) >> 4;
}

}  // namespace

void append_number(std::string& out, std::uint32_t value) {
  for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
  out += static_cast<char>(value);
}

std::uint32_t sign_last(std::int32_t value) {
  return static_cast<std::uint32_t>(value) << 1 ^ static_cast<std::uint32_t>(value >> 31);
}

void Series::code(const std::vector<std::int32_t>& values, std::string& out) {
  leaps_.clear();
  if (at_.empty()) {
    at_.assign(values.size(), not_a_number);
    speed_.assign(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) leap(i, values[i]);
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) out += static_cast<char>(step(i, values[i]));
  }
  out += leaps_;
}

std::uint8_t Series::step(std::size_t i, std::int32_t value) {
  if (value == not_a_number && at_[i] == not_a_number) return 0;
  const bool goes = goes_on_ && std::abs(speed_[i]) >= fine;
  const std::int64_t predicted = std::int64_t{at_[i]} + (goes ? speed_[i] : 0);
  const std::int64_t left = (value - predicted + fine / 2) >> 4;
  if (std::abs(left) > longest_step) {
    leap(i, value);
    return leap_mark;
  }
  const auto quanta = static_cast<std::int32_t>(left);
  at_[i] = static_cast<std::int32_t>(predicted + left * fine);
  speed_[i] += quanta * fine / 2;
  if (quanta == 0 && !goes) speed_[i] /= 2;
  return static_cast<std::uint8_t>(sign_last(quanta));
}

void Series::leap(std::size_t i, std::int32_t value) {
  const std::int32_t former = at_[i];
  const bool is_number = value != not_a_number;
  const std::int32_t quanta = is_number ? nearest_quantum(value) : 0;
  append_number(leaps_, is_number ? sign_last(quanta) : no_number);
  at_[i] = is_number ? quanta * fine : not_a_number;
  speed_[i] = is_number && former != not_a_number ? at_[i] - former : 0;
}

}  // namespace boxstream::view
