// SPDX-License-Identifier: MIT
// Imports every .urdf below a folder as `boxstream import --hold` does, then lets it run for two seconds under gravity
// with a fixed base, and says how far its joints have moved. One line for each robot; the table in
// demos/scenes/README.md comes from here.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <nlohmann/json.hpp>

#include "formats/import/import_file.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "simulation/run/simulation.hpp"

namespace {

using namespace boxstream;
using Json = nlohmann::json;

struct Moved {
  double degrees = 0;
  double millimetres = 0;
  std::string degrees_of, millimetres_of;
};

/// Of each joint: the first body as seen from the second, since the start.
Moved moved_after(const scenes::Scene& scene, int steps) {
  const scenes::Expanded expanded = scenes::expand(scene);
  scenes::Simulation simulation(scene, "boxstream");
  std::vector<btTransform> start;
  for (const btCollisionObject* object : simulation.objects()) start.push_back(object->getWorldTransform());
  for (int i = 0; i < steps; ++i) simulation.advance();
  const auto since = [&](std::size_t i) { return simulation.objects()[i]->getWorldTransform() * start[i].inverse(); };
  Moved moved;
  for (const scenes::Joint& joint : expanded.joints) {
    const btTransform motion = joint.b ? since(*joint.b).inverse() * since(joint.a) : since(joint.a);
    const auto& p = std::visit([](const auto& value) { return value.pivot; }, joint.value);
    const btVector3 pivot(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2]));
    double degrees = double{motion.getRotation().getAngleShortestPath()} * 180 / 3.14159265358979;
    double millimetres = double{(motion * pivot - pivot).length()} * 1000;
    if (!simulation.is_finite()) degrees = millimetres = 1e9;
    if (degrees > moved.degrees) moved.degrees = degrees, moved.degrees_of = expanded.bodies[joint.a].name;
    if (millimetres > moved.millimetres)
      moved.millimetres = millimetres, moved.millimetres_of = expanded.bodies[joint.a].name;
  }
  return moved;
}

scenes::Scene scene_of(const std::string& urdf, const Json& options) {
  Json generator{{"type", "import"}, {"file", urdf}, {"hold", true}};
  generator.update(options);
  const Json scene{{"format", 1},
                   {"meta", {{"name", "robot"}, {"about", "imported"}}},
                   {"time", {{"dt", 1.0 / 60}, {"substeps", 4}}},
                   {"solver", {{"iterations", 50}}},
                   {"world", {{"bounds", {{"min", {-1000, -1000, -1000}}, {"max", {1000, 1000, 1000}}}}}},
                   {"generators", {generator}}};
  return scenes::parse_scene(scene.dump(), "scene.json");
}

/// Processor time of this process and of the child processes that read files, in seconds.
double seconds_spent() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

/// Default options, or with one more.
std::string report(const std::string& urdf) {
  std::string said;
  for (const auto& [name, option] :
       std::map<std::string, Json>{{"", Json::object()}, {"--density", {{"density", 1000}}}}) {
    const double begun = seconds_spent();
    try {
      scene_of(urdf, option);
    } catch (const scenes::SceneError& error) {
      said = error.what();
      continue;
    }
    const double seconds = seconds_spent() - begun;
    Json fixed = option;
    fixed["fixed_base"] = true;
    const scenes::Scene scene = scene_of(urdf, fixed);
    const Moved moved = moved_after(scene, 120);
    char line[400];
    std::snprintf(line, sizeof line, "%-11s %5.2f s  %3zu joints  %8.3f degrees (%s)  %8.3f mm (%s)",
                  name.empty() ? "default" : name.c_str(), seconds, scenes::expand(scene).joints.size(), moved.degrees,
                  moved.degrees_of.c_str(), moved.millimetres, moved.millimetres_of.c_str());
    return line;
  }
  return "refused     " + said;
}

}  // namespace

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc != 2) {
    std::fprintf(stderr, "usage: boxstream_robots FOLDER\n");
    return 2;
  }
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(argv[1]))
    if (entry.path().extension() == ".urdf") files.push_back(fs::absolute(entry.path()).string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    std::printf("%-34s %s\n", fs::path(file).filename().c_str(), report(file).c_str());
    std::fflush(stdout);
  }
  return 0;
}
