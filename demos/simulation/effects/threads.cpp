// SPDX-License-Identifier: MIT
#include <algorithm>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

// Below, the search is over before threads have begun.
constexpr std::size_t few_objects = 4096;

std::optional<Call> calls_for_threads(const Subject& subject) {
  const int wanted = subject.scene.broadphase.threads;
  if (wanted < 2 || subject.expanded.bodies.size() < few_objects) return std::nullopt;
  return Call{"/broadphase/threads", fmt::format("{} threads, {} bodies", wanted, subject.expanded.bodies.size())};
}

void prepare_threads(const Subject& subject, WorldRecipe& recipe) {
  recipe.threads = std::max(2, subject.scene.broadphase.threads);
}

}  // namespace

const Effect threads{"threads",
                     "the search for pairs runs on several threads",
                     "an Executor of the broad-phase",
                     calls_for_threads,
                     {.prepare = prepare_threads}};

}  // namespace boxstream::effects
