// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/near.hpp>
#include <cmath>
#include <string_view>

#include "bad_input.hpp"
#include "batches/traffic.hpp"
#include "commands.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "near_report.hpp"
#include "number_rows.hpp"
#include "papers/thick/near.hpp"
#include "picture/neighbour_map.hpp"
#include "print.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

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

/// A file that is wanted, if it is.
struct Wanted {
  explicit Wanted(const std::string& path) {
    if (!path.empty()) file.emplace(path);
  }
  void write(const std::string& text) {
    if (file) file->stream() << text;
  }
  void commit() {
    if (file) file->commit();
  }
  std::optional<files::OutputFile> file{};
};

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

}  // namespace

int near_command(const NearOptions& options) {
  const auto format = picture::picture_format(options.picture);
  if (!options.picture.empty() && !format)
    throw BadInput(fmt::format("{}: a picture must end in .png or .svg", options.picture));
  NearRun run = make_run(options);
  Wanted csv(options.csv), json(options.json), picture(options.picture), save(options.save);
  StatusLine status;
  status.say(fmt::format("{} {}", run.balls.all.size(), run.what));

  const bool keep = options.list || !options.csv.empty() || !options.json.empty() || !options.picture.empty();
  std::uint64_t count = 0;
  // Kept only if they are wanted one by one: there can be more than there is memory for.
  search(run, [&](std::uint32_t a, std::uint32_t b) {
    ++count;
    if (keep) run.pairs.push_back({a, b});
  });
  std::sort(run.pairs.begin(), run.pairs.end());

  csv.write(near_csv(run));
  if (json.file) json.write(near_json(run));
  save.write(balls_csv(run.balls));
  if (picture.file) picture::write_neighbour_map(map_of(run), picture.file->stream(), *format);
  status.clear();
  for (Wanted* wanted : {&csv, &json, &picture, &save}) wanted->commit();
  const auto to_stdout = [](const std::string& path) { return path == "-"; };
  if (to_stdout(options.csv) || to_stdout(options.json) || to_stdout(options.save)) return 0;
  if (options.list) {
    std::string lines;
    for (const Pair pair : run.pairs) lines += fmt::format("{} {}\n", pair.a, pair.b);
    print(lines);
  } else {
    print(fmt::format("{} {}, pairs {}\n", run.what, run.balls.all.size(), count));
  }
  return 0;
}

}  // namespace boxstream::tool
