// SPDX-License-Identifier: MIT
#pragma once

#include <dirent.h>
#include <unistd.h>

#include <climits>
#include <cstdlib>
#include <string>
#include <vector>

namespace boxstream::out_of_core_test {

/// Descriptors of this process whose files are, or were, in the folder; with an empty one, all. Takes no memory of C++
/// but for the answer.
inline std::vector<int> open_files(const std::string& folder = {}) {
  std::vector<int> files;
  DIR* const all = opendir("/proc/self/fd");
  while (const dirent* entry = readdir(all)) {
    char target[PATH_MAX] = {};
    if (readlinkat(dirfd(all), entry->d_name, target, sizeof target - 1) < 0) continue;
    const int descriptor = std::atoi(entry->d_name);
    if (descriptor != dirfd(all) && std::string(target).rfind(folder, 0) == 0) files.push_back(descriptor);
  }
  closedir(all);
  return files;
}

}  // namespace boxstream::out_of_core_test
