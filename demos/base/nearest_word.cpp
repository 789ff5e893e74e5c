// SPDX-License-Identifier: MIT
#include "base/nearest_word.hpp"

#include <algorithm>
#include <cstddef>

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
