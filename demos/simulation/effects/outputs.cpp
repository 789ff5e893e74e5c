// SPDX-License-Identifier: MIT
#include <algorithm>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/world_recipe.hpp"

// What is looked at while a world runs: checks, tables, recordings.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_monitors(const Subject& subject) {
  if (auto call = first_of(subject.scene.checks, "/checks", "a check")) return call;
  if (!subject.scene.outputs.csv.empty()) return Call{"/outputs/csv", "a table of each step"};
  return std::nullopt;
}

// Pairs may be there though nothing can meet: of bodies that are fixed, with groups of their own.
bool looks_at_pairs(const Scene& scene) {
  return !scene.outputs.csv.empty() || std::any_of(scene.checks.begin(), scene.checks.end(), [](const Check& check) {
    return check.metric == Check::Metric::pairs || check.metric == Check::Metric::missed_pairs;
  });
}

void prepare_monitors(const Subject& subject, WorldRecipe& recipe) {
  if (looks_at_pairs(subject.scene)) recipe.collide = true;
}

std::optional<Call> calls_for_recording(const Subject& subject) {
  const Outputs& outputs = subject.scene.outputs;
  if (!outputs.record.empty()) return Call{"/outputs/record/0", outputs.record.front()};
  if (!outputs.view.empty()) return Call{"/outputs/view", outputs.view};
  if (!outputs.trace.empty()) return Call{"/outputs/trace", outputs.trace};
  return std::nullopt;
}

// Of bodies that meet nothing as well: files and pages have boxes where bodies are, not where they were at first.
bool looks_at_boxes(const Outputs& outputs) {
  return !outputs.view.empty() || std::any_of(outputs.record.begin(), outputs.record.end(),
                                              [](const std::string& file) { return file.ends_with(".aabbs"); });
}

void prepare_recording(const Subject& subject, WorldRecipe& recipe) {
  if (looks_at_boxes(subject.scene.outputs)) recipe.collide = true;
}

}  // namespace

const Effect monitors{"monitors",
                      "metrics of each step, for checks and tables",
                      "a check of bodies, contacts and pairs after each step",
                      calls_for_monitors,
                      {.prepare = prepare_monitors}};

const Effect recording{"recording",
                       "what happens is written to files",
                       "a writer after each step, or before the broad-phase",
                       calls_for_recording,
                       {.prepare = prepare_recording}};

}  // namespace boxstream::effects
