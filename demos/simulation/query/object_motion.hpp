// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "simulation/query/scene.hpp"

namespace boxstream::query {

using Pose = Eigen::Isometry3d;
class Course;

/// One shape somewhere, a part of a body.
struct Object {
  std::size_t shape = 0;  // index into ObjectMotion::shapes
  std::size_t group = 0;
  std::uint32_t body = 0;
  int link = 0;
  int span = 0;  // parts of one body whose links differ by at most this are never a pair
  bool moves = false;
  const char* part = "";  // what it is called beside its number in the body
};

/// The objects of a scene and where they are after each step: a function of scene and step alone.
class ObjectMotion {
 public:
  explicit ObjectMotion(const QueryScene& scene);
  ~ObjectMotion();

  const std::vector<ShapeValue>& shapes() const { return shapes_; }
  const std::vector<Object>& objects() const { return objects_; }
  const std::vector<Pose>& poses() const { return poses_; }
  /// Moves what moves to where it is after `step` steps.
  void go_to(std::uint64_t step);
  /// "GROUP body 17" or "GROUP body 3 finger 2".
  std::string name(std::size_t object) const;

 private:
  struct Placed {
    std::size_t first;
    std::unique_ptr<Course> course;
  };

  std::vector<std::string> groups_;
  std::vector<ShapeValue> shapes_;
  std::vector<Object> objects_;
  std::vector<Pose> poses_;
  std::vector<Placed> courses_;
};

/// True if the two are parts of one body that are meant to touch.
bool belong_together(const Object& a, const Object& b);

}  // namespace boxstream::query
