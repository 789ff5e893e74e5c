// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "simulation/run/energy_account.hpp"

class btCollisionObject;

namespace boxstream::scenes {

class Simulation;

/// When something was worst, and which objects it was about.
struct WorstMoment {
  std::uint64_t step = 0;              ///< 0: it never was
  std::array<int, 2> objects{-1, -1};  ///< by their numbers; -1: the world
};

/// What went wrong in a run whatever it was made for, and by how much: what its own metric may not see.
struct Vitals {
  double deepest = 0;        ///< m, of all contact points in all steps
  double deepest_share = 0;  ///< of the least side of the thinner of the two bodies
  double end_share = 0;      ///< the same after the last step
  WorstMoment when_deepest;
  double joint_gap = 0;    ///< m, between the two ends of a joint
  double joint_share = 0;  ///< see JointError
  WorstMoment when_widest;
  std::uint64_t outside = 0;  ///< dynamic bodies out of the scene's bounds after the last step
  /// How far bodies are from the reference on average, as a share of the way they went there, or of their size or a
  /// tenth of that of all together if that is more; 0: not known.
  double elsewhere = 0;
  double height_loss = 0;  ///< of the top of the dynamic bodies after the last step, see Monitor
  EnergyBalance energy;
  double most_in_world = 0;  ///< J, of all steps
  double most_gained = 0;    ///< J, the most that the world had beyond what it began with and work brought
  double vanished = 0;       ///< J, of bodies, at the end
  bool conserves = false;    ///< there was nothing that takes energy: contacts, damping, fields, soft bodies
  std::vector<std::string> failed_checks;  ///< of the scene, as text
};

/// Looks at a world after each step. Never changes it.
class VitalsMonitor {
 public:
  /// Of a world that has not stepped, and lives longer. Its steps have to account for energy, which is looked at every
  /// `energy_every` steps.
  explicit VitalsMonitor(Simulation& simulation, std::uint64_t energy_every = 1);

  void look();

  /// Until now.
  Vitals vitals() const;

 private:
  double thickness(const btCollisionObject& object) const;
  void look_at_contacts();

  Simulation& simulation_;
  std::uint64_t energy_every_;
  std::vector<double> thickness_;  // of each object; infinite for what has none
  Vitals vitals_;
  bool anything_takes_energy_;
  double first_energy_;
};

/// Shares beyond which a run is not sound.
inline constexpr double most_energy_gained = 0.05;    ///< over the whole run, of what was in the world
inline constexpr double most_energy_vanished = 0.05;  ///< where nothing takes any
inline constexpr double most_depth = 0.55, most_depth_at_end = 0.15;
inline constexpr double most_elsewhere = 0.3;
inline constexpr double most_joint_gap = 0.05;

inline constexpr double most_energy_apart = 0.1;  ///< from what the reference loses, of what was in its world

inline constexpr double most_fall = 0.1;  ///< of the height, or of what the reference falls, if that is more

/// Whether two losses of height are the same for all that matters.
bool falls_alike(double a, double b);

/// Why a run is not sound, in one line; empty if it is.
std::string unsound(const Vitals& vitals);
/// What is known to be right.
struct Known {
  std::uint64_t least_outside = 0;  ///< bodies that leave in any case
  const Vitals* height = nullptr;   ///< whose loss of height is right
  const char* height_of = "the reference";
  const Vitals* energy_lost = nullptr;  ///< whose loss of energy is right
};
/// The same beside others.
std::string unsound(const Vitals& vitals, const Known& known);

}  // namespace boxstream::scenes
