// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "simulation/effects/collidable_pairs.hpp"
#include "simulation/effects/linked.hpp"

class btRigidBody;

namespace boxstream::scenes {
struct WorldRecipe;
}

namespace boxstream::effects {

struct SceneInstance;

/// What a plan is made for: a scene and its expansion.
struct Subject {
  /// Both have to outlive it.
  Subject(const scenes::Scene& whole, const scenes::Expanded& elements)
      : scene(whole), expanded(elements), collidable(elements), trees(trees_of(whole, elements)) {}

  const scenes::Scene& scene;
  const scenes::Expanded& expanded;
  const CollidablePairs collidable;
  const scenes::JointTrees trees;  ///< whose bodies and joints are those of multibodies
};

/// Why an effect is in a plan.
struct Call {
  std::string pointer;  ///< JSON pointer of the first element of the scene that calls for it
  std::string reason;   ///< what of it, as "friction 0.5"
};

struct Effect;

/// An effect that a run switched on, and why.
struct SwitchedOn {
  const Effect* effect;
  std::uint64_t step;  ///< 1 is the first
  std::string reason;  ///< as "body 3 moves 0.4 m in a step, 0.3 m are safe"
};

/// An object came into a sensor, or left it.
struct SensorEvent {
  std::uint32_t sensor;  ///< index into the scene's sensors
  std::uint32_t object;  ///< `getUserIndex()`
  bool entered;
  bool operator==(const SensorEvent&) const = default;
};

/// One thing that a world can do. An effect that a scene does not call for is not built, not registered and not called:
/// its functions are never reached.
struct Effect {
  const char* name;
  const char* about;   ///< what it does
  const char* builds;  ///< what is built or switched for it

  /// None if nothing in the scene calls for it. Pure.
  std::optional<Call> (*called_for)(const Subject&);

  struct Build {
    // Each may be null.
    /// Before there is a world.
    void (*prepare)(const Subject&, scenes::WorldRecipe&) = nullptr;
    /// For each rigid body, before it is in the world. Bodies are made with everything off.
    void (*configure_body)(const Subject&, const scenes::Body&, btRigidBody&) = nullptr;
    /// When all rigid bodies are in the world.
    void (*start)(SceneInstance&) = nullptr;
  } build = {};

  /// What tells whether it did something while it was on. Looked at after each step that is observed, outside of times.
  struct Activity {
    const char* unit = nullptr;  ///< what is counted, as "contact points"; null where nothing can tell
    /// What the last substep of the step left, or all since the world was built.
    std::uint64_t (*count)(const SceneInstance&) = nullptr;
    enum { of_step, of_run } extent = of_step;
  } activity = {};
};

}  // namespace boxstream::effects
