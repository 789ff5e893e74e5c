// SPDX-License-Identifier: MIT
// What Bullet's importer gives us, of any numbers: shapes taken apart into pieces, constraints made into joints, all
// loaded as a scene or refused with a reason. The importer itself is Bullet's, and runs in a child process.
//
// Input: bodies by a code: f0-ff ends them; else bit 0 says that one stands still, the rest modulo 11 its shape (order
// of `shape`; compounds have up to three children), then the numbers. Then constraints: the two bodies, the kind, two
// frames and limits. Numbers as in bytes.hpp.
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletDynamics/ConstraintSolver/btFixedConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGearConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "finding.hpp"
#include "formats/import/bullet_parts.hpp"
#include "loads_as_scene.hpp"

namespace boxstream::fuzz {
namespace {

constexpr std::size_t most_bodies = 12, most_constraints = 12;

/// Bullet objects in the order in which they are read; constraints go first at the end.
class Maker {
 public:
  explicit Maker(Bytes& in) : in_(in) {}

  btScalar number() { return in_.number<btScalar>(); }
  btVector3 vector() {
    const btScalar x = number(), y = number();
    return {x, y, number()};
  }
  /// Mostly a turn, sometimes what is none.
  btQuaternion turn() {
    const btScalar x = number(), y = number(), z = number();
    btQuaternion turn(x, y, z, number());
    if (in_.below(8) != 0 && turn.length2() > 0) turn.normalize();
    return turn;
  }
  btTransform transform() {
    const btVector3 place = vector();
    return in_.below(2) == 0 ? btTransform(btQuaternion::getIdentity(), place) : btTransform(turn(), place);
  }

  btCollisionShape& shape(unsigned kind, int depth) {
    switch (kind) {
      case 0:
        return keep(std::make_unique<btBoxShape>(vector()));
      case 1:
        return keep(std::make_unique<btSphereShape>(number()));
      case 2:
        return round<btCapsuleShapeX, btCapsuleShape, btCapsuleShapeZ>();
      case 3:
        return round<btConeShapeX, btConeShape, btConeShapeZ>();
      case 4:
        return cylinder();
      case 5:
        return hull();
      case 6:
        return compound(depth);
      case 7: {
        const btVector3 normal = vector();
        return keep(std::make_unique<btStaticPlaneShape>(normal, number()));
      }
      case 8:
        return mesh();
      case 9: {
        btBvhTriangleMeshShape& inner = mesh();
        return keep(std::make_unique<btScaledBvhTriangleMeshShape>(&inner, vector()));
      }
      default:
        return keep(std::make_unique<btBoxShape>(btVector3(1, 1, 1)));
    }
  }

  btRigidBody& body(btCollisionShape& shape) {
    bodies_.push_back(std::make_unique<btRigidBody>(btScalar(1), nullptr, &shape, btVector3(1, 1, 1)));
    bodies_.back()->setWorldTransform(transform());
    return *bodies_.back();
  }

  btTypedConstraint& constraint(btRigidBody& a, btRigidBody& b) {
    const unsigned kind = in_.below(7);
    const btTransform in_a = transform(), in_b = transform();
    switch (kind) {
      case 0:
        return keep(std::make_unique<btPoint2PointConstraint>(a, b, in_a.getOrigin(), in_b.getOrigin()));
      case 1: {
        auto& hinge = keep(std::make_unique<btHingeConstraint>(a, b, in_a, in_b, in_.below(2) == 1));
        const btScalar low = number();
        if (in_.below(2) == 1) hinge.setLimit(low, number());
        return hinge;
      }
      case 2: {
        auto& slider = keep(std::make_unique<btSliderConstraint>(a, b, in_a, in_b, in_.below(2) == 1));
        slider.setLowerLinLimit(number());
        slider.setUpperLinLimit(number());
        slider.setLowerAngLimit(number());
        return slider;
      }
      case 3: {
        auto& cone = keep(std::make_unique<btConeTwistConstraint>(a, b, in_a, in_b));
        const btScalar first = number(), second = number();
        cone.setLimit(first, second, number());
        return cone;
      }
      case 4: {
        auto& free = keep(std::make_unique<btGeneric6DofConstraint>(a, b, in_a, in_b, in_.below(2) == 1));
        set_limits(free);
        return free;
      }
      case 5: {
        auto& spring = keep(std::make_unique<btGeneric6DofSpring2Constraint>(a, b, in_a, in_b));
        set_limits(spring);
        return spring;
      }
      default:
        return keep(std::make_unique<btFixedConstraint>(a, b, in_a, in_b));
    }
  }

