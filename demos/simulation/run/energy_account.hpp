// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/engine/mass.hpp"
#include "simulation/engine/row_solver.hpp"

namespace boxstream::effects {
struct SceneInstance;
}

namespace boxstream::scenes {

/// Kinetic energy of a body, with its whole tensor of inertia, and its potential energy in gravity, counted from the
/// origin: joules.
double energy_of(const btRigidBody& body, const btVector3& gravity);

/// Of springs that are in the world, as they are drawn out now: joules.
double energy_of_springs(const effects::SceneInstance& instance);

/// EnergyBalance::in_world of a world as it is now, between two steps: never 0 where a dynamic body is in the world.
double energy_in_world(const effects::SceneInstance& instance);

/// Energy that came into a world from outside: joules.
struct Work {
  double fields = 0;    ///< forces on bodies: wind, drag, buoyancy, vortices
  double motors = 0;    ///< of joints
  double surfaces = 0;  ///< kinematic bodies and conveyors
  double apart = 0;     ///< what moving deep contacts apart lifted
  double other = 0;     ///< all that changes bodies between steps of the engine: impulses, vehicles, characters, soft
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
  /// The same without what sank in and was lifted out again.
  double lost_for_good() const { return lost() - work.apart; }
};

/// Energy and work, added up step for step. Looks on, and changes nothing. Steps of the engine in between that it is
/// not told of are no part of the balance.
///
/// What flies free gains nothing: only bodies that something acts on (contacts, joints, sweeps, effects by themselves)
/// are looked at in each step, before it and after it. All are looked at where the account begins and is read, and once
/// in a while: should there be more then than was seen to come, that is a gain, too.
class EnergyAccount {
 public:
  /// Bodies must be in the world.
  explicit EnergyAccount(const effects::SceneInstance& instance);

  void begin_step();
  /// Around each step of the engine, when hooks have set forces; `after_motion` is within it.
  void before_substep();
  /// Something is about to change the motion of a body, within a step of the engine or between two.
  void acting_on(const btRigidBody& body);
  void after_motion(double dt);
  void end_step(std::uint64_t step);
  /// Steps follow that it is not told of.
  void interrupt();

  /// As it is after the last step that it was told of. Looks at all bodies.
  const EnergyBalance& balance();

  /// Share of the energy in the world that a step may gain without a word.
  static constexpr double tolerated = 0.01;

 private:
  /// What is known of a body.
  struct Known {
    Inertia inertia;
    double reach;  // from the centre to its surface, in metres
    // Steps of the engine move it by the velocity that it has at their end, which is that of their middle: it has been
    // falling for half a step more. Not so of links of multibodies.
    bool falls_ahead;
    double energy = 0;         // joules, at the moment of the last look; 0 of what does not count
    std::uint64_t seen = 0;    // that moment
    std::uint64_t listed = 0;  // when something last acted on it
  };
  /// One that something acts on.
  struct Acted {
    std::size_t body;
    double before, gained;  // joules
    bool counted;           // before
  };
  /// What a field does to a body, and how the body moved before.
  struct Pushed {
    std::size_t body;
    btVector3 force, torque, velocity, spin;
  };

  struct Spring {
    std::size_t joint;
    double stiffness;   // N/m
    btVector3 stretch;  // at the last look; 0 of what is not in the world
    double energy = 0;  // joules, likewise
  };

  double look_at(std::size_t body);
  void look_at_all();
  /// A look at all in the middle of the account.
  void look_back();
  void settle();
  double springs();
  double in_world() const;
  void note_gain(double energy, double share);

  const effects::SceneInstance& instance_;
  EnergyBalance balance_;
  std::vector<Known> known_;           // of each body
  std::vector<Acted> acted_;           // in the step that is running, those of the substep from `first_acted_` on
  std::vector<Acted> between_;         // since bodies moved
  std::vector<double> reckoned_;       // energy of each before a look at all
  std::vector<std::size_t> spinners_;  // that Bullet turns as if their spin stayed
  std::vector<Spring> springs_;
  std::vector<Pushed> pushed_;
  btVector3 gravity_{0, 0, 0};
  SolverWork work_before_;
  std::size_t first_acted_ = 0;
  std::uint64_t moment_ = 1;  // counts the times within steps of the engine, and those between them
  std::uint64_t since_look_ = 0, step_ = 0;
  double lowest_;    // potential of the lowest place to which a surface came, in J/kg from the origin
  double mass_ = 0;  // kg
  double energy_ = 0, spring_energy_ = 0;  // with all that came since the last look
  double strength_ = 0;                    // of gravity, in m/s^2
  double gained_ = 0, in_world_before_ = 0;
  bool is_vague_;  // things act on bodies and do not say on which
  bool is_running_ = false, at_start_ = true, is_within_ = false;
};

}  // namespace boxstream::scenes
