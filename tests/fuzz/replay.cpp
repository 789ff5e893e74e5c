// SPDX-License-Identifier: MIT
// The corpus of one fuzz target as a test: every entry once, with any compiler. Files are read with C's functions,
// which the memory sanitizer knows.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "finding.hpp"

namespace {

namespace fs = std::filesystem;

std::optional<std::vector<std::uint8_t>> read(const char* path) {
  std::vector<std::uint8_t> bytes;
  std::FILE* const file = std::fopen(path, "rb");
  if (file == nullptr) return std::nullopt;
  std::uint8_t block[4096];
  for (std::size_t size = 0; (size = std::fread(block, 1, sizeof block, file)) > 0;)
    bytes.insert(bytes.end(), block, block + size);
  const bool good = std::ferror(file) == 0;
  std::fclose(file);
  if (!good) return std::nullopt;
  return bytes;
}

bool passes(const char* path) {
  // Said before, because a crash would say nothing.
  std::puts(path);
  std::fflush(stdout);
  const auto bytes = read(path);
  if (!bytes) {
    std::fputs("cannot be read\n", stderr);
    return false;
  }
  try {
    LLVMFuzzerTestOneInput(bytes->data(), bytes->size());
    return true;
  } catch (const boxstream::fuzz::Finding&) {
  } catch (const std::exception& error) {
    std::fprintf(stderr, "exception: %s\n", error.what());
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  for (const char* const place : std::vector<const char*>(argv + 1, argv + argc)) {
    if (read(place)) {
      files.emplace_back(place);
      continue;
    }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file()) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  const auto failed =
      std::count_if(files.begin(), files.end(), [](const std::string& path) { return !passes(path.c_str()); });
  std::printf("%zu inputs, %td failed\n", files.size(), failed);
  // A corpus that is not found must not pass for one without faults.
  return files.empty() || failed != 0 ? 1 : 0;
}