 private:
  template <class Kept>
  Kept& keep(std::unique_ptr<Kept> made) {
    Kept& result = *made;
    if constexpr (std::is_base_of_v<btTypedConstraint, Kept>)
      constraints_.push_back(std::move(made));
    else
      shapes_.push_back(std::move(made));
    return result;
  }

  template <class Constraint>
  void set_limits(Constraint& free) {
    free.setLinearLowerLimit(vector());
    free.setLinearUpperLimit(vector());
    free.setAngularLowerLimit(vector());
    free.setAngularUpperLimit(vector());
  }

  template <class X, class Y, class Z>
  btCollisionShape& round() {
    const unsigned axis = in_.below(3);
    const btScalar radius = number(), height = number();
    if (axis == 0) return keep(std::make_unique<X>(radius, height));
    if (axis == 1) return keep(std::make_unique<Y>(radius, height));
    return keep(std::make_unique<Z>(radius, height));
  }
  btCollisionShape& cylinder() {
    const unsigned axis = in_.below(3);
    const btVector3 half = vector();
    if (axis == 0) return keep(std::make_unique<btCylinderShapeX>(half));
    if (axis == 1) return keep(std::make_unique<btCylinderShape>(half));
    return keep(std::make_unique<btCylinderShapeZ>(half));
  }
  btCollisionShape& hull() {
    auto& hull = keep(std::make_unique<btConvexHullShape>());
    for (unsigned left = in_.below(24); left > 0; --left) hull.addPoint(vector(), false);
    return hull;
  }
  btCollisionShape& compound(int depth) {
    auto& compound = keep(std::make_unique<btCompoundShape>(false));
    for (unsigned left = in_.below(4); left > 0; --left) {
      const unsigned kind = in_.below(depth < 3 ? 7 : 6);
      const btTransform place = transform();
      compound.addChildShape(place, &shape(kind, depth + 1));
    }
    return compound;
  }
  btBvhTriangleMeshShape& mesh() {
    meshes_.push_back(std::make_unique<btTriangleMesh>());
    for (unsigned left = 1 + in_.below(12); left > 0; --left) {
      const btVector3 a = vector(), b = vector();
      meshes_.back()->addTriangle(a, b, vector());
    }
    return keep(std::make_unique<btBvhTriangleMeshShape>(meshes_.back().get(), true, false));
  }

  Bytes& in_;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> constraints_;
};

void run(Bytes& in) {
  Maker maker(in);
  imports::Fragment fragment{imports::Frame{}};
  imports::KnownBodies known;
  std::vector<btRigidBody*> bodies;
  while (bodies.size() < most_bodies && !in.empty()) {
    const unsigned code = in.byte();
    if (code >= 0xf0) break;
    btCollisionShape& shape = maker.shape(code / 2 % 11, 0);
    bodies.push_back(&maker.body(shape));
    const bool still = (code & 1) != 0 || shape.isNonMoving();
    imports::BodyNote note;
    note.name = fragment.free_name("body");
    const auto fixed = imports::fixed_shape("/nowhere/fuzz.bullet", shape);
    note.shape = fixed ? fragment.add_shape("", *fixed) : fragment.add_pieces("", imports::convex_pieces(shape));
    note.place = imports::frame_of(bodies.back()->getWorldTransform());
    if (still)
      note.more["type"] = "static";
    else
      note.mass = 1;
    fragment.add_body(note);
    known.emplace(bodies.back(), imports::KnownBody{note.name, still});
  }
  imports::LeftOut left_out;
  for (std::size_t i = 0; i < most_constraints && !in.empty() && !bodies.empty(); ++i) {
    btRigidBody& a = *bodies[in.byte() % bodies.size()];
    btRigidBody& b = *bodies[in.byte() % bodies.size()];
    const bool collide = in.below(2) == 1;
    if (&a != &b) imports::add_constraint(maker.constraint(a, b), collide, known, fragment, left_out);
  }
  bodies_as_scene(fragment);
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  boxstream::fuzz::Bytes in(data, size);
  try {
    boxstream::fuzz::run(in);
  } catch (const std::runtime_error& error) {
    boxstream::fuzz::promise(*error.what() != '\0', "an empty complaint");
  }
  return 0;
}
