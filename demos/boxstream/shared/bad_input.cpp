// SPDX-License-Identifier: MIT
#include "boxstream/shared/bad_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "formats/scene_model/broadphase_names.hpp"

namespace boxstream::tool {
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
  // One slip in three characters is a slip, more is another word.
  std::size_t fewest = std::max<std::size_t>(1, given.size() / 3) + 1;
  const std::string* nearest = nullptr;
  for (const std::string& name : names) {
    const std::size_t count = slips(given, name);
    // What was cut short is meant, too.
    const bool begun = given.size() >= 3 && name.starts_with(given);
    if (count >= fewest && !(begun && nearest == nullptr)) continue;
    fewest = std::min(fewest, count);
    nearest = &name;
  }
  return nearest == nullptr ? "" : "; did you mean " + *nearest + "?";
}

void check_known(const char* what, const std::string& name, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw BadInput(
      fmt::format("unknown {} \"{}\"{}; one of: {}", what, name, did_you_mean(name, known), fmt::join(known, ", ")));
}

void check_broadphase(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> known = more;
  known.insert(known.end(), scenes::broadphase_names().begin(), scenes::broadphase_names().end());
  check_known("broad-phase", name, known);
}

}  // namespace boxstream::tool
