// SPDX-License-Identifier: MIT
#include "number_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
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

/// Empty, or why `line` is no row of numbers.
std::string parse(std::string_view line, std::size_t most, std::vector<double>& row) {
  row.clear();
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    if (row.size() == most) return fmt::format("more than {} numbers", most);
    double& value = row.emplace_back();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return fmt::format("\"{}\" is out of range", word);
    if (error != std::errc{} || end != word.data() + word.size()) return fmt::format("\"{}\" is not a number", word);
    if (std::isnan(value)) return "NaN is not a coordinate";
  }
  return {};
}

}  // namespace

void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take) {
  std::size_t number = 0;
  std::vector<double> row;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::string_view text = line;
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(separators) == std::string_view::npos) continue;
    std::string reason = parse(text, most, row);
    if (reason.empty()) reason = take(row);
    if (!reason.empty()) throw BadInput(fmt::format("{}:{}: {}", name, number, reason));
  }
  if (in.bad()) throw BadInput(fmt::format("{}: cannot be read", name));
}

std::string read_whole(const std::string& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  std::ifstream file(path);
  if (!file) throw BadInput(fmt::format("{}: {}", path, std::strerror(errno)));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  // A directory can be opened, but not read.
  if (file.bad()) throw BadInput(fmt::format("{}: cannot be read", path));
  return text;
}

}  // namespace boxstream::tool
