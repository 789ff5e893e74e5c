// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <iterator>
#include <string_view>

#include "base/read_file.hpp"
#include "boxstream/pairs/number_rows.hpp"
#include "boxstream/pairs/shape_pairs.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

struct PairsOptions {
  std::string file;  // "-": standard input
  bool list = false;
  std::string method = "planned";
  int cutoff = 0;
  NarrowOptions narrow;  // for shapes
};

/// Blanks before anything else, up to a limit, so that blanks without end come to one.
std::string take_blanks(std::istream& in) {
  std::string blanks;
  while (blanks.size() < 65536 && std::string_view(" \t\r\n").find(static_cast<char>(in.peek())) != std::string::npos)
    blanks += static_cast<char>(in.get());
  return blanks;
}

/// The byte-order mark of UTF-8, with which no text has to begin.
void take_mark(std::istream& in, const std::string& name) {
  if (in.peek() != 0xEF) return;
  char mark[3];
  in.read(mark, sizeof(mark));
  if (std::string_view(mark, static_cast<std::size_t>(in.gcount())) != "\xEF\xBB\xBF")
    throw files::BadFile(name, "line 1: no row of numbers");
}

int run_pairs(const PairsOptions& options) {
  const std::string name = options.file == "-" ? "standard input" : options.file;
  files::InputFile file(options.file);
  take_mark(file.stream(), name);
  const std::string blanks = take_blanks(file.stream());
  // No row of numbers begins with a brace.
  if (file.stream().peek() == '{')
    return shape_pairs(blanks + file.read_rest(files::most_of_text), name, options.list, options.narrow);
  const auto lines_before = static_cast<std::size_t>(std::count(blanks.begin(), blanks.end(), '\n'));
  const std::vector<Aabb64> boxes = read_boxes(file.stream(), name, lines_before + 1);
  std::uint64_t count = 0;
  std::string lines;
  DetectorOptions asked;
  asked.method = options.method == "hybrid" ? Method::hybrid : Method::planned;
  asked.cutoff = static_cast<std::uint32_t>(options.cutoff);
  Detector detector(asked);
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

Action set_up_pairs(CommandLine& command) {
  const auto options = std::make_shared<PairsOptions>();
  add_input(command, "FILE", options->file, "Rows of boxes, or JSON of shapes; - is standard input")->required();
  command.add_flag("--list", options->list, "Print the pairs");
  CLI::Option* const method = take_words(
      command, add_name(command, "--method", options->method, "Boxes: how pairs are found, {}; default: planned"),
      "method", {"planned", "hybrid"});
  add_number(command, "--cutoff", options->cutoff,
             "Boxes: the hybrid method scans nodes of fewer intervals or points; default: where samples say so", 1,
             2'000'000'000)
      ->needs(method);
  add_number(command, "--tolerance", options->narrow.tolerance,
             "Shapes: largest error of depths and distances, as a fraction of the smaller shape; default: 1e-6", 1e-15,
             0.1, "T");
  add_number(command, "--iterations", options->narrow.iterations, "Shapes: most iterations of one solver; default: 500",
             1, 1'000'000);
  take_words(command,
             add_name(command, "--solver", options->narrow.solver,
                      "Shapes: libccd's gjk (with EPA) or mpr alone; default: auto, all of them"),
             "solver", {"auto", "gjk", "mpr"});
  return [options] { return run_pairs(*options); };
}

}  // namespace

extern const Command pairs_command{"pairs", "Find the pairs in a file of boxes or convex shapes",
                                   R"(Examples:
  boxstream pairs boxes.txt
  boxstream pairs --list - < boxes.txt

One box a line: minx miny minz maxx maxy maxz, separated by blanks or commas; '#' starts a comment, and a first line
without a number is a title, or names the columns, three minima, then three maxima. Boxes are closed: touching counts. --list prints
the pairs in place of their number, one a line, as numbers of boxes counted from 0. --method hybrid finds the same ones
by the streamed segment tree of Zomorodian and Edelsbrunner alone.

JSON in place of rows gives convex shapes, as scenes do:
  {"format": 1,
   "shapes": [{"name": "ball", "type": "sphere", "radius": 1}, {"name": "slab", "type": "box", "half_extents": [4, 1, 4]}],
   "bodies": [{"shape": "slab"}, {"shape": "ball", "position": [0, 1.9, 0], "rotation": {"axis": [0, 0, 1], "degrees": 30}}]}
Shapes: box, sphere, capsule, cylinder, cone, hull. Pairs of boxes around them go to the narrow phase on libccd. --list
prints one line for each of these pairs, with names where bodies have them, else numbers:
  A B touch depth D direction X Y Z by METHOD    B leaves A when it moves by D along the direction
  A B apart distance D
and, in brackets, inexact or iteration limit where no solver could prove its answer: a depth is then an upper bound.)",
                                   set_up_pairs};

}  // namespace boxstream::tool
