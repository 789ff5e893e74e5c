// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "formats/scene_model/scene.hpp"

/// Engines of others that run our scenes, to be compared with. They are given what the file says: shapes, masses,
/// places, velocities, joints and gravity, and nothing of what an engine made of them.
namespace boxstream::witnesses {

/// Why a scene is nothing for a witness. `what()` goes on after "FILE: no witness by NAME: ".
class Unknown : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Moving {
  std::size_t body;  // its number in the expanded scene
  scenes::Vec3 position;
  scenes::Quat rotation;
  scenes::Vec3 velocity, spin;  // of the centre of mass
};
struct Frame {
  std::vector<Moving> bodies;  // the dynamic ones
  double energy = 0;           // kinetic and potential, springs included
};

bool simbody_is_built();
bool ode_is_built();

/// Joints and free motion, by Simbody's error-controlled integrator (Runge-Kutta-Merson) in joint coordinates. It knows
/// ball joints, hinges and sliders without limits and motors, fixed joints and springs, closed loops of hinges too; no
/// contacts, damping or fields. Frames at the start and after each of `steps` steps of the scene; built without
/// Simbody: none.
///
/// Throws Unknown for a scene that has more.
std::vector<Frame> run_simbody(const scenes::Scene& scene, std::size_t steps, double accuracy = 1e-10);

struct OdeSettings {
  int substeps = 16;  // of a step of the scene
  double erp = 0.2;   // share of the depth of a contact that a substep mends
  double cfm = 1e-10;
  bool along =
      true;  // friction is bounded along and across the way a contact slides; false: along the axes that ODE picks
};

/// Contacts, by the Open Dynamics Engine and its exact solver (dWorldStep). It knows boxes, balls, capsules, cylinders,
/// planes and compounds of them, friction and restitution; no joints, damping or fields. Coefficients of two bodies are
/// multiplied, as here. Built without ODE: no frames.
///
/// Throws Unknown for a scene that has more.
std::vector<Frame> run_ode(const scenes::Scene& scene, std::size_t steps, const OdeSettings& settings);

}  // namespace boxstream::witnesses
