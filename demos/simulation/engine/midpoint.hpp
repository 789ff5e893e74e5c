// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace boxstream::scenes {

/// Largest absolute value.
inline double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Finds x = g(x) by Anderson's method: each next x is the combination of those before whose errors cancel best. Keeps
/// its memory.
class FixedPoint {
 public:
  using Values = std::vector<double>;

  explicit FixedPoint(std::size_t size) : error_(size), last_error_(size), image_(size), last_image_(size) {
    for (auto* const all : {&errors_, &images_, &axes_, &moves_})
      for (Values& values : *all) values.resize(size);
  }

  /// Begins with the x that is given. `g(x, image)`; `is_close(x, error)` ends it. False if that was not reached within
  /// so many calls of g.
  template <class Function, class IsClose>
  bool find(Values& x, Function g, IsClose is_close, std::size_t calls) {
    for (std::size_t call = 0; call < calls; ++call) {
      g(x, image_);
      for (std::size_t i = 0; i < x.size(); ++i) error_[i] = image_[i] - x[i];
      const double off = largest(error_);
      if (!std::isfinite(off)) return false;
      if (is_close(x, off)) return true;
      if (call > 0) note((call - 1) % depth);
      last_error_ = error_;
      last_image_ = image_;
      x = image_;
      take_away(std::min(call, depth), call, x);
    }
    return false;
  }

 private:
  static constexpr std::size_t depth = 8;
  using Many = std::array<Values, depth>;

  static double dot(const Values& a, const Values& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  /// The differences to the call before.
  void note(std::size_t place) {
    for (std::size_t i = 0; i < error_.size(); ++i) {
      errors_[place][i] = error_[i] - last_error_[i];
      images_[place][i] = image_[i] - last_image_[i];
    }
  }

  /// What the last differences span of the error goes, and from x what belongs to it.
  void take_away(std::size_t count, std::size_t calls, Values& x) {
    std::size_t used = 0;
    for (std::size_t back = 0; back < count; ++back) {
      const std::size_t place = (calls - 1 - back) % depth;
      Values &axis = axes_[used], &move = moves_[used];
      axis = errors_[place];
      move = images_[place];
      const double before = dot(axis, axis);
      for (std::size_t j = 0; j < used; ++j) {
        const double along = dot(axis, axes_[j]);
        for (std::size_t i = 0; i < x.size(); ++i) axis[i] -= along * axes_[j][i], move[i] -= along * moves_[j][i];
      }
      const double rest = dot(axis, axis);
      if (!(rest > 1e-10 * before)) continue;
      const double length = std::sqrt(rest);
      for (std::size_t i = 0; i < x.size(); ++i) axis[i] /= length, move[i] /= length;
      const double along = dot(error_, axis);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] -= along * move[i];
      ++used;
    }
  }

  Values error_, last_error_, image_, last_image_;
  Many errors_, images_;  // differences from one call to the next, of late
  Many axes_, moves_;
};

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
