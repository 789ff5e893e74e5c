// SPDX-License-Identifier: MIT
#include <ode/ode.h>

#include <array>
#include <cmath>

#include "formats/geometry/frame.hpp"
#include "formats/scene_model/expand.hpp"
#include "witnesses/weights.hpp"
#include "witnesses/witness.hpp"

namespace boxstream::witnesses {
namespace {

using scenes::BodyType;
using scenes::Expanded;
using scenes::Vec3;
using Pose = geometry::Frame;

/// ODE's quaternions begin with w.
std::array<dReal, 4> quaternion(const scenes::Quat& q) {
  return {q[3], q[0], q[1], q[2]};
}

Vec3 vector(const dReal* v) {
  return {v[0], v[1], v[2]};
}

class Library {
 public:
  Library() { dInitODE2(0); }
  ~Library() { dCloseODE(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

class OdeWorld {
 public:
  OdeWorld(const scenes::Scene& scene, const OdeSettings& settings)
      : scene_(scene), settings_(settings), expanded_(scenes::expand(scene)) {
    if (!expanded_.joints.empty()) throw Unknown("joints");
    if (!scene.fields.empty() || !scene.soft_bodies.empty() || scene.world.tumbling)
      throw Unknown("fields or soft bodies");
    const Vec3& g = scene.world.gravity;
    dWorldSetGravity(world_, g[0], g[1], g[2]);
    dWorldSetERP(world_, settings.erp);
    dWorldSetCFM(world_, settings.cfm);
    dWorldSetContactSurfaceLayer(world_, 0);
    dWorldSetAutoDisableFlag(world_, 0);
    for (std::size_t i = 0; i < expanded_.bodies.size(); ++i) add(i);
  }
  ~OdeWorld() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void advance() {
    for (int i = 0; i < settings_.substeps; ++i) {
      dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) { static_cast<OdeWorld*>(self)->meet(a, b); });
      dWorldStep(world_, scene_.time.dt / settings_.substeps);
      dJointGroupEmpty(contacts_);
    }
  }

  Frame frame() const {
    Frame frame;
    for (const Dynamic& each : dynamic_) {
      const dReal* const q = dBodyGetQuaternion(each.id);
      const Pose at_centre{vector(dBodyGetPosition(each.id)), {q[1], q[2], q[3], q[0]}};
      const Vec3 velocity = vector(dBodyGetLinearVel(each.id)), spin = vector(dBodyGetAngularVel(each.id));
      const Vec3 origin = at_centre.place(geometry::times(each.weight.centre, -1));
      frame.bodies.push_back({each.body, origin, at_centre.turn, velocity, spin});
      const Vec3 own = Pose{{}, at_centre.turn}.seen({spin, {0, 0, 0, 1}}).origin;
      for (std::size_t row = 0; row < 3; ++row)
        frame.energy += own[row] * geometry::dot(each.weight.inertia[row], own) / 2;
      frame.energy += each.weight.mass *
                      (geometry::dot(velocity, velocity) / 2 - geometry::dot(scene_.world.gravity, at_centre.origin));
    }
    return frame;
  }

 private:
  struct Dynamic {
    std::size_t body;
    dBodyID id;
    Weight weight;
  };

  void add(std::size_t i) {
    const scenes::Body& from = expanded_.bodies[i];
    if (from.traits.type == BodyType::kinematic || from.surface_velocity != Vec3{})
      throw Unknown("a kinematic body or a conveyor");
    if (from.traits.linear_damping != 0 || from.traits.angular_damping != 0) throw Unknown("damping");
    if (from.traits.material.rolling != 0 || from.traits.material.spinning != 0) throw Unknown("friction of rolling");
    const Pose pose{from.position, from.rotation};
    if (from.traits.type == BodyType::fixed) {
      add_geoms(i, from.traits.shape, nullptr, pose);
      return;
    }
    const Weight weight = weight_of(expanded_, from);
    dBodyID body = dBodyCreate(world_);
    dMass mass;
    const geometry::Tensor& t = weight.inertia;
    dMassSetParameters(&mass, weight.mass, 0, 0, 0, t[0][0], t[1][1], t[2][2], t[0][1], t[0][2], t[1][2]);
    dBodySetMass(body, &mass);
    const Vec3 centre = pose.place(weight.centre);
    dBodySetPosition(body, centre[0], centre[1], centre[2]);
    dBodySetQuaternion(body, quaternion(from.rotation).data());
    dBodySetLinearVel(body, from.velocity[0], from.velocity[1], from.velocity[2]);
    dBodySetAngularVel(body, from.spin[0], from.spin[1], from.spin[2]);
    add_geoms(i, from.traits.shape, body, {geometry::times(weight.centre, -1), {0, 0, 0, 1}});
    dynamic_.push_back({i, body, weight});
  }

  /// `pose` is that of the shape in the body, or in the world if there is none.
  void add_geoms(std::size_t i, std::size_t shape, dBodyID body, const Pose& pose) {
    const auto of = [&]<class S>(const S& s) {
      if constexpr (std::is_same_v<S, scenes::BoxShape>) {
        const Vec3 all = geometry::times(s.half_extents, 2);
        put(i, dCreateBox(space_, all[0], all[1], all[2]), body, pose);
      } else if constexpr (std::is_same_v<S, scenes::SphereShape>) {
        put(i, dCreateSphere(space_, s.radius), body, pose);
      } else if constexpr (std::is_same_v<S, scenes::CapsuleShape>) {
        put(i, dCreateCapsule(space_, s.radius, s.height), body, pose.place(z_is_y));
      } else if constexpr (std::is_same_v<S, scenes::CylinderShape>) {
        put(i, dCreateCylinder(space_, s.radius, s.height), body, pose.place(z_is_y));
      } else if constexpr (std::is_same_v<S, scenes::PlaneShape>) {
        if (pose.turn != scenes::Quat{0, 0, 0, 1}) throw Unknown("a plane that is turned");
        const double offset = s.offset + geometry::dot(s.normal, pose.origin);
        const dGeomID plane = dCreatePlane(space_, s.normal[0], s.normal[1], s.normal[2], offset);
        dGeomSetData(plane, &expanded_.bodies[i]);
      } else if constexpr (std::is_same_v<S, scenes::CompoundShape>) {
        for (const scenes::CompoundChild& child : s.children)
          add_geoms(i, child.shape, body, pose.place(Pose{child.position, child.rotation}));
      } else {
        throw Unknown(std::string("a shape of type ") + S::kind);
      }
    };
    std::visit(of, expanded_.shapes[shape].value);
  }

  void put(std::size_t i, dGeomID geom, dBodyID body, const Pose& pose) {
    dGeomSetData(geom, &expanded_.bodies[i]);
    const std::array<dReal, 4> q = quaternion(pose.turn);
    if (body == nullptr) {
      dGeomSetPosition(geom, pose.origin[0], pose.origin[1], pose.origin[2]);
      dGeomSetQuaternion(geom, q.data());
    } else {
      dGeomSetBody(geom, body);
      dGeomSetOffsetPosition(geom, pose.origin[0], pose.origin[1], pose.origin[2]);
      dGeomSetOffsetQuaternion(geom, q.data());
    }
  }

  void meet(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == body_b) return;
    const auto &of_a = *static_cast<const scenes::Body*>(dGeomGetData(a)),
               &of_b = *static_cast<const scenes::Body*>(dGeomGetData(b));
    std::array<dContact, 16> points;
    const int count = dCollide(a, b, static_cast<int>(points.size()), &points[0].geom, sizeof(dContact));
    for (int k = 0; k < count; ++k) {
      dContact& point = points[static_cast<std::size_t>(k)];
      dSurfaceParameters& surface = point.surface;
      surface = {};
      surface.mode = dContactApprox1;
      surface.mu = of_a.traits.material.friction * of_b.traits.material.friction;
      surface.bounce = of_a.traits.material.restitution * of_b.traits.material.restitution;
      surface.bounce_vel = 0.01;
      if (surface.bounce > 0) surface.mode |= dContactBounce;
      if (settings_.along && surface.mu > 0) turn_friction(point, body_a, body_b);
      dJointAttach(dJointCreateContact(world_, contacts_, &point), body_a, body_b);
    }
  }

