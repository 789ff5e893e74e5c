// SPDX-License-Identifier: MIT
#include "boxstream/pairs/number_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {
namespace {

constexpr std::string_view separators = " \t,\r";
// Ends inputs that have no end.
constexpr std::size_t longest_line = 65536, most_lines = 50'000'000;

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

/// The next line without its end; false at the end of the file. Throws BadInput for one that is no line of numbers.
bool next_line(std::istream& in, const std::string& name, std::size_t number, std::string& line) {
  line.clear();
  std::streambuf& bytes = *in.rdbuf();
  for (int c = bytes.sbumpc(); c != std::char_traits<char>::eof(); c = bytes.sbumpc()) {
    if (c == '\n') return true;
    if (line.size() == longest_line)
      throw BadInput(fmt::format("{}:{}: more than {} characters in a line", name, number, longest_line));
    line += static_cast<char>(c);
  }
  return !line.empty();
}

/// Names of columns, or anything else that has no number in it.
bool is_header(std::string_view line, std::vector<std::string>& names) {
  for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
    double value = 0;
    const char* const word_end = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data(), word_end, value);
    if (error != std::errc::invalid_argument && end == word_end) return false;
    // "0;0;0" and "\"1\"" are no names, but numbers that are written otherwise.
    const std::string_view bare = word.substr(std::min(word.find_first_not_of("\"'"), word.size()));
    if (!bare.empty() && bare.find_first_of("0123456789+-.") == 0) return false;
    names.emplace_back(word);
  }
  return true;
}

/// Whether a column of this name has radii.
bool means_radius(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name == "r" || name.find("rad") != name.npos;
}

}  // namespace

void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take, std::size_t number,
                      std::vector<std::string>* names) {
  bool first = true;
  std::vector<double> row;
  std::vector<std::string> header;
  for (std::string line; next_line(in, name, number, line); ++number) {
    if (number > most_lines) throw BadInput(fmt::format("{}: more than {} lines", name, most_lines));
    std::string_view text = line;
    if (first && (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF"))
      throw BadInput(name + ": a text in UTF-16: save it as UTF-8");
    if (first && text.substr(0, 3) == "\xEF\xBB\xBF")
      text.remove_prefix(3);  // a mark that programs of Windows put there
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(separators) == std::string_view::npos) continue;
    if (std::exchange(first, false) && is_header(text, header)) {
      if (names != nullptr) *names = std::move(header);
      continue;
    }
    std::string reason = parse(text, most, row);
    if (reason.empty()) reason = take(row);
    if (!reason.empty()) throw BadInput(fmt::format("{}:{}: {}", name, number, reason));
  }
}

std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name, std::size_t first_line) {
  std::vector<Aabb64> boxes;
  read_number_rows(
      in, name, 6,
      [&](const std::vector<double>& row) -> std::string {
        if (row.size() < 6) return fmt::format("{} numbers, expected 6", row.size());
        Aabb64& box = boxes.emplace_back();
        for (std::size_t d = 0; d < 3; ++d) {
          if (row[d] > row[d + 3]) return fmt::format("min > max on the {} axis", "xyz"[d]);
          box.min[d] = row[d];
          box.max[d] = row[d + 3];
        }
        return {};
      },
      first_line);
  return boxes;
}

Balls read_balls(std::istream& in, const std::string& name, std::optional<int> dimensions) {
  Balls balls{{}, dimensions.value_or(0)};
  std::size_t columns = 0;
  std::vector<std::string> names;
  const auto take = [&](const std::vector<double>& row) -> std::string {
    if (columns == 0) {
      columns = row.size();
      if (!dimensions) balls.dimensions = columns == 2 ? 2 : 3;
      const auto least = static_cast<std::size_t>(balls.dimensions);
      if (columns < std::max<std::size_t>(2, least) || columns > least + 1)
        return fmt::format("{} numbers, expected {} or {}", columns, std::max<std::size_t>(2, least), least + 1);
      if (columns > least && names.size() == columns && !means_radius(names.back()))
        return fmt::format("the last column would be radii, and is called \"{}\": leave it out, or call it radius",
                           names.back());
    }
    if (row.size() != columns) return fmt::format("{} numbers, {} in the rows before", row.size(), columns);
    for (const double value : row)
      if (!std::isfinite(value)) return "an infinity is no place";
    const auto d = static_cast<std::size_t>(balls.dimensions);
    const double radius = columns > d ? row[d] : 0;
    if (radius < 0) return "a radius below 0";
    balls.all.push_back({{row[0], row[1], d == 3 ? row[2] : 0}, radius});
    return {};
  };
  read_number_rows(in, name, 4, take, 1, &names);
  if (balls.dimensions == 0) balls.dimensions = 3;
  return balls;
}

}  // namespace boxstream::tool
