// SPDX-License-Identifier: MIT
#include "import/urdf_collision.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "import/solid.hpp"
#include "scene/scene_error.hpp"

namespace boxstream::imports {
namespace {

namespace fs = std::filesystem;

constexpr double pi = std::numbers::pi;

/// A piece in the link's frame, and what is needed for a mass.
struct Measured {
  Piece piece;
  double volume = 0;
  Vec3 centre{};
};

/// Where a URDF's "package://NAME/REST" or path is. ROS knows where packages are; here one is a directory of that name
/// above the file or beside a directory above it.
fs::path find_mesh(const std::string& urdf, const std::string& name) {
  const fs::path from = fs::absolute(urdf).parent_path();
  const std::string package = "package://", file = "file://";
  if (name.starts_with(file)) return name.substr(file.size());
  if (!name.starts_with(package)) return from / name;
  const fs::path rest = name.substr(package.size());
  const fs::path first = *rest.begin(), tail = rest.lexically_relative(first);
  std::error_code error;
  for (fs::path place = from;; place = place.parent_path()) {
    if (fs::exists(place / rest, error)) return place / rest;
    if (place.filename() == first && fs::exists(place / tail, error)) return place / tail;
    if (place == place.parent_path()) return rest;
  }
}

double positive_size(double size) {
  if (!(size > 0) || !std::isfinite(size)) throw std::runtime_error("a size that is not greater than 0");
  return size;
}

void add_simple(const urdf::Geometry& geometry, const Frame& place, std::vector<Measured>& out) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE: {
      const double r = positive_size(static_cast<const urdf::Sphere&>(geometry).radius);
      out.push_back({{sphere_shape(r), place}, 4.0 / 3 * pi * r * r * r, place.origin});
      break;
    }
    case urdf::Geometry::BOX: {
      const Vec3 size = vector(static_cast<const urdf::Box&>(geometry).dim);
      const double volume = positive_size(size[0]) * positive_size(size[1]) * positive_size(size[2]);
      out.push_back({{box_shape(times(size, 0.5)), place}, volume, place.origin});
      break;
    }
    default: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      const double r = positive_size(cylinder.radius), length = positive_size(cylinder.length);
      out.push_back({{cylinder_shape(r, length), place.place(Frame{{}, y_to_z()})}, pi * r * r * length, place.origin});
    }
  }
}

void add_hull(const Hull& hull, const Frame& place, std::vector<Measured>& out) {
  std::vector<Vec3> points;
  for (const Vec3& p : hull.points) points.push_back(place.place(p));
  out.push_back({{hull_shape(points), {}}, hull.volume, place.place(hull.centroid)});
}

/// A ball that is as hard to turn as the link's inertia says, for a link that has no shape.
Piece stand_in(const urdf::Inertial& inertial) {
  const double mean = (inertial.ixx + inertial.iyy + inertial.izz) / 3;
  const double radius = std::sqrt(2.5 * mean / inertial.mass);
  constexpr double least = 1e-3;
  return {sphere_shape(std::isfinite(radius) ? std::clamp(radius, least, 100.0) : least), {}};
}

}  // namespace

const TriangleMesh& UrdfCollisions::mesh(const urdf::Mesh& mesh) {
  const std::string file = find_mesh(path_, mesh.filename).string();
  const auto key = file + '\n' + std::to_string(mesh.scale.x) + ' ' + std::to_string(mesh.scale.y) + ' ' +
                   std::to_string(mesh.scale.z);
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  return meshes_.emplace(key, read_mesh_unguarded(file, vector(mesh.scale))).first->second;
}

std::vector<Hull> UrdfCollisions::hulls(const urdf::Mesh& description) {
  const TriangleMesh& triangles = mesh(description);
  if (options_.parts) return convex_parts(triangles, *options_.parts).hulls;
  auto hull = convex_hull(triangles.vertices);
  if (!hull) throw std::runtime_error("a flat mesh");
  return {std::move(*hull)};
}

LinkSolid UrdfCollisions::solid(const urdf::Link& link, bool still) try {
  LinkSolid solid;
  const bool only_a_mesh = link.collision_array.size() == 1 && link.collision->geometry &&
                           link.collision->geometry->type == urdf::Geometry::MESH;
  if (still && only_a_mesh) {
    TriangleMesh placed = mesh(static_cast<const urdf::Mesh&>(*link.collision->geometry));
    const Frame place = frame_of(link.collision->origin);
    for (Vec3& v : placed.vertices) v = place.place(v);
    solid.pieces.push_back({mesh_shape(placed), {}});
    return solid;
  }

  std::vector<Measured> measured;
  for (const auto& collision : link.collision_array) {
    if (!collision || !collision->geometry) throw std::runtime_error("a collision element without geometry");
    const Frame place = frame_of(collision->origin);
    if (collision->geometry->type == urdf::Geometry::MESH) {
      for (const Hull& hull : hulls(static_cast<const urdf::Mesh&>(*collision->geometry)))
        add_hull(hull, place, measured);
    } else {
      add_simple(*collision->geometry, place, measured);
    }
  }

  const bool has_mass = link.inertial && link.inertial->mass != 0;
  if (has_mass) {
    solid.mass = positive_size(link.inertial->mass);
    solid.centre = vector(link.inertial->origin.position);
  } else {
    double volume = 0;
    for (const Measured& m : measured) {
      volume += m.volume;
      solid.centre = plus(solid.centre, times(m.centre, m.volume));
    }
    solid.centre = times(solid.centre, 1 / volume);
    if (!options_.density && !still) throw std::runtime_error("no mass, and no density is given");
    solid.mass = options_.density.value_or(0) * volume;
  }
  for (Measured& m : measured) {
    m.piece.place.origin = minus(m.piece.place.origin, solid.centre);
    solid.pieces.push_back(std::move(m.piece));
  }
  solid.touches = !solid.pieces.empty();
  if (!solid.touches) solid.pieces.push_back(stand_in(*link.inertial));
  return solid;
} catch (const std::runtime_error& error) {
  if (dynamic_cast<const scenes::SceneError*>(&error) != nullptr) throw;
  throw std::runtime_error("link \"" + link.name + "\": " + error.what());
}

}  // namespace boxstream::imports
