// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/engine/row_solver.hpp"

namespace boxstream::effects {
struct SceneInstance;
}

namespace boxstream::scenes {

/// Kinetic energy of a body, with its whole tensor of inertia, and its potential energy in gravity, counted from the
/// origin: joules.
double energy_of(const btRigidBody& body, const btVector3& gravity);

/// Energy that came into a world from outside: joules.
struct Work {
  double fields = 0;    ///< forces on bodies: wind, drag, buoyancy, swirls
  double motors = 0;    ///< of joints
  double surfaces = 0;  ///< kinematic bodies and conveyors
  double apart = 0;     ///< what moving deep contacts apart lifted
  double other = 0;     ///< all that changes bodies between steps of the engine: kicks, vehicles, characters, soft
                        ///< bodies, turning gravity, bodies that come and go

  double sum() const { return fields + motors + surfaces + apart + other; }
};

/// A step after which there was more energy than before, and no work that explains it.
struct Gain {
  std::uint64_t step = 0;
  double energy = 0;     ///< joules
  double share = 0;      ///< of the energy in the world
  std::size_t body = 0;  ///< which gained most
};

/// What became of the energy of a world's dynamic bodies and springs.
struct EnergyBalance {
  std::uint64_t steps = 0;    ///< accounted
  double first = 0, now = 0;  ///< joules; potential energy is counted from the origin
  double in_world = 0;        ///< now, counted from the lowest point that bodies came to
  Work work;
  std::uint64_t gains = 0;  ///< steps that gained more than a hundredth of the energy in the world
  std::optional<Gain> worst;

  /// What contacts, damping and sleep took out, gains taken off.
  double lost() const { return first + work.sum() - now; }
};

/// Energy and work, added up step for step. Looks on, and changes nothing. Steps of the engine in between that it is
/// not told of are no part of the balance.
class EnergyAccount {
 public:
  /// Bodies must be in the world.
  explicit EnergyAccount(const effects::SceneInstance& instance);

  void begin_step();
  /// Around each step of the engine, when hooks have set forces; `after_motion` is within it.
  void before_substep();
  void after_motion(double dt);
  void end_step(std::uint64_t step);
  /// Steps follow that it is not told of.
  void interrupt() { is_running_ = false; }

  const EnergyBalance& balance() const { return balance_; }

  /// Share of the energy in the world that a step may gain without a word.
  static constexpr double tolerated = 0.01;

 private:
  /// What a field does to a body, and how the body moved before.
  struct Pushed {
    const btRigidBody* body;
    btVector3 force, torque, velocity, spin;
  };

  double of_bodies();
  double springs();
  double in_world() const;
  bool is_touched() const;

  const effects::SceneInstance& instance_;
  EnergyBalance balance_;
  std::vector<double> of_body_, before_;  // joules of each, at the last look and when the step began
  std::vector<double> reach_;             // from the centre of each to its surface, in metres
  std::vector<btVector3> stretched_;      // springs, at the last look
  std::vector<Pushed> pushed_;
  SolverWork work_before_;
  double lowest_;  // where a surface came, upwards from the origin, in metres; 0 where there is no gravity
  double mass_ = 0;
  double energy_ = 0, spring_energy_ = 0;  // at the last look
  double gained_ = 0, in_world_before_ = 0;
  bool is_running_ = false, at_start_ = true;
};

}  // namespace boxstream::scenes
