// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/scene_model/scene.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::effects_test {

/// One effect that a scene of the gallery calls for, and the first element that does.
struct Call {
  const char* effect;
  const char* pointer;
};

/// A scene of demos/scenes/effects: the smallest that calls for the effect it is named after, and all that it calls
/// for.
struct Exhibit {
  const char* name;
  std::vector<Call> calls;
};

const std::vector<Exhibit>& gallery();

/// For the listings of ctest.
void PrintTo(const Exhibit& exhibit, std::ostream* out);

nlohmann::json document_of(const std::string& exhibit);
scenes::Scene scene_of(const nlohmann::json& document);
scenes::Scene exhibit(const std::string& name);

/// Two scenes of the gallery in one: what either adds to the scene that calls for nothing. None if both change the
/// same thing of it.
std::optional<nlohmann::json> merged(const nlohmann::json& a, const nlohmann::json& b);

using Names = std::set<std::string>;

/// Names of the effects that are on.
Names on(const effects::Plan& plan);
Names names_of(const Exhibit& exhibit);

/// Ends of tests' names, so that ctest tells them apart.
inline std::string name_of_exhibit(const Exhibit& exhibit) {
  return exhibit.name;
}

}  // namespace boxstream::effects_test
