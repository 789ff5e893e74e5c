// SPDX-License-Identifier: MIT
#include "boxstream/simulate/events_file.hpp"

#include <fmt/format.h>

#include <iterator>

#include "formats/scene_model/expand.hpp"

namespace boxstream::tool {
namespace {

/// As a field of CSV: in quotes, and those in it twice.
std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

}  // namespace

std::string object_name(const scenes::Simulation& simulation, std::size_t object) {
  // In the order in which objects are numbered.
  const scenes::Scene& scene = simulation.scene();
  const std::vector<scenes::Body>& bodies = simulation.expanded().bodies;
  if (object < bodies.size()) return bodies[object].name;
  object -= bodies.size() + scene.sensors.size();
  if (object < scene.characters.size()) return scene.characters[object].name;
  object -= scene.characters.size();
  return object < scene.soft_bodies.size() ? scene.soft_bodies[object].name : "";
}

std::string events_table(const scenes::Scene& scene, const RunResult& result) {
  std::string text = "step,seconds,sensor,object,event,name\n";
  const scenes::Simulation& simulation = *result.worlds.front().simulation;
  for (const scenes::StepResult& step : result.worlds.front().steps)
    for (const effects::SensorEvent& event : step.sensor_events)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", step.step,
                     static_cast<double>(step.step) * scene.time.dt, quoted(scene.sensors[event.sensor].name),
                     event.object, event.entered ? "enter" : "leave", quoted(object_name(simulation, event.object)));
  return text;
}

}  // namespace boxstream::tool
