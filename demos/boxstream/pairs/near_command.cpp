// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/near.hpp>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/read_file.hpp"
#include "boxstream/pairs/number_rows.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "inputs/traffic.hpp"
#include "papers/thick/report_intersections.hpp"
#include "pictures/drawing/neighbour_map.hpp"

namespace boxstream::tool {
namespace {

/// What `boxstream near` found, and in what.
struct NearRun {
  std::string source;  ///< a file, or the traffic with its seed
  std::string what;    ///< "objects", "aircraft", "ships"
  std::string engine;
  Balls balls;
  double distance;
  std::vector<Pair> pairs{};  ///< sorted, if they were asked for
};

double gap(const Ball64& a, const Ball64& b) {
  const double distance = std::hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1], a.centre[2] - b.centre[2]);
  return distance - a.radius - b.radius;
}

/// "a,b,gap" and a row for each pair. The gap between two balls is a double's, and below 0 where they overlap.
std::string near_csv(const NearRun& run) {
  std::string text = "a,b,gap\n";
  for (const Pair pair : run.pairs)
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", pair.a, pair.b,
                   gap(run.balls.all[pair.a], run.balls.all[pair.b]));
  return text;
}

std::string near_json(const NearRun& run) {
  nlohmann::ordered_json document = report_about({{"source", run.source},
                                                  {"objects", run.balls.all.size()},
                                                  {"dimensions", run.balls.dimensions},
                                                  {"radius", run.distance},
                                                  {"engine", run.engine}});
  document["pairs"] = run.pairs.size();
  document["near"] = nlohmann::ordered_json::array();
  for (const Pair pair : run.pairs)
    document["near"].push_back(
        {{"a", pair.a}, {"b", pair.b}, {"gap", gap(run.balls.all[pair.a], run.balls.all[pair.b])}});
  return json_dump(document, 1) + "\n";
}

/// The objects, as `read_balls` reads them.
std::string balls_csv(const Balls& balls) {
  const bool radii = std::any_of(balls.all.begin(), balls.all.end(), [](const Ball64& b) { return b.radius > 0; });
  std::string text = balls.dimensions == 3 ? "# x,y,z" : "# x,y";
  text += radii ? ",radius\n" : "\n";
  for (const Ball64& ball : balls.all) {
    fmt::format_to(std::back_inserter(text), "{},{}", ball.centre[0], ball.centre[1]);
    if (balls.dimensions == 3) fmt::format_to(std::back_inserter(text), ",{}", ball.centre[2]);
    if (radii) fmt::format_to(std::back_inserter(text), ",{}", ball.radius);
    text += '\n';
  }
  return text;
}

struct NearOptions {
  std::string file;                   // "-": standard input; empty: traffic
  std::string traffic;                // "air", "sea"; empty: a file
  std::uint64_t count = 2000;         // of traffic
  std::uint64_t seed = 1;             // of traffic
  std::optional<double> radius;       // none: what traffic keeps
  std::optional<int> dimensions;      // none: as the columns of the file say
  std::string engine = "production";  // or "thick"
  bool list = false;
  std::string csv, picture, save;  // empty: none
  std::string json;                // empty: none; "-": standard output, in place of the count
};

NearRun make_run(const NearOptions& options) {
  if (options.file.empty() == options.traffic.empty())
    throw BadInput(options.file.empty() ? "near needs a FILE or --traffic (see boxstream near --help)"
                                        : "near takes a FILE or --traffic, not both");
  if (options.radius && !(std::isfinite(*options.radius) && *options.radius >= 0))
    throw BadInput("--radius must be finite and not below 0");
  NearRun run{options.file, "objects", options.engine, {{}, 3}, 0};
  if (options.traffic.empty()) {
    if (!options.radius) throw BadInput("near FILE needs --radius");
    if (options.file == "-") run.source = "standard input";
    files::InputFile rows(options.file);
    run.balls = read_balls(rows.stream(), run.source, options.dimensions);
    run.distance = *options.radius;
  } else {
    batches::Traffic traffic = batches::make_traffic(options.traffic, options.count, options.seed);
    run.source = fmt::format("{} traffic, seed {}", options.traffic, options.seed);
    run.what = traffic.what;
    run.balls = {std::move(traffic.objects), traffic.dimensions};
    run.distance = options.radius.value_or(traffic.safety_distance);
  }
  return run;
}

/// `found(a, b)` for each pair, a < b.
template <class FoundPair>
void search(const NearRun& run, const FoundPair& found) {
  const Span<const Ball64> balls(run.balls.all);
  if (run.engine == "thick") {
    if (run.balls.dimensions == 2) return papers::thick_near_pairs<2>(balls, run.distance, found);
    return papers::thick_near_pairs<3>(balls, run.distance, found);
  }
  Detector detector;
  stream_near_pairs(detector, balls, run.distance, [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) found(pair.a, pair.b);
    return true;
  });
}