  static Vec3 velocity_at(dBodyID body, const dReal* point) {
    if (body == nullptr) return {};
    dVector3 v;
    dBodyGetPointVel(body, point[0], point[1], point[2], v);
    return vector(v);
  }

  /// Friction is bounded in a square: one whose side lies along the way bounds a contact that slides as Coulomb's cone
  /// does.
  static void turn_friction(dContact& point, dBodyID a, dBodyID b) {
    const Vec3 normal = vector(point.geom.normal);
    Vec3 way = geometry::minus(velocity_at(a, point.geom.pos), velocity_at(b, point.geom.pos));
    way = geometry::minus(way, geometry::times(normal, geometry::dot(way, normal)));
    const double speed = std::sqrt(geometry::dot(way, way));
    if (speed < 1e-6) return;
    point.surface.mode |= dContactFDir1;
    for (std::size_t axis = 0; axis < 3; ++axis) point.fdir1[axis] = way[axis] / speed;
  }

  static inline const Pose z_is_y{{}, {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}};

  const scenes::Scene& scene_;
  OdeSettings settings_;
  Expanded expanded_;
  Library library_;
  dWorldID world_ = dWorldCreate();
  dSpaceID space_ = dSimpleSpaceCreate(nullptr);
  dJointGroupID contacts_ = dJointGroupCreate(0);
  std::vector<Dynamic> dynamic_;
};

}  // namespace

bool ode_is_built() {
  return true;
}

std::vector<Frame> run_ode(const scenes::Scene& scene, std::size_t steps, const OdeSettings& settings) {
  OdeWorld world(scene, settings);
  std::vector<Frame> frames{world.frame()};
  for (std::size_t step = 0; step < steps; ++step) {
    world.advance();
    frames.push_back(world.frame());
  }
  return frames;
}

}  // namespace boxstream::witnesses
