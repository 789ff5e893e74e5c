// SPDX-License-Identifier: MIT
#include "pictures/viewer/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include "simulation/engine/convert.hpp"

namespace boxstream::view {
namespace {

using scenes::Drawable;
using Kind = Drawable::Kind;

// Forms are distinguished at this resolution, relative to their size: copies that were scaled differ in their last
// bits.
constexpr float form_resolution = 1e-5F;
// A rotation this near to none comes from rounding.
constexpr float rotation_noise = 1e-5F;

void append(std::string& key, std::int64_t value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::int64_t coarse(float value) {
  return std::llround(value / form_resolution);
}

std::string key_of(const Form& form) {
  std::string key;
  append(key, static_cast<std::int64_t>(form.kind));
  append(key, coarse(form.ratio));
  for (const Point& p : form.vertices)
    for (const float x : p) append(key, coarse(x));
  for (const Triangle& t : form.triangles)
    for (const std::uint32_t corner : t) append(key, corner);
  return key;
}

float largest_coordinate(const Drawable& d) {
  float largest = 0;
  for (const Point& p : d.vertices)
    for (const float x : p) largest = std::max(largest, std::fabs(x));
  return largest > 0 ? largest : 1;
}

/// Turns y onto the unit vector `normal`.
btMatrix3x3 upright(const btVector3& normal) {
  const btVector3 side =
      normal.cross(std::fabs(normal.x()) < 0.7F ? btVector3(1, 0, 0) : btVector3(0, 1, 0)).normalized();
  const btVector3 front = side.cross(normal);
  return btMatrix3x3(side.x(), normal.x(), front.x(), side.y(), normal.y(), front.y(), side.z(), normal.z(), front.z());
}

btTransform transform_of(const Drawable& d) {
  const auto& r = d.rotation;
  const btVector3 origin(d.position[0], d.position[1], d.position[2]);
  if (d.kind == Kind::plane)
    return btTransform(upright(btVector3(d.size[0], d.size[1], d.size[2]).normalized()), origin);
  return btTransform(btMatrix3x3(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]), origin);
}

class Builder {
 public:
  Builder(const scenes::Simulation& simulation, Kept kept) : simulation_(simulation) {
    simulation.for_each_wheel([this](const btTransform& place, float) { wheels_.push_back(place); });
    model_.wheels = wheels_.size();
    model_.states.resize(kept.objects.size() + model_.wheels);
    model_.kept = std::move(kept);
  }

  void add(const Drawable& d) {
    const std::uint32_t place = place_of(d.object);
    if (place == Kept::none) return;
    model_.states[place] = d.state;
    if (d.state == Drawable::State::soft) return add_soft(d, place);
    Part part;
    part.object = place;
    part.form = form_of(d, part.scale);
    const btTransform local = pose_of(d.object).inverseTimes(transform_of(d));
    const btQuaternion turn = local.getRotation().normalized();
    if (std::fabs(turn.w()) < 1 - rotation_noise ||
        turn.length2() - turn.w() * turn.w() > rotation_noise * rotation_noise)
      part.rotation = scenes::plain(turn);
    part.position = scenes::plain(local.getOrigin());
    model_.parts.push_back(part);
  }

  Model take() { return std::move(model_); }

 private:
  btTransform pose_of(std::uint32_t object) const {
    const std::size_t objects = simulation_.objects().size();
    return object < objects ? simulation_.pose(object) : wheels_[object - objects];
  }

  /// Wheels follow the objects.
  std::uint32_t place_of(std::uint32_t object) const {
    const Kept& kept = model_.kept;
    if (object < kept.in_world) return kept.place_of(object);
    return static_cast<std::uint32_t>(kept.objects.size() + object - kept.in_world);
  }

  void add_soft(const Drawable& d, std::uint32_t place) {
    const auto count = static_cast<std::uint32_t>(d.vertices.size());
    model_.soft_parts.push_back({place, nodes_, count, {d.triangles.begin(), d.triangles.end()}});
    nodes_ += count;
  }

  std::uint32_t form_of(const Drawable& d, Point& scale) {
    // Shapes that share their vertices share their form, and these are not compared again.
    if (d.kind == Kind::triangles) {
      const auto known = by_vertices_.find(d.vertices.data());
      if (known != by_vertices_.end()) {
        scale = {known->second.scale, known->second.scale, known->second.scale};
        return known->second.form;
      }
    }
    Form form;
    form.kind = d.kind;
    switch (d.kind) {
      case Kind::box:
        scale = d.size;
        break;
      case Kind::sphere:
      case Kind::capsule:
        scale = {d.size[0], d.size[0], d.size[0]};
        if (d.kind == Kind::capsule) form.ratio = d.size[1] / d.size[0];
        break;
      case Kind::cylinder:
      case Kind::cone:
        scale = {d.size[0], d.size[1], d.size[0]};
        break;
      case Kind::plane:
        break;
      case Kind::triangles: {
        const float size = largest_coordinate(d);
        scale = {size, size, size};
        for (const Point& p : d.vertices) form.vertices.push_back({p[0] / size, p[1] / size, p[2] / size});
        form.triangles.assign(d.triangles.begin(), d.triangles.end());
        break;
      }
    }
    const auto [known, is_new] = by_key_.emplace(key_of(form), static_cast<std::uint32_t>(model_.forms.size()));
    if (is_new) model_.forms.push_back(std::move(form));
    if (d.kind == Kind::triangles) by_vertices_[d.vertices.data()] = {known->second, scale[0]};
    return known->second;
  }

  struct Scaled {
    std::uint32_t form;
    float scale;
  };

  const scenes::Simulation& simulation_;
  std::vector<btTransform> wheels_;
  Model model_;
  std::map<std::string, std::uint32_t> by_key_;
  std::map<const Point*, Scaled> by_vertices_;
  std::uint32_t nodes_ = 0;
};

}  // namespace

Model model_of(const scenes::Simulation& simulation, Kept kept) {
  Builder builder(simulation, std::move(kept));
  simulation.for_each_drawable([&](const Drawable& d) { builder.add(d); });
  return builder.take();
}

Model model_of(const scenes::Simulation& simulation) {
  return model_of(simulation, keep_all(simulation));
}

}  // namespace boxstream::view
