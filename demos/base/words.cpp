// SPDX-License-Identifier: MIT
#include "base/words.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace boxstream::files {
namespace {

unsigned byte(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

/// Bytes of the character at the beginning of `text`, which is not empty; 0 if they are no UTF-8. `code` is set.
std::size_t length_of(std::string_view text, std::uint32_t& code) {
  const unsigned first = byte(text, 0);
  code = first;
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 && first < 0xf5   ? 4
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xc2 && first < 0xe0 ? 2
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(text, i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(text, i) & 0x3f);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code >= least[length] && code < 0x110000 && !surrogate ? length : 0;
}

/// Moves the cursor, breaks the line or turns the direction of writing.
bool steers(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0x200e || code == 0x200f || code == 0x61c;
}

std::string cleaned(std::string_view text, bool keep_line_breaks) {
  static const char digits[] = "0123456789abcdef";
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t length = length_of(text, code);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    if (length > 0 && (!steers(code) || (keep_line_breaks && code == '\n')))
      result += character;
    else
      for (std::size_t i = 0; i < character.size(); ++i)
        (result += "\\x") += {digits[byte(character, i) >> 4], digits[byte(character, i) & 15]};
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return cleaned(text, false);
}

std::string printable_lines(std::string_view text) {
  return cleaned(text, true);
}

}  // namespace boxstream::files

namespace boxstream {
namespace {

/// Characters that are missing, in excess, wrong, or in the wrong order beside each other.
std::size_t slips(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> table(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        table[i][j] = i + j;
        continue;
      }
      const std::size_t wrong = table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      table[i][j] = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1, wrong});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
    }
  return table[a.size()][b.size()];
}

}  // namespace

std::string did_you_mean(const std::string& given, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 64;
  if (given.size() > longest) return {};
  // One slip in three characters is a slip, more is another word: "!=" is not a mistyped "<=".
  std::size_t fewest = given.size() / 3 + 1;
  const std::string* nearest = nullptr;
  for (const std::string& name : names) {
    const std::size_t count = slips(given, name);
    // What was cut short is meant, too.
    const bool begun = given.size() >= 3 && name.starts_with(given);
    if (count >= fewest && !(begun && nearest == nullptr)) continue;
    fewest = std::min(fewest, count);
    nearest = &name;
  }
  return nearest == nullptr ? "" : "; did you mean '" + *nearest + "'?";
}

std::string unknown_word(const std::string& noun, const std::string& given, const std::vector<std::string>& names) {
  const std::string unknown = "unknown " + noun + " '" + given + "'", nearest = did_you_mean(given, names);
  if (!nearest.empty()) return unknown + nearest;
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "; there are " : ", ") + name;
  return unknown + all;
}

}  // namespace boxstream
