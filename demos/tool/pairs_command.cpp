// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <boxstream/detector.hpp>
#include <iterator>
#include <sstream>

#include "boxes_file.hpp"
#include "commands.hpp"
#include "number_rows.hpp"
#include "shape_pairs.hpp"

namespace boxstream::tool {
namespace {

/// No row of numbers begins with a brace.
bool is_json(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

}  // namespace

int pairs_command(const PairsOptions& options) {
  const std::string name = options.file == "-" ? "standard input" : options.file;
  const std::string text = read_whole(options.file);
  if (is_json(text)) return shape_pairs(text, name, options);
  std::istringstream rows(text);
  const std::vector<Aabb64> boxes = read_boxes(rows, name);
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
