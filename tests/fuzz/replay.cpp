// SPDX-License-Identifier: MIT
// The corpus of one fuzz target as a test: every entry once, with any compiler. Takes archives (.tar), folders and
// files, which are read with C's functions, for these the memory sanitizer knows.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "finding.hpp"

namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::uint8_t>;

struct Entry {
  std::string name;
  Bytes bytes;
};

std::optional<Bytes> read(const std::string& path) {
  Bytes bytes;
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return std::nullopt;
  std::uint8_t block[4096];
  for (std::size_t size = 0; (size = std::fread(block, 1, sizeof block, file)) > 0;)
    bytes.insert(bytes.end(), block, block + size);
  const bool good = std::ferror(file) == 0;
  std::fclose(file);
  if (!good) return std::nullopt;
  return bytes;
}

/// The files of an archive in the format ustar: of each a block with its name and size, then what it holds, in whole
/// blocks; a block of zeros ends it.
std::vector<Entry> unpack(const Bytes& archive) {
  constexpr std::size_t block = 512, size_at = 124, size_digits = 12, type_at = 156;
  std::vector<Entry> entries;
  for (std::size_t at = 0; at + block <= archive.size() && archive[at] != 0;) {
    const char* const header = reinterpret_cast<const char*>(archive.data()) + at;
    const std::size_t size = std::strtoul(std::string(header + size_at, size_digits).c_str(), nullptr, 8);
    at += block;
    if (size > archive.size() - at) throw std::runtime_error("an archive that is cut off");
    const auto first = archive.begin() + static_cast<std::ptrdiff_t>(at);
    if (header[type_at] == '0') entries.push_back({header, Bytes(first, first + static_cast<std::ptrdiff_t>(size))});
    at += (size + block - 1) / block * block;
  }
  return entries;
}

void add_entries(const std::string& place, std::vector<Entry>& entries) {
  std::optional<Bytes> bytes = read(place);
  if (bytes && fs::path(place).extension() == ".tar") {
    for (Entry& entry : unpack(*bytes)) entries.push_back(std::move(entry));
  } else if (bytes) {
    entries.push_back({place, std::move(*bytes)});
  } else {
    for (const fs::directory_entry& entry : fs::directory_iterator(place)) add_entries(entry.path().string(), entries);
  }
}

bool passes(const Entry& entry) {
  // Said before, because a crash would say nothing.
  std::puts(entry.name.c_str());
  std::fflush(stdout);
  try {
    LLVMFuzzerTestOneInput(entry.bytes.data(), entry.bytes.size());
    return true;
  } catch (const boxstream::fuzz::Finding&) {
  } catch (const std::exception& error) {
    std::fprintf(stderr, "exception: %s\n", error.what());
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Entry> entries;
  for (int i = 1; i < argc; ++i) add_entries(argv[i], entries);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
  const auto failed = std::count_if(entries.begin(), entries.end(), [](const Entry& each) { return !passes(each); });
  std::printf("%zu inputs, %td failed\n", entries.size(), failed);
  // A corpus that is not found must not pass for one without faults.
  return entries.empty() || failed != 0 ? 1 : 0;
}
