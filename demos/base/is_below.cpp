// SPDX-License-Identifier: MIT
#include "base/is_below.hpp"

#include <algorithm>
#include <filesystem>

namespace boxstream::files {

bool is_below(const std::string& folder, const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path top = fs::canonical(folder, error);
  if (error) return false;
  const fs::path place = fs::weakly_canonical(fs::absolute(name), error);
  if (error) return false;
  return std::mismatch(top.begin(), top.end(), place.begin(), place.end()).first == top.end();
}

}  // namespace boxstream::files
