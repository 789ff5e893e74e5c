// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

struct Meta {
  std::string name;
  std::string about;
  std::string source;
  std::vector<std::string> tags;
};

struct Time {
  double dt = 1.0 / 60.0;  // of a step, which is what is counted, shown and recorded
  int substeps = 1;        // equal parts that the engine takes it in
  int steps = 600;
  int warmup_steps = 0;  // run first, and not counted
};

/// Gravity of constant size that tumbles: it starts along +x; before each step an axis that starts along +y turns about
/// z, and then gravity about that axis, both by the same angle (Broadmark's "Gravity" scenes).
struct TumblingGravity {
  double strength = 0;            // m/s^2
  double degrees_per_second = 0;  // of both turns
};

/// What becomes of dynamic bodies whose centre leaves the bounds.
enum class OnLeave { nothing, freeze, remove, report };

struct WorldSettings {
  Vec3 gravity{0, -9.81, 0};
  std::optional<TumblingGravity> tumbling;  // in place of `gravity`
  /// Where things are expected to stay. Sweep-and-prune broad-phases need it, and pictures aim at it.
  Bounds bounds;
  OnLeave on_leave = OnLeave::nothing;
  /// Scaling makes everything larger but the bodies, speeds and accelerations included, so that it takes the same time.
  bool self_similar = false;
  /// False: bodies are swept only if they ask for it, however fast they are, as in engines where that is an option.
  bool ccd = true;
  std::uint64_t seed = 1;
};

/// How sliding friction of a contact is bounded: along its direction, in a square around that direction, or in a square
/// whose sides depend on the contact's normal alone (a pyramid in place of the cone of Coulomb).
enum class FrictionDirections { one, two, two_fixed };

/// What works out the impulses of contacts and joints: Bullet's solver, which goes through them again and again; the
/// same with conjugate gradients; solvers of the whole matrix of rows, two of which are exact; and Bullet's own for
/// contacts beside multibodies, whose coordinates are the angles and ways of joints that form trees.
enum class SolverKind { sequential_impulses, nncg, dantzig, lemke, projected_gauss_seidel, multibodies };

/// Where bodies get the speed with which they bounce: in the solver, as Bullet has it, or when they touch, one pair
/// after the other.
enum class Bounces { in_solver, on_contact };

/// Of the numbers with which Bullet computes.
enum class Precision { single, doubled };

struct Solver {
  SolverKind kind = SolverKind::sequential_impulses;
  Bounces bounces = Bounces::in_solver;
  int iterations = 10;
  double residual = 0;          // iterations end when the largest squared change of an impulse is at most this
  bool warmstart = true;        // begin with the impulses of the step before
  bool split_impulse = true;    // separate deep contacts without giving bodies speed
  bool cache_friction = false;  // take friction directions over from the step before
  double erp = 0.2;             // share of a joint's error that is mended in a step
  double contact_erp = 0.2;     // share of a contact's depth that is mended in a step
  double slop = 0;              // metres that contacts may overlap for good
  FrictionDirections friction_directions = FrictionDirections::two;
  Precision precision = Precision::single;
};

struct BroadphaseSettings {
  std::string kind = "boxstream";  // one of broadphase_names()
  int threads = 1;                 // of boxstream's search
  bool force_boxes = false;        // set the boxes of sleeping bodies again in each step
};

/// Assertions about the plan: names of effects.
struct EffectWishes {
  std::vector<std::string> require;  // an error if the scene does not call for one
  std::vector<std::string> forbid;   // an error if it does
};

/// Files to write, in addition to what the command line asks for; relative to the working directory.
struct Outputs {
  std::vector<std::string> record;  // .bsrec, .aabbs, .glb
  std::string view;                 // .html
  std::string csv;                  // one row a step
  std::string trace;                // .json, for Perfetto and chrome://tracing
};

}  // namespace boxstream::scenes
