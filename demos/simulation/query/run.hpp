// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/query/contestant.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::query {

/// The names that `run` takes, boxstream first.
const std::vector<std::string>& manager_names();

/// Numbers of one query in one step.
struct QueryStep {
  std::uint64_t callbacks = 0;
  std::uint64_t skipped = 0;
  std::uint64_t failures = 0;
  std::uint64_t pairs = 0;
  std::uint64_t contacts = 0;
  bool touching = false;
  double distance = 0;  // infinite: none found
  double broad_ms = 0;
  double narrow_ms = 0;
};

struct StepResult {
  double update_ms = 0;
  std::vector<QueryStep> queries;  // in the order of the scene
};

struct ManagerRun {
  std::string manager;
  double register_ms = 0;
  std::vector<StepResult> steps;
};

struct GroupSize {
  std::string name;
  std::size_t objects = 0;
  std::size_t moving = 0;
};

struct RunResult {
  std::vector<GroupSize> groups;
  std::vector<ManagerRun> managers;  // one, or two that were compared
  std::optional<bool> answers_equal;
  std::string first_difference;  // step, query, objects
  std::size_t objects = 0;
  std::vector<std::size_t> touched;  // objects of pairs between groups, if there are several, in the last step; sorted
};

using Progress = std::function<void(std::uint64_t done, std::uint64_t objects, std::uint64_t pairs)>;

/// Runs `steps` steps of the scene on the manager and, step by step in turn, on the one to compare it with.
/// `progress(done, objects, pairs)` is called after each step.
RunResult run(const QueryScene& scene, const std::string& manager, const std::optional<std::string>& compare,
              std::uint64_t steps, const Progress& progress);

/// "0.7.0"
std::string fcl_version();

/// The first thing in which two answers to one query differ, in words; empty if they are the same. Counts of callbacks
/// and times may differ.
std::string difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                       const std::string& name_y, const Answer& y);

}  // namespace boxstream::query
