// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "formats/scene_model/random.hpp"
#include "simulation/query/object_motion.hpp"

namespace boxstream::query {

/// What an actor is made of: parts in order, and bodies counted from 0.
struct Part {
  std::size_t shape = 0;
  std::uint32_t body = 0;
  int link = 0;
  int span = 0;
  const char* name = "";
};

/// A course: where each part of its bodies is after any number of steps.
class Course {
 public:
  virtual ~Course() = default;
  virtual bool moves() const = 0;
  /// Poses of all parts, in order.
  virtual void place(std::uint64_t step, Pose* out) const = 0;

  const std::vector<Part>& parts() const { return parts_; }

 protected:
  std::vector<Part> parts_;
};

/// Shapes that an actor needs beside the scene's are appended to `shapes`.
using Shapes = std::vector<ShapeValue>;
std::unique_ptr<Course> make_course(const Scatter& scatter, Shapes& shapes, scenes::Random random);
std::unique_ptr<Course> make_course(const Bin& bin, Shapes& shapes, scenes::Random random);
std::unique_ptr<Course> make_course(const Gripper& gripper, Shapes& shapes, scenes::Random random);
std::unique_ptr<Course> make_course(const Arm& arm, Shapes& shapes, scenes::Random random);
std::unique_ptr<Course> make_course(const Convoy& convoy, Shapes& shapes, scenes::Random random);

inline std::size_t added(Shapes& shapes, ShapeValue shape) {
  shapes.push_back(std::move(shape));
  return shapes.size() - 1;
}
inline Eigen::Vector3d vec(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
inline Pose pose_at(const Eigen::Vector3d& place) {
  Pose pose = Pose::Identity();
  pose.translation() = place;
  return pose;
}

}  // namespace boxstream::query
