// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace boxstream::imports {

/// Words and numbers of a text, which it does not own, one after the other.
class TextScan {
 public:
  explicit TextScan(std::string_view text) : rest_(text) {}

  /// Without the mark that some programs of Windows put before a text.
  static std::string_view without_mark(std::string_view text) {
    return text.substr(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);
  }

  /// The rest of the present line, without its end; goes to the next line. A line may end with CR, LF or both.
  std::string_view line() {
    const std::size_t size = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, size);
    std::size_t end = line.size();
    if (rest_.substr(end, 2) == "\r\n") ++end;
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++lines_;
    return line;
  }

  bool at_end() const { return rest_.empty(); }
  /// How many lines have been read.
  std::size_t lines() const { return lines_; }

  /// The next word; empty at the end.
  std::string_view word() {
    const std::size_t begin = std::min(rest_.find_first_not_of(" \t\r\n\f\v"), rest_.size());
    rest_.remove_prefix(begin);
    const std::size_t size = std::min(rest_.find_first_of(" \t\r\n\f\v"), rest_.size());
    const std::string_view word = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return word;
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::size_t lines_ = 0;
};

/// A word as a number; nothing if it is none. The double nearest to what is written; beyond all doubles an infinity.
inline std::optional<double> number_in(std::string_view word) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool is_small = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return is_small ? 0.0 : word[0] == '-' ? -HUGE_VAL : HUGE_VAL;
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

inline std::optional<std::int64_t> integer_in(std::string_view word) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// A word for messages: short and printable, whatever the file has there.
inline std::string quoted(std::string_view word) {
  constexpr std::size_t most = 24;
  std::string text(word.substr(0, most));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c == 0x7f; }, '?');
  return "'" + text + (word.size() > most ? "...'" : "'");
}

/// The next three words as coordinates.
inline std::array<double, 3> coordinates_in(TextScan& scan) {
  std::array<double, 3> place{};
  for (double& x : place) {
    const std::string_view word = scan.word();
    const std::optional<double> number = number_in(word);
    if (!number)
      throw std::runtime_error(word.empty() ? "cut off, or a vertex with fewer than three coordinates"
                                            : "no number where a coordinate should be: " + quoted(word));
    x = *number;
  }
  return place;
}

}  // namespace boxstream::imports
