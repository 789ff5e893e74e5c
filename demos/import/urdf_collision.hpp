// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include <urdf_model/link.h>

#include "import/fragment.hpp"
#include "import/import_file.hpp"

namespace boxstream::imports {

inline Vec3 vector(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}
inline Frame frame_of(const urdf::Pose& pose) {
  return {vector(pose.position), {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w}};
}

/// A link as one body.
struct LinkSolid {
  std::vector<Piece> pieces;  // around the centre of mass
  Vec3 centre{};              // of mass, in the link's frame
  double mass = 0;
  bool touches = true;  // false for a link without collision shapes: it has a stand-in
};

/// Makes bodies of what links say about collision and inertia. Meshes become convex (but for links that stand still and
/// have nothing else), and are read once.
class UrdfCollisions {
 public:
  UrdfCollisions(std::string path, const ImportOptions& options) : path_(std::move(path)), options_(options) {}

  /// Throws std::runtime_error naming the link: no mass and no density given, a shape without size, no such mesh file.
  LinkSolid solid(const urdf::Link& link, bool still);

 private:
  const TriangleMesh& mesh(const urdf::Mesh& mesh);
  std::vector<Hull> hulls(const urdf::Mesh& mesh);

  std::string path_;
  const ImportOptions& options_;
  std::map<std::string, TriangleMesh> meshes_;
};

}  // namespace boxstream::imports
