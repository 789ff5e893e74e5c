// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "elsewhere.hpp"
#include "sweep.hpp"

/// The settings of a sweep as scenes, ready to run.
namespace boxstream::accuracy {

/// The scene of one setting.
struct Candidate {
  Row row;
  scenes::Scene scene;
  Source source{};  ///< if it runs elsewhere
};

struct Candidates {
  std::vector<Candidate> all;
  std::optional<std::size_t> own;  ///< which is the scene as it is
  double finest = 1;               ///< most substeps in a step of the plain scene
  double cost = 0;                 ///< of all, beside that of one substep without iterations
  bool any_elsewhere = false;
};

/// Outputs would write files, and what was expected speaks of the scene as it is.
nlohmann::json bare(nlohmann::json document);

scenes::Scene scene_of(const Request& request, const nlohmann::json& document);

/// Where all settings start; nothing if that is where the scene's file has bodies.
std::vector<Place> start_of(const Request& request, nlohmann::json document);

/// The scene with its bodies at their start.
scenes::Scene started(const Request& request, const nlohmann::json& document, const std::vector<Place>& start);

/// Those of the request's knobs; `plain` is the scene as it is. BadKnob if one asks for what is not installed.
Candidates candidates_of(const Request& request, const nlohmann::json& document, const scenes::Scene& plain,
                         const std::vector<Place>& start);

/// Checks speak of the whole run of the scene as it is: steps of another length come at other numbers. What the
/// broad-phase misses is no matter of accuracy, and takes another search in each step.
void adapt_checks(const Request& request, const scenes::Scene& plain, scenes::Scene& scene);

/// Of a run with any setting.
double seconds_of(const Request& request, const scenes::Scene& plain);

std::uint64_t steps_in(double seconds, const scenes::Scene& scene, const std::string& label, bool exactly);

/// Substeps of a step of the plain scene.
double fineness(const scenes::Scene& scene, const scenes::Scene& plain);

/// All substeps of its run.
double work_of(const Candidate& candidate);

/// Of a substep, beside others: iterations are a part of it.
double cost_of_substep(const scenes::Scene& scene);

/// What a setting is expected to cost, beside others.
double expected_cost(const Candidate& candidate);

}  // namespace boxstream::accuracy
