// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream near points.csv --radius 0.5
  boxstream near --radius 0 --dimensions 2 --csv overlaps.csv - < disks.csv
  boxstream near --traffic sea --count 3000 --picture sea.svg
  boxstream near --traffic air --radius 5 --save aircraft.csv --json - | jq .pairs

All pairs of points that are at most the radius apart; of disks and balls, all whose gap is at most the radius. "At most"
is exact for the numbers as they are read, to the last bit. One object a line: x y, x y z, or x y z radius, separated by
blanks or commas, all lines alike; with --dimensions 2, x y or x y radius. '#' starts a comment; a first line without a
number names the columns.

--csv and --json give each pair (numbers of objects counted from 0) with its gap, in order. --list prints the pairs in
place of their number.

--traffic makes up aircraft or ships in place of a file, in nautical miles: ships as disks, in lanes and at anchor, to
keep 0.5 apart; aircraft as points, to keep 5 apart, with heights stretched so that 1000 ft are 5 miles. The area grows
with --count. --save writes them for near to read (ships with --dimensions 2).

--engine production, the default, is the library's find_near_pairs; thick is the divide and conquer algorithm of
"Reporting intersections among thick objects" (boxstream paper thick). Both find the same pairs.)";

}  // namespace

void add_near(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<NearOptions>();
  CLI::App* const command =
      app.add_subcommand("near", "Find all points, disks or balls within a distance of each other");
  command->add_option("FILE", options->file, "Rows of points or balls; - is standard input");
  command->add_option("--radius", options->radius, "The distance; of traffic, by default the usual one")
      ->type_name("R");
  command->add_option("--dimensions", options->dimensions, "Of FILE; default: 2 for two columns, else 3")
      ->type_name("D")
      ->check(CLI::IsMember({2, 3}));
  CLI::Option* const traffic =
      command->add_option("--traffic", options->traffic, "Make up air or sea traffic in place of FILE")
          ->type_name("NAME")
          ->check(CLI::IsMember({"air", "sea"}));
  command->get_option("--dimensions")->excludes(traffic);
  command->add_option("--count", options->count, "Aircraft or ships; default: 2000")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000))
      ->needs(traffic);
  command->add_option("--seed", options->seed, "Of the traffic; default: 1")->type_name("N")->needs(traffic);
  command->add_option("--engine", options->engine, "production or thick; default: production")
      ->type_name("NAME")
      ->check(CLI::IsMember({"production", "thick"}));
  command->add_flag("--list", options->list, "Print the pairs");
  command->add_option("--csv", options->csv, "Write the pairs as a table; - is standard output")->type_name("FILE");
  command->add_option("--json", options->json, "Write the pairs and what was asked; - is standard output")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw all objects and pairs from above: FILE.png or FILE.svg")
      ->type_name("FILE");
  command->add_option("--save", options->save, "Write the objects as a table; - is standard output")->type_name("FILE");
  command->footer(help);
  choose(*command, chosen, options, near_command);
}

}  // namespace boxstream::tool
