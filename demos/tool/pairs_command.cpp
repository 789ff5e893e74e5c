// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <iterator>
#include <string_view>

#include "boxes_file.hpp"
#include "commands.hpp"
#include "files/input_file.hpp"
#include "files/read_file.hpp"
#include "number_rows.hpp"
#include "print.hpp"
#include "shape_pairs.hpp"

namespace boxstream::tool {
namespace {

/// Blanks before anything else, up to a limit, so that blanks without end come to one.
std::string take_blanks(std::istream& in) {
  std::string blanks;
  while (blanks.size() < 65536 && std::string_view(" \t\r\n").find(static_cast<char>(in.peek())) != std::string::npos)
    blanks += static_cast<char>(in.get());
  return blanks;
}

}  // namespace

int pairs_command(const PairsOptions& options) {
  const std::string name = options.file == "-" ? "standard input" : options.file;
  files::InputFile file(options.file);
  const std::string blanks = take_blanks(file.stream());
  // No row of numbers begins with a brace.
  if (file.stream().peek() == '{') return shape_pairs(blanks + file.read_rest(files::most_of_text), name, options);
  const auto lines_before = static_cast<std::size_t>(std::count(blanks.begin(), blanks.end(), '\n'));
  const std::vector<Aabb64> boxes = read_boxes(file.stream(), name, lines_before + 1);
  std::uint64_t count = 0;
  std::string lines;
  Detector detector;
  // Streamed, because a file of modest size can have more pairs than there is memory for.
  detector.stream_pairs(Span<const Aabb64>(boxes.data(), boxes.size()), [&](Span<const Pair> pairs) {
    count += pairs.size();
    if (!options.list) return true;
    lines.clear();
    for (const Pair pair : pairs) fmt::format_to(std::back_inserter(lines), "{} {}\n", pair.a, pair.b);
    print(lines);
    return true;
  });
  if (!options.list) print(fmt::format("boxes {}, pairs {}\n", boxes.size(), count));
  return 0;
}

}  // namespace boxstream::tool
