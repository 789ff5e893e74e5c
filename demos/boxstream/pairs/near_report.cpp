// SPDX-License-Identifier: MIT
#include "boxstream/pairs/near_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "boxstream/shared/json_dump.hpp"
#include "boxstream/shared/report.hpp"

namespace boxstream::tool {
namespace {

double gap(const Ball64& a, const Ball64& b) {
  const double distance = std::hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1], a.centre[2] - b.centre[2]);
  return distance - a.radius - b.radius;
}

}  // namespace

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

}  // namespace boxstream::tool
