// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/link.h>

#include "formats/import/fragment.hpp"
#include "formats/import/import_file.hpp"

namespace boxstream::imports {

inline Vec3 vector(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}
inline Frame frame_of(const urdf::Pose& pose) {
  return {vector(pose.position), {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w}};
}

/// One of the links that fixed joints hold together.
struct Member {
  const urdf::Link* link;
  Frame frame;  // in the frame of the first
};

inline bool has_mass(const urdf::Link& link) {
  return link.inertial && link.inertial->mass != 0;
}

/// Links as one body.
struct LinkSolid {
  std::vector<Piece> pieces;    // as seen from `place`
  Frame place;                  // the centre of mass and the principal axes, in the first link's frame
  double mass = 0;              // none of a solid that stands still
  std::optional<Vec3> inertia;  // about the axes of `place`; none: as of its shapes
  bool touches = true;          // false for links without collision shapes: they have a stand-in
};

/// Makes bodies of what links say about collision and inertia. Meshes become convex (but for links that stand still and
/// have nothing else), and are read once.
class UrdfCollisions {
 public:
  UrdfCollisions(std::string path, const ImportOptions& options) : path_(std::move(path)), options_(options) {}

  /// Of links that move as one, and have shapes or a mass. Throws std::runtime_error naming the link: no mass and no
  /// density given, a shape without size, no such mesh file.
  LinkSolid solid(const std::vector<Member>& members);

  /// Of a link with shapes that stands still: as it is, triangles and all.
  LinkSolid still_solid(const urdf::Link& link);

 private:
  struct Measured;

  std::vector<Measured> measured(const Member& member);
  void add_mesh(const urdf::Mesh& mesh, const Frame& place, std::vector<Measured>& out);
  const TriangleMesh& mesh(const urdf::Mesh& mesh);
  std::vector<Hull> hulls(const urdf::Mesh& mesh);

  std::string path_;
  const ImportOptions& options_;
  std::map<std::pair<std::string, Vec3>, TriangleMesh> meshes_;  // by file and scale
};

}  // namespace boxstream::imports
