// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <boxstream/detector.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

#include "bad_input.hpp"
#include "boxes_file.hpp"
#include "commands.hpp"

namespace boxstream::tool {
namespace {

std::vector<Aabb64> load(const std::string& path) {
  if (path == "-") return read_boxes(std::cin, "standard input");
  std::ifstream file(path);
  if (!file) throw BadInput(fmt::format("{}: {}", path, std::strerror(errno)));
  return read_boxes(file, path);
}

}  // namespace

int pairs_command(const PairsOptions& options) {
  const std::vector<Aabb64> boxes = load(options.file);
  std::uint64_t count = 0;
  std::string lines;
  Detector detector;
  // Streamed, because a file of modest size can have more pairs than there is memory for.
  detector.stream_pairs(Span<const Aabb64>(boxes.data(), boxes.size()), [&](Span<const Pair> pairs) {
    count += pairs.size();
    if (!options.list) return true;
    lines.clear();
    for (const Pair pair : pairs) fmt::format_to(std::back_inserter(lines), "{} {}\n", pair.a, pair.b);
    return std::fwrite(lines.data(), 1, lines.size(), stdout) == lines.size();
  });
  if (!options.list) fmt::print("boxes {}, pairs {}\n", boxes.size(), count);
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw std::runtime_error("standard output: cannot be written");
  return 0;
}

}  // namespace boxstream::tool
