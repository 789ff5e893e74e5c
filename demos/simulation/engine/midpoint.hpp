// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "simulation/engine/fixed_point.hpp"

namespace boxstream::scenes {

/// How a multibody moves by its inertia and by forces: Bullet adds the accelerations that it has at the start of a
/// step, and gains or loses energy with each turn; a tree that swings hard flies apart. Here velocity in the middle of
/// a step is what the accelerations in its middle make it (the implicit midpoint rule), which keeps energy in the mean.
/// Steps in which joints turn far are taken in parts. Impulses of the solver are added to that.
///
/// A step: `find` when forces are in, `begin` when Bullet has added its accelerations, `move` when the solver is done,
/// `end` when all has moved.
class Midpoint {
 public:
  explicit Midpoint(btMultiBody& multibody);

  void find(double dt);
  /// What was found is of a step that did not come about: the multibody fell asleep.
  void drop() { runs_ = false; }
  void begin();
  /// `rests`: whether contacts or ends of joints push. Those must not be reached in the middle of a step, but at its
  /// end.
  void move(bool rests);
  /// Whether it has put the multibody elsewhere: its links are to be put there, too.
  bool end();

 private:
  using Values = std::vector<double>;
  struct Place {
    btVector3 base{0, 0, 0};
    btQuaternion turn{0, 0, 0, 1};
    std::vector<btScalar> joints{};
  };

  void read(Place& place) const;
  void go_to(const Place& place);
  /// In so many parts; false if one of them was not to be found.
  bool find_in(int parts);
  int parts_for(double dt) const;
  void set_velocity(const Values& values);
  void read_velocity(Values& values) const;
  /// Velocities in the middle of a step, if `middle` are those that led there.
  void answer(const Values& middle, Values& out);

  btMultiBody& multibody_;
  std::size_t size_;
  double step_ = 0, half_ = 0;  ///< seconds; half a part of it
  bool found_ = false, runs_ = false, jumps_ = false;
  Values first_, start_, middle_, mean_, final_, given_, now_;
  FixedPoint search_;
  Place at_first_, at_start_, at_end_;
  btAlignedObjectArray<btScalar> scalars_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
};

}  // namespace boxstream::scenes