picture::NeighbourMap map_of(const NearRun& run) {
  picture::NeighbourMap map;
  map.title = fmt::format("{} {}, {} pairs within {}", run.balls.all.size(), run.what, run.pairs.size(), run.distance);
  map.subtitle = run.source;
  map.distance = run.distance;
  for (const Ball64& ball : run.balls.all)
    map.places.push_back({ball.centre[0], ball.centre[1], ball.centre[2], ball.radius});
  for (const Pair pair : run.pairs) map.pairs.push_back({pair.a, pair.b});
  return map;
}

int run_near(const NearOptions& options) {
  const auto format = checked_format(options.picture);
  NearRun run = make_run(options);
  OutputFiles files;
  std::ostream *const csv = files.add(options.csv), *const json = files.add(options.json);
  std::ostream *const picture = files.add(options.picture), *const save = files.add(options.save);
  StatusLine status;
  status.say(fmt::format("{} {}", run.balls.all.size(), run.what));

  const bool keep = options.list || csv != nullptr || json != nullptr || picture != nullptr;
  std::uint64_t count = 0;
  // Kept only if they are wanted one by one: there can be more than there is memory for.
  search(run, [&](std::uint32_t a, std::uint32_t b) {
    ++count;
    if (keep) run.pairs.push_back({a, b});
  });
  std::sort(run.pairs.begin(), run.pairs.end());

  if (csv != nullptr) *csv << near_csv(run);
  if (json != nullptr) *json << near_json(run);
  if (save != nullptr) *save << balls_csv(run.balls);
  if (picture != nullptr) picture::write_neighbour_map(map_of(run), *picture, *format);
  status.clear();
  files.commit();
  if (options.csv == "-" || options.json == "-" || options.save == "-") return 0;
  if (options.list) {
    std::string lines;
    for (const Pair pair : run.pairs) lines += fmt::format("{} {}\n", pair.a, pair.b);
    print(lines);
  } else {
    print(fmt::format("{} {}, pairs {}\n", run.what, run.balls.all.size(), count));
  }
  return 0;
}

Action set_up_near(CommandLine& command) {
  const auto options = std::make_shared<NearOptions>();
  add_input(command, "FILE", options->file, "Rows of points or balls; - is standard input");
  command.add_option("--radius", options->radius, "The distance; of traffic, by default the usual one")->type_name("R");
  add_number(command, "--dimensions", options->dimensions, "Of FILE; default: 2 for two columns, else 3", 2, 3, "D");
  CLI::Option* const traffic =
      take_words(command, add_name(command, "--traffic", options->traffic, "Generate {} traffic in place of FILE"),
                 "traffic", {"air", "sea"});
  command.get_option("--dimensions")->excludes(traffic);
  add_number(command, "--count", options->count, "Aircraft or ships; default: 2000", 1, 10'000'000)->needs(traffic);
  command.add_option("--seed", options->seed, "Of the traffic; default: 1")->type_name("N")->needs(traffic);
  take_words(command, add_name(command, "--engine", options->engine, "{}; default: production"), "engine",
             {"production", "thick"});
  command.add_flag("--list", options->list, "Print the pairs");
  add_file(command, "--csv", options->csv, "Write the pairs as a table; - is standard output");
  add_json(command, options->json, "Write the pairs and the request");
  add_file(command, "--picture", options->picture, "Draw all objects and pairs from above: FILE.png or FILE.svg");
  add_file(command, "--save", options->save, "Write the objects as a table; - is standard output");
  return [options] { return run_near(*options); };
}

}  // namespace

extern const Command near_command{"near", "Find all points, disks or balls within a distance of each other",
                                  R"(Examples:
  boxstream near points.csv --radius 0.5
  boxstream near --radius 0 --dimensions 2 --csv overlaps.csv - < disks.csv
  boxstream near --traffic sea --count 3000 --picture sea.svg
  boxstream near --traffic air --radius 5 --save aircraft.csv --json - | jq .pairs

All pairs of points that are at most the radius apart; of disks and balls, all whose gap is at most the radius. "At most"
is exact for the numbers as they are read, to the last bit. One object a line: x y, x y z, or x y z radius, separated by
blanks or commas, all lines alike; with --dimensions 2, x y or x y radius. '#' starts a comment; a first line without a
number is a title, or names the columns: as many as there are, and none of them an id, an index, a frame or a time.

--csv and --json give each pair (numbers of objects counted from 0) with its gap, in order. --list prints the pairs in
place of their number.

--traffic generates aircraft or ships in place of a file, in nautical miles: ships as disks, in lanes and at anchor, to
keep 0.5 apart; aircraft as points, to keep 5 apart, with heights stretched so that 1000 ft are 5 miles. The area grows
with --count. --save writes them for near to read (ships with --dimensions 2).

--engine production, the default, is the library's find_near_pairs; thick is the divide and conquer algorithm of
"Reporting intersections among thick objects" (boxstream paper thick). Both find the same pairs.)",
                                  set_up_near};

}  // namespace boxstream::tool
