// SPDX-License-Identifier: MIT
// boxstream.simulate: a scene on Bullet, as arrays of poses and of pairs.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "signals.hpp"
#include "simulation/run/simulation.hpp"
#include "usage.hpp"

namespace boxstream::scenes {

namespace {

namespace py = pybind11;

/// Place and rotation (quaternion x, y, z, w) of one object at one time.
struct Pose {
  double place[3], rotation[4];
};

struct Run {
  std::size_t objects = 0;
  std::vector<Pose> poses;               // of all objects before the first step, then after each
  std::vector<std::vector<Pair>> pairs;  // after each step
};

Pose pose_of(const Simulation& simulation, std::size_t index) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (simulation.objects()[index]->getBroadphaseHandle() == nullptr)
    return {{none, none, none}, {none, none, none, none}};
  const btTransform pose = simulation.pose(index);
  const btVector3& place = pose.getOrigin();
  const btQuaternion rotation = pose.getRotation();
  return {{place.x(), place.y(), place.z()}, {rotation.x(), rotation.y(), rotation.z(), rotation.w()}};
}

void append_poses(const Simulation& simulation, std::vector<Pose>& poses) {
  for (std::size_t i = 0; i < simulation.objects().size(); ++i) poses.push_back(pose_of(simulation, i));
}

/// The name of a scene that comes with these sources, or a path.
std::string path_of(const std::string& scene) {
  const std::filesystem::path file = std::filesystem::path(shipped()) / (scene + ".json");
  return std::filesystem::is_regular_file(file) ? file.string() : scene;
}

Run run(const std::string& scene, std::size_t steps, const std::string& broadphase, const python::Unlocked& unlocked) {
  python::Signals signals(unlocked);
  Scene loaded = load_scene(path_of(scene));
  // A scene that is run for longer or shorter may call for other effects.
  loaded.time.steps = static_cast<int>(std::min<std::size_t>(steps, std::numeric_limits<int>::max()));
  Simulation simulation(loaded, broadphase);
  const StepOptions options{.events = false, .exact_pairs = false, .hash = false};
  Run run;
  run.objects = simulation.objects().size();
  append_poses(simulation, run.poses);
  for (std::size_t step = 0; step < steps; ++step) {
    simulation.step(options);
    append_poses(simulation, run.poses);
    run.pairs.push_back(simulation.pairs());
    signals.check();
  }
  return run;
}

py::tuple simulate(const std::string& scene, std::size_t steps, const std::string& broadphase) {
  static python::Usage usage("process's one simulation");
  Run result;
  {
    const python::Usage::Change change(usage);
    result =
        python::without_lock([&](const python::Unlocked& unlocked) { return run(scene, steps, broadphase, unlocked); });
  }
  py::list pairs;
  for (std::vector<Pair>& each : result.pairs) pairs.append(python::array_of<std::uint32_t>(std::move(each)));
  const auto size = [](std::size_t value) { return static_cast<py::ssize_t>(value); };
  return py::make_tuple(python::array_of<double>(std::move(result.poses), {size(steps) + 1, size(result.objects), 7}),
                        pairs);
}

}  // namespace

}  // namespace boxstream::scenes

PYBIND11_MODULE(_simulation, module) {
  module.def("simulate", &boxstream::scenes::simulate);
}
