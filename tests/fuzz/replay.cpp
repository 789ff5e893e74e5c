// SPDX-License-Identifier: MIT
// The corpus of one fuzz target as a test: every entry once, with any compiler.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "finding.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::vector<std::string>& places) {
  std::vector<fs::path> files;
  for (const std::string& place : places) {
    if (!fs::is_directory(place)) {
      files.emplace_back(place);
      continue;
    }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool passes(const fs::path& path) {
  // Said before, because a crash would say nothing.
  std::cout << path.string() << std::endl;
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) {
    std::cerr << "cannot be read\n";
    return false;
  }
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    return true;
  } catch (const boxstream::fuzz::Finding&) {
  } catch (const std::exception& error) {
    std::cerr << "exception: " << error.what() << '\n';
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<fs::path> files = files_of({argv + 1, argv + argc});
  const auto failed = std::count_if(files.begin(), files.end(), [](const fs::path& path) { return !passes(path); });
  std::cout << files.size() << " inputs, " << failed << " failed\n";
  // A corpus that is not found must not pass for one without faults.
  return files.empty() || failed != 0 ? 1 : 0;
}
