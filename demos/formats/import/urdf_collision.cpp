// SPDX-License-Identifier: MIT
#include "formats/import/urdf_collision.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "formats/import/geometry.hpp"
#include "formats/import/urdf_files.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {
namespace {

double positive_size(double size) {
  if (!(size > 0) || !std::isfinite(size)) throw std::runtime_error("a size that is not greater than 0");
  return size;
}

/// What goes wrong in `work` names the link, unless it names a file.
template <class Work>
void named(const urdf::Link& link, Work work) try {
  work();
} catch (const scenes::SceneError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw std::runtime_error("link \"" + link.name + "\": " + error.what());
}

/// A ball that is as hard to turn as the links' inertia says, for links that have no shape.
Piece stand_in(double mass, const std::optional<Vec3>& inertia) {
  const double mean = inertia ? ((*inertia)[0] + (*inertia)[1] + (*inertia)[2]) / 3 : 0;
  const double radius = std::sqrt(2.5 * mean / mass);
  constexpr double least = 1e-3;
  return {sphere_shape(std::isfinite(radius) ? std::clamp(radius, least, 100.0) : least), {}};
}

/// Mass, and how it is spread about the origin of the first link.
struct Weight {
  double mass = 0;
  Vec3 moment{};
  Tensor inertia = no_inertia;

  Vec3 centre() const { return times(moment, 1 / mass); }

  void add(const urdf::Inertial& inertial, const Frame& link) {
    const double m = positive_size(inertial.mass);
    const Frame place = link.place(frame_of(inertial.origin));
    const Tensor own{{{inertial.ixx, inertial.ixy, inertial.ixz},
                      {inertial.ixy, inertial.iyy, inertial.iyz},
                      {inertial.ixz, inertial.iyz, inertial.izz}}};
    mass += m;
    moment = plus(moment, times(place.origin, m));
    inertia = sum(inertia, sum(turned(place.turn, own), of_point(m, place.origin)));
  }

  void add(const Solid& solid, double density) {
    const double m = density * solid.volume;
    mass += m;
    moment = plus(moment, times(solid.centroid, m));
    inertia = sum(inertia, sum(scaled(solid.inertia, density), of_point(m, solid.centroid)));
  }
};

/// None for moments that no body can have, which some files contain.
void put_inertia(const Weight& weight, LinkSolid& solid) {
  const Principal axes = principal(sum(weight.inertia, of_point(-weight.mass, solid.place.origin)));
  const auto& moments = axes.moments;
  const double most = std::max({moments[0], moments[1], moments[2]});
  constexpr double nothing = 1e-9;  // of the largest, which is what rounding may leave
  if (!(std::min({moments[0], moments[1], moments[2]}) > nothing * most)) return;
  solid.inertia = moments;
  solid.place.turn = axes.turn;
}

}  // namespace

/// A piece in the first link's frame, and what is needed for a mass.
struct UrdfCollisions::Measured {
  Measured(Json shape, const Frame& place, const Solid& weighed) : piece{std::move(shape), place}, solid(weighed) {}

  Piece piece;
  Solid solid;
};

const TriangleMesh& UrdfCollisions::mesh(const urdf::Mesh& mesh) {
  const std::string file = find_mesh(path_, mesh.filename, options_.packages, options_.within);
  const std::pair key(file, vector(mesh.scale));
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  return meshes_.emplace(key, read_mesh_unguarded(file, key.second, UpAxis::left_alone)).first->second;
}

std::vector<Hull> UrdfCollisions::hulls(const urdf::Mesh& description) {
  const TriangleMesh& triangles = mesh(description);
  if (options_.parts) return convex_parts(triangles, *options_.parts).hulls;
  auto hull = convex_hull(triangles.vertices);
  if (!hull) throw std::runtime_error("a flat mesh");
  return {std::move(*hull)};
}

void UrdfCollisions::add_mesh(const urdf::Mesh& description, const Frame& place, std::vector<Measured>& out) {
  if (is_capsule(description.filename)) {
    const CapsuleSize size = capsule_size(description.filename);
    const double r = positive_size(size.radius), length = positive_size(size.length);
    const Frame along = place.place(Frame{{}, y_to_z()});
    out.emplace_back(capsule_shape(r, length), along, placed(along, capsule(r, length)));
    return;
  }
  for (const Hull& hull : hulls(description)) {
    std::vector<Vec3> points;
    for (const Vec3& p : hull.points) points.push_back(place.place(p));
    out.emplace_back(hull_shape(points), Frame{}, placed(place, solid_of(hull)));
  }
}

