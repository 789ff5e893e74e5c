// SPDX-License-Identifier: MIT
#include "boxstream/simulate/events_file.hpp"

#include <fmt/format.h>

#include <iterator>

namespace boxstream::tool {
namespace {

/// As a field of CSV: in quotes, and those in it twice.
std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

}  // namespace

std::string events_table(const scenes::Scene& scene, const RunResult& result) {
  std::string text = "step,seconds,sensor,object,event\n";
  for (const scenes::StepResult& step : result.worlds.front().steps)
    for (const effects::SensorEvent& event : step.sensor_events)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", step.step,
                     static_cast<double>(step.step) * scene.time.dt, quoted(scene.sensors[event.sensor].name),
                     event.object, event.entered ? "enter" : "leave");
  return text;
}

}  // namespace boxstream::tool
