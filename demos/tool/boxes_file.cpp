// SPDX-License-Identifier: MIT
#include "boxes_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "bad_input.hpp"

namespace boxstream::tool {
namespace {

constexpr std::string_view separators = " \t,\r";

/// The next word of `line`, which is cut off; empty at the end.
std::string_view next_word(std::string_view& line) {
  const std::size_t first = std::min(line.find_first_not_of(separators), line.size());
  line.remove_prefix(first);
  const std::string_view word = line.substr(0, line.find_first_of(separators));
  line.remove_prefix(word.size());
  return word;
}

/// Empty, or why `line` is no box.
std::string parse_box(std::string_view line, Aabb64& box) {
  double values[6];
  for (int i = 0; i < 6; ++i) {
    const std::string_view word = next_word(line);
    if (word.empty()) return fmt::format("{} numbers, expected 6", i);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), values[i]);
    if (error == std::errc::result_out_of_range) return fmt::format("\"{}\" is out of range", word);
    if (error != std::errc{} || end != word.data() + word.size()) return fmt::format("\"{}\" is not a number", word);
    if (std::isnan(values[i])) return "NaN is not a coordinate";
  }
  if (!next_word(line).empty()) return "more than 6 numbers";
  for (int d = 0; d < 3; ++d) {
    if (values[d] > values[d + 3]) return fmt::format("min > max on the {} axis", "xyz"[d]);
    box.min[d] = values[d];
    box.max[d] = values[d + 3];
  }
  return {};
}

}  // namespace

std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name) {
  std::vector<Aabb64> boxes;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::string_view text = line;
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(separators) == std::string_view::npos) continue;
    Aabb64 box{};
    const std::string reason = parse_box(text, box);
    if (!reason.empty()) throw BadInput(fmt::format("{}:{}: {}", name, number, reason));
    boxes.push_back(box);
  }
  if (in.bad()) throw BadInput(fmt::format("{}: cannot be read", name));
  return boxes;
}

}  // namespace boxstream::tool
