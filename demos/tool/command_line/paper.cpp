// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* hybrid_help = R"(Examples:
  boxstream paper hybrid --quick
  boxstream paper hybrid --figure 6,8,table1 --csv results --svg results

Measures what A. Zomorodian and H. Edelsbrunner, "Fast software for box intersections" (2002), show in figures and
tables, with their procedures as this project wrote them from the paper, and beside each what the engine takes for the
same boxes. Figures: 6 procedures; 7, 8 cutoffs; 9 trees; table1 skewed boxes; 10 a sphere; 13, 14 sorting; 18 Versions
One and Two; 20, 21 cubes; table3 memory. Two more: level, the height of the medians that all others start from, and
batches, boxes that the paper did not try.

Times are processor time of one thread, the median of --repeats, from the caller's boxes to the last pair. All
contestants must find the same pairs, or the run fails. Sizes are the paper's; all figures take some minutes.)";

constexpr const char* structures_help = R"(Examples:
  boxstream paper structures --quick
  boxstream paper structures --work boxes,rays --csv results --svg results

Measures the structures of G. Zachmann and E. Langetepe, "Geometric data structures for computer graphics" (2002), that
find touching boxes, as this project wrote them, side by side with the engine on boxes of several distributions, and says
which was fastest at what. Work: build; points in a box; boxes that touch a box; first box on one of many rays; updates,
of one box at a time; the longest insertion; pairs of two sets; frames, of boxes that move a little. Then bounding volume
hierarchies for themselves: the tightness of each kind of volume, volumes of each kind under each builder, and what a
slice of the recursion tree saves that is kept from frame to frame.

Times are processor time of one thread, medians of --repeats turns. All structures must give the same answers as the
engine, or the run fails. It takes some minutes.)";

constexpr const char* thick_help = R"(Examples:
  boxstream paper thick --quick
  boxstream paper thick --figure sort,radii --csv results --svg results

Measures what "Reporting intersections among thick objects" compares in its section 3, with its algorithm as this project
wrote it from the paper, and beside it what the engine takes for the same disks and balls (find_near_pairs). Figures:
sort, against quicksort of the same items; naive, against testing all pairs; pairs, over their number, and with reference
points anywhere in the disks; and what the paper has not: radii, within a factor; space, balls in three dimensions;
traffic, air and sea (boxstream near). A Delaunay triangulation is measured by boxstream_bench near, where CGAL is found.

Times are processor time of one thread, medians of --repeats turns. All contestants must find the same pairs, or the run
fails.)";

/// `choice`: the option that names experiments.
void add_experiments(CLI::App& command, const char* choice, const char* help, Chosen& chosen,
                     int (*run)(const PaperOptions&)) {
  const auto options = std::make_shared<PaperOptions>();
  command.add_option(choice, options->figures, "Which ones, separated by commas; default: all")
      ->type_name("LIST")
      ->delimiter(',');
  command.add_flag("--quick", options->quick, "Small sets: seconds in place of minutes");
  command.add_option("--csv", options->csv, "Write a table each into this directory")->type_name("DIR");
  command.add_option("--svg", options->svg, "Write a plot each into this directory")->type_name("DIR");
  command.add_option("--repeats", options->repeats, "Runs to take the median of; default: 3")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command.add_option("--seed", options->seed, "Of the input; default: 1")->type_name("N");
  command.footer(help);
  choose(command, chosen, options, run);
}

}  // namespace

void add_paper(CLI::App& app, Chosen& chosen) {
  CLI::App* const paper = app.add_subcommand("paper", "Repeat the experiments of the papers behind the engine");
  paper->require_subcommand(1);
  add_experiments(*paper->add_subcommand("hybrid", "\"Fast software for box intersections\": its figures and tables"),
                  "--figure", hybrid_help, chosen, paper_hybrid_command);
  add_experiments(*paper->add_subcommand("structures",
                                         "\"Geometric data structures for computer graphics\": those that find boxes"),
                  "--work", structures_help, chosen, paper_structures_command);
  add_experiments(*paper->add_subcommand(
                      "thick", "\"Reporting intersections among thick objects\": its comparisons, and more of them"),
                  "--figure", thick_help, chosen, paper_thick_command);
}

}  // namespace boxstream::tool
