// SPDX-License-Identifier: MIT
// Worlds with closed forms, moved away from the origin, in single and in double precision. Bullets of both have the
// same names, so that the tool runs each world in a process of its own.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "experiment_kinds/kinds.hpp"

#ifndef BOXSTREAM_REPORT_TOOL
#define BOXSTREAM_REPORT_TOOL ""
#endif

namespace boxstream::report {
namespace {

using nlohmann::json;

/// Where a body ends is known: along one axis it is `at`, from where the world is put.
struct World {
  std::string name;
  json scene;
  std::size_t body = 0, axis = 0;
  double at = NAN, way = NAN;  ///< m; an error is a share of the way. NaN: the truth is not known
  double seconds = 0;
};

struct Candidate {
  std::string precision;
  int substeps = 1;
  double distance = 0;
};

struct Ran {
  double ms_per_second = NAN;
  double place = NAN;  ///< of the body, from where the world is put
};

class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "boxstream-report-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for temporary files");
    folder_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path file(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

World world_of(const json& item) {
  const std::string file = item.at("scene").get<std::string>();
  std::ifstream stream(file);
  if (!stream) throw std::invalid_argument(file + ": no such scene");
  World world{item.at("name"), json::parse(stream)};
  world.body = item.value("body", std::size_t{0});
  world.axis = item.value("axis", std::size_t{0});
  world.at = item.value("at", NAN);
  world.way = item.value("way", NAN);
  if (item.contains("steps")) world.scene["time"]["steps"] = item["steps"];
  world.seconds = world.scene.at("time").at("steps").get<double>() * world.scene["time"].at("dt").get<double>();
  return world;
}

/// The same scene somewhere else along the axis in which its truth is known.
json moved(const World& world, const Candidate& candidate) {
  json scene = world.scene;
  scene["solver"]["precision"] = candidate.precision;
  scene["time"]["substeps"] = candidate.substeps;
  const auto move = [&](json& place) { place.at(world.axis) = place[world.axis].get<double>() + candidate.distance; };
  if (scene.contains("bodies"))
    for (json& body : scene["bodies"]) move(body.at("position"));
  scene["world"]["bounds"] = {{"min", {-1e5, -1e5, -1e5}}, {"max", {1e5, 1e5, 1e5}}};
  return scene;
}

/// What a table of states has of a body in its last step. A float there is the shortest text that names it, and becomes
/// one again.
double last_place(const std::filesystem::path& file, const World& world, bool floats) {
  std::ifstream stream(file);
  double place = NAN;
  for (std::string line; std::getline(stream, line);) {
    std::size_t object = 0;
    double at[3] = {NAN, NAN, NAN};  // after the step and the time
    if (std::sscanf(line.c_str(), "%*u,%*f,%zu,%lf,%lf,%lf", &object, &at[0], &at[1], &at[2]) == 4 &&
        object == world.body)
      place = floats ? double{static_cast<float>(at[world.axis])} : at[world.axis];
  }
  return place;
}

Ran run(const Scratch& scratch, const World& world, const Candidate& candidate) {
  const std::filesystem::path scene = scratch.file("scene.json"), states = scratch.file("states.csv"),
                              report = scratch.file("report.json");
  std::ofstream(scene) << moved(world, candidate);
  const std::string command = "'" BOXSTREAM_REPORT_TOOL "' simulate '" + scene.string() + "' --states '" +
                              states.string() + "' --json '" + report.string() + "' >/dev/null 2>&1";
  std::filesystem::remove(report);
  [[maybe_unused]] const int code = std::system(command.c_str());
  std::ifstream stream(report);
  if (!stream) throw std::runtime_error(candidate.precision == "double" ? "built without doubles" : "did not run");
  const json summary = json::parse(stream).at("worlds").at(0).at("summary");
  return {summary.at("step").at("median_ms").get<double>() * static_cast<double>(world.scene["time"]["steps"]) /
              world.seconds,
          last_place(states, world, candidate.precision == "single") - candidate.distance};
}

std::string metres(double distance) {
  return distance < 1000 ? std::to_string(std::lround(distance)) + " m"
                         : std::to_string(std::lround(distance / 1000)) + " km";
}

}  // namespace

void measure_precision(Measurement& measurement) {
  const json& settings = measurement.settings();
  const Scratch scratch;
  for (const json& item : settings.at("worlds")) {
    const World world = world_of(item);
    std::vector<Candidate> candidates;
    for (const char* precision : {"single", "double"})
      for (const json& substeps : settings.at("substeps"))
        for (const json& distance : item.value("distances", settings.at("distances")))
          candidates.push_back({precision, substeps.get<int>(), distance.get<double>()});
    const auto timed = [&](const Candidate& candidate) {
      measurement.progress(world.name + ", " + candidate.precision + ", " + metres(candidate.distance));
      try {
        return run(scratch, world, candidate).ms_per_second;
      } catch (const std::runtime_error&) {
        return double{NAN};
      }
    };
    measurement.add_points(world.name, candidates, timed, [&](const Candidate& candidate, const measure::Estimate&) {
      Point point{.series = "precision=" + candidate.precision + " substeps=" + std::to_string(candidate.substeps),
                  .setting = metres(candidate.distance),
                  .x = candidate.distance,
                  .values = {NAN}};
      try {
        point.values[0] = std::abs(run(scratch, world, candidate).place - world.at) / world.way;
      } catch (const std::runtime_error& error) {
        point.failure = error.what();
      }
      return point;
    });
  }
}

}  // namespace boxstream::report
