// SPDX-License-Identifier: MIT
#include <BulletSoftBody/btSoftBody.h>

#include "simulation/engine/convert.hpp"
#include "simulation/run/simulation_parts.hpp"

namespace boxstream::scenes {
namespace {

/// Rays have no width; this much of their radius is drawn.
constexpr float tyre_width = 0.6F;

Drawable::State state_of(const btRigidBody& body) {
  if (body.isStaticObject()) return Drawable::State::fixed;
  if (body.isKinematicObject()) return Drawable::State::kinematic;
  return body.isActive() ? Drawable::State::moving : Drawable::State::sleeping;
}

/// `drawable`, given in the coordinates of an object, in those of the world.
void place(Drawable& drawable, const btTransform& object) {
  const auto& r = drawable.rotation;
  const btMatrix3x3 local(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]);
  const btMatrix3x3 world = object.getBasis() * local;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      drawable.rotation[static_cast<std::size_t>(3 * row + column)] = world[row][column];
  const auto& p = drawable.position;
  drawable.position = plain(object * btVector3(p[0], p[1], p[2]));
  if (drawable.kind == Drawable::Kind::plane)
    drawable.size = plain(object.getBasis() * btVector3(drawable.size[0], drawable.size[1], drawable.size[2]));
}

}  // namespace

void Simulation::for_each_drawable(FunctionRef<void(const Drawable&)> visit) const {
  const effects::SceneInstance& instance = impl_->instance;
  std::uint32_t object = 0;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i, ++object) {
    for (Drawable drawable : instance.built(i).drawables) {
      drawable.state = state_of(*instance.bodies[i]);
      drawable.object = object;
      place(drawable, instance.described(i));
      visit(drawable);
    }
  }
  for (const auto& sensor : instance.sensors) {
    Drawable drawable;
    drawable.kind = Drawable::Kind::box;
    drawable.state = Drawable::State::sensor;
    drawable.object = object++;
    drawable.size = plain(static_cast<const btBoxShape*>(sensor->getCollisionShape())->getHalfExtentsWithMargin());
    place(drawable, sensor->getWorldTransform());
    visit(drawable);
  }
  for (const effects::Walker& walker : instance.walkers) {
    const auto& capsule = static_cast<const btCapsuleShape&>(*walker.ghost().getCollisionShape());
    Drawable drawable;
    drawable.kind = Drawable::Kind::capsule;
    drawable.state = Drawable::State::character;
    drawable.object = object++;
    drawable.size = {static_cast<float>(capsule.getRadius()), static_cast<float>(capsule.getHalfHeight()), 0};
    place(drawable, walker.ghost().getWorldTransform());
    visit(drawable);
  }
  for (const auto& soft : instance.soft_bodies) {
    auto& vertices = impl_->soft_vertices;
    auto& triangles = impl_->soft_triangles;
    vertices.clear();
    triangles.clear();
    for (int i = 0; i < soft->m_nodes.size(); ++i) vertices.push_back(plain(soft->m_nodes[i].m_x));
    for (int i = 0; i < soft->m_faces.size(); ++i) {
      const auto corner = [&](int c) {
        return static_cast<std::uint32_t>(soft->m_faces[i].m_n[c] - &soft->m_nodes[0]);
      };
      triangles.push_back({corner(0), corner(1), corner(2)});
    }
    Drawable drawable;
    drawable.kind = Drawable::Kind::triangles;
    drawable.state = Drawable::State::soft;
    drawable.object = object++;
    drawable.vertices = vertices;
    drawable.triangles = triangles;
    visit(drawable);
  }
  for_each_wheel([&](const btTransform& at, float radius) {
    Drawable drawable;
    drawable.kind = Drawable::Kind::cylinder;
    drawable.state = Drawable::State::wheel;
    drawable.object = object++;
    drawable.size = {radius, tyre_width / 2 * radius, 0};
    drawable.rotation = {0, 1, 0, -1, 0, 0, 0, 0, 1};  // y, which cylinders are along, to x
    place(drawable, at);
    visit(drawable);
  });
}

void Simulation::for_each_wheel(FunctionRef<void(const btTransform&, float)> visit) const {
  for (const effects::Car& car : impl_->instance.cars)
    for (int i = 0; i < car.vehicle->getNumWheels(); ++i) {
      const btWheelInfo& wheel = car.vehicle->getWheelInfo(i);
      visit(wheel.m_worldTransform, static_cast<float>(wheel.m_wheelsRadius));
    }
}

}  // namespace boxstream::scenes