std::vector<UrdfCollisions::Measured> UrdfCollisions::measured(const Member& member) {
  std::vector<Measured> out;
  for (const auto& collision : member.link->collision_array) {
    if (!collision || !collision->geometry) throw std::runtime_error("a collision element without geometry");
    const Frame place = member.frame.place(frame_of(collision->origin));
    switch (collision->geometry->type) {
      case urdf::Geometry::MESH:
        add_mesh(static_cast<const urdf::Mesh&>(*collision->geometry), place, out);
        break;
      case urdf::Geometry::SPHERE: {
        const double r = positive_size(static_cast<const urdf::Sphere&>(*collision->geometry).radius);
        out.emplace_back(sphere_shape(r), place, placed(place, ball(r)));
        break;
      }
      case urdf::Geometry::BOX: {
        const Vec3 size = vector(static_cast<const urdf::Box&>(*collision->geometry).dim);
        for (const double side : size) positive_size(side);
        out.emplace_back(box_shape(times(size, 0.5)), place, placed(place, box(times(size, 0.5))));
        break;
      }
      default: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision->geometry);
        const double r = positive_size(cylinder.radius), length = positive_size(cylinder.length);
        const Frame along = place.place(Frame{{}, y_to_z()});
        out.emplace_back(cylinder_shape(r, length), along, placed(along, geometry::cylinder(r, length)));
      }
    }
  }
  return out;
}

LinkSolid UrdfCollisions::solid(const std::vector<Member>& members) {
  const bool some_have_mass =
      std::any_of(members.begin(), members.end(), [](const Member& member) { return has_mass(*member.link); });
  Weight weight;
  std::vector<Measured> pieces;
  for (const Member& member : members) {
    named(*member.link, [&] {
      std::vector<Measured> own = measured(member);
      if (has_mass(*member.link))
        weight.add(*member.link->inertial, member.frame);
      else if (some_have_mass && options_.density)
        for (const Measured& piece : own) weight.add(piece.solid, *options_.density);
      std::move(own.begin(), own.end(), std::back_inserter(pieces));
    });
  }
  LinkSolid solid;
  if (some_have_mass) {
    solid.mass = weight.mass;
    solid.place.origin = weight.centre();
    put_inertia(weight, solid);
  } else {
    if (!options_.density)
      named(*members[0].link, [] { throw std::runtime_error("no mass, and no density is given"); });
    std::vector<Solid> solids;
    for (const Measured& m : pieces) solids.push_back(m.solid);
    const Solid whole = sum(solids);
    solid.place.origin = whole.centroid;
    solid.mass = *options_.density * whole.volume;
  }
  for (Measured& m : pieces) {
    m.piece.place = solid.place.seen(m.piece.place);
    solid.pieces.push_back(std::move(m.piece));
  }
  solid.touches = !solid.pieces.empty();
  if (!solid.touches) solid.pieces.push_back(stand_in(solid.mass, solid.inertia));
  return solid;
}

LinkSolid UrdfCollisions::still_solid(const urdf::Link& link) {
  LinkSolid solid;
  named(link, [&] {
    const auto& geometry = link.collision->geometry;
    if (link.collision_array.size() == 1 && geometry && geometry->type == urdf::Geometry::MESH &&
        !is_capsule(static_cast<const urdf::Mesh&>(*geometry).filename)) {
      TriangleMesh placed = mesh(static_cast<const urdf::Mesh&>(*geometry));
      const Frame place = frame_of(link.collision->origin);
      for (Vec3& v : placed.vertices) v = place.place(v);
      solid.pieces.push_back({mesh_shape(placed), {}});
    } else {
      for (Measured& m : measured({&link, {}})) solid.pieces.push_back(std::move(m.piece));
      if (solid.pieces.size() == 1) std::swap(solid.place, solid.pieces[0].place);
    }
  });
  return solid;
}

}  // namespace boxstream::imports
