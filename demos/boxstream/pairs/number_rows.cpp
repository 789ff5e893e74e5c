// SPDX-License-Identifier: MIT
#include "boxstream/pairs/number_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {
namespace {

constexpr std::string_view separators = " \t,\r";
// Ends inputs that have no end.
constexpr std::size_t longest_line = 65536, most_lines = 50'000'000;

/// The first `size` characters of `line`, or all that it has, which are cut off.
std::string_view cut(std::string_view& line, std::size_t size) {
  const std::string_view part = line.substr(0, size);
  line.remove_prefix(part.size());
  return part;
}

/// Empty, or why `line` is no row of numbers.
std::string parse(std::string_view line, std::size_t most, std::vector<double>& row) {
  row.clear();
  for (;;) {
    const std::string_view gap = cut(line, line.find_first_not_of(separators));
    // One comma may end a row.
    if (std::count(gap.begin(), gap.end(), ',') > 1) return "an empty field between two commas";
    if (line.empty()) return {};
    const std::string_view word = cut(line, line.find_first_of(separators));
    // from_chars knows no sign but a minus.
    const bool has_plus = word[0] == '+' && word.substr(1, 1) != "-";
    if (row.size() == most) return fmt::format("more than {} numbers", most);
    double& value = row.emplace_back();
    const auto [end, error] = std::from_chars(word.data() + has_plus, word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return fmt::format("\"{}\" is out of range", word);
    if (error != std::errc{} || end != word.data() + word.size()) return fmt::format("\"{}\" is not a number", word);
    if (std::isnan(value)) return "NaN is not a coordinate";
  }
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

struct Name {
  std::string_view text;
  bool quoted;
};

/// Takes the next name off a header that begins with one, without the quotes around it.
Name next_name(std::string_view& line, std::string_view ends) {
  if (line[0] == '"' || line[0] == '\'') {
    const char quote = cut(line, 1)[0];
    const std::string_view name = cut(line, line.find(quote));
    cut(line, 1);
    return {name, true};
  }
  const std::string_view name = cut(line, line.find_first_of(ends));
  return {name.substr(0, name.find_last_not_of(separators) + 1), false};
}

/// The first line of a table, if it has no numbers.
struct Header {
  std::vector<std::string> names;
  bool is_title = false;  // perhaps: words, and not names of columns
};

/// Nothing for a row of numbers.
std::optional<Header> header_in(std::string_view line) {
  Header header;
  cut(line, line.find_first_not_of(separators));
  for (const std::string_view comment : {"%", "//"})
    if (line.starts_with(comment)) cut(line, comment.size());
  // Between commas or tabs, names may have blanks in them.
  const auto has = [line](char c) { return line.find(c) != line.npos; };
  const std::string_view ends = has(',') ? "," : has('\t') ? "\t" : separators;
  const bool at_blanks = ends == separators;
  for (cut(line, line.find_first_not_of(separators)); !line.empty(); cut(line, line.find_first_not_of(separators))) {
    const auto [name, quoted] = next_name(line, ends);
    double value = 0;
    const char* const name_end = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data(), name_end, value);
    const bool ends_there = end == name_end || separators.find(*end) != separators.npos;
    if (error != std::errc::invalid_argument && ends_there) return std::nullopt;
    // "0;0;0" is no name, but numbers that are written otherwise.
    if (!name.empty() && name.find_first_of("0123456789+-.") == 0) return std::nullopt;
    // "x (m) y (m)" are two names with units.
    if (at_blanks && name.find_first_of("([") == 0 && name.find_last_of(")]") == name.size() - 1) continue;
    constexpr std::size_t longest_coordinate = 2;
    if (at_blanks && !quoted && name.size() > longest_coordinate) header.is_title = true;
    header.names.emplace_back(name);
  }
  return header;
}

std::string lower_case(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Whether a column of this name has radii.
bool means_radius(const std::string& name) {
  const std::string lower = lower_case(name);
  return lower == "r" || lower.find("rad") != lower.npos;
}

/// Whether a column of this name has numbers of rows or times, as tables often have in front.
bool is_no_coordinate(const std::string& name) {
  constexpr std::string_view others[] = {"", "id", "index", "frame", "t", "time"};
  return std::find(std::begin(others), std::end(others), lower_case(name)) != std::end(others);
}

/// Why columns of these names are not `dimensions` coordinates and perhaps a radius; empty if they are.
std::string why_no_balls(const std::vector<std::string>& names, std::size_t dimensions) {
  for (std::size_t d = 0; d < dimensions; ++d)
    if (is_no_coordinate(names[d]))
      return fmt::format("column {} would be {}, and is called \"{}\": leave it out", d + 1, "xyz"[d], names[d]);
  if (names.size() > dimensions && !means_radius(names.back()))
    return fmt::format("the last column would be radii, and is called \"{}\": leave it out, or call it radius",
                       names.back());
  return {};
}

/// Why columns of these names are no boxes; empty if they are, or have names that say nothing of that.
std::string why_no_boxes(const std::vector<std::string>& names) {
  const auto has = [](const std::string& name, const char* part) { return name.find(part) != name.npos; };
  std::string ends;  // '<' for a minimum, '>' for a maximum
  for (const std::string& name : names) {
    const std::string lower = lower_case(name);
    // "lo" and "hi" stand in other words, too, as in longitude_max.
    if (has(lower, "min"))
      ends += '<';
    else if (has(lower, "max"))
      ends += '>';
    else if (has(lower, "lo"))
      ends += '<';
    else if (has(lower, "hi"))
      ends += '>';
  }
  if (ends.size() != 6 || ends == "<<<>>>") return {};
  return fmt::format("the columns are called {}: three minima come first, then three maxima", fmt::join(names, ", "));
}

}  // namespace

void read_number_rows(std::istream& in, const std::string& name, std::size_t most,
                      const std::function<std::string(const std::vector<double>&)>& take, std::size_t number,
                      std::vector<std::string>* names) {
  bool first = true;
  std::vector<double> row;
  std::optional<Header> header;
  for (std::string line; next_line(in, name, number, line); ++number) {
    if (number > most_lines) throw BadInput(fmt::format("{}: more than {} lines", name, most_lines));
    std::string_view text = line;
    if (first && (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF"))
      throw BadInput(name + ": a text in UTF-16: save it as UTF-8");
    if (first && text.substr(0, 3) == "\xEF\xBB\xBF")
      text.remove_prefix(3);  // a mark that programs of Windows put there
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(separators) == std::string_view::npos) continue;
    if (std::exchange(first, false) && (header = header_in(text))) {
      if (names != nullptr) *names = header->names;
      continue;
    }
    std::string reason = parse(text, most, row);
    const std::size_t named = header && !header->is_title ? header->names.size() : 0;
    // One name is a title. A name more or less is that of a column that would be taken for another.
    if (reason.empty() && named > 1 && named != row.size())
      reason = fmt::format("the first line names {} columns, the row has {} numbers", named, row.size());
    if (reason.empty()) reason = take(row);
    if (!reason.empty()) throw BadInput(fmt::format("{}:{}: {}", name, number, reason));
  }
}

std::vector<Aabb64> read_boxes(std::istream& in, const std::string& name, std::size_t first_line) {
  std::vector<Aabb64> boxes;
  std::vector<std::string> names;
  const auto take = [&](const std::vector<double>& row) -> std::string {
    if (row.size() < 6) return fmt::format("{} numbers, expected 6", row.size());
    if (boxes.empty())
      if (std::string reason = why_no_boxes(names); !reason.empty()) return reason;
    Aabb64& box = boxes.emplace_back();
    for (std::size_t d = 0; d < 3; ++d) {
      if (row[d] > row[d + 3]) return fmt::format("min > max on the {} axis", "xyz"[d]);
      box.min[d] = row[d];
      box.max[d] = row[d + 3];
    }
    return {};
  };
  read_number_rows(in, name, 6, take, first_line, &names);
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
      if (names.size() == columns)
        if (std::string reason = why_no_balls(names, least); !reason.empty()) return reason;
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
