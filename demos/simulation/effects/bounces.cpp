// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "formats/scene_model/names.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"

// Bodies bounce at the moment they touch, one pair after the other, before the solver is called.
//
// Bullet's solver wants all contacts of a step to part with the restitution's share of the speed with which they
// closed, all at once: a row of balls that is hit moves as one, and what is still apart, or already overlaps, parts
// with less or more. Here each contact has the time at which it is touched, within the step or just before it, and the
// speed that it has then. A bounce changes the velocity by `change`, and what the body does from there on is what it
// would have done from the start of the step, `change` faster and displaced by -change * time.
namespace boxstream::effects {
namespace {

using namespace scenes;

/// What bounces have changed of a body in this substep.
struct Displaced {
  btVector3 place{0, 0, 0}, turn{0, 0, 0};
  btScalar last = std::numeric_limits<btScalar>::lowest();  ///< when it bounced last, in seconds from the step's start
};

/// How a body answers to an impulse: as a free one, or as one that a ball joint holds at what does not move, which
/// turns about that point. Left to the solver, the joint would take some of each bounce away.
struct Answer {
  btScalar inverse_mass = 0;
  btMatrix3x3 inverse_moments{0, 0, 0, 0, 0, 0, 0, 0, 0};
  btVector3 from_pivot{0, 0, 0};  ///< to the centre of mass; zero: it is free
  bool is_held = false;
};

/// Two bodies that touch or are about to.
struct Meeting {
  btRigidBody *a, *b;
  btPersistentManifold* manifold;
  btVector3 arm_a, arm_b;  ///< from the centres of mass to the contact
  btVector3 normal;        ///< from b to a
  btScalar gap;
  btScalar restitution, friction;
  btScalar radii;  ///< of two balls together, else 0: the normal turns while they come closer
};

/// When a meeting bounces, and how fast it closes then.
struct Bounce {
  btScalar time, speed;
  btVector3 normal, arm_a, arm_b;
};

class Bouncer {
 public:
  /// Joints are there already.
  explicit Bouncer(SceneInstance& instance) : instance_(instance) {
    for (const auto& joint : instance.joints) {
      const btRigidBody &a = joint->getRigidBodyA(), &b = joint->getRigidBodyB();
      const bool holds =
          joint->getConstraintType() == POINT2POINT_CONSTRAINT_TYPE && (a.isStaticObject() || b.isStaticObject());
      for (const btRigidBody* const body : {&a, &b}) {
        const auto [at, is_first] = held_.try_emplace(body);
        at->second = is_first && holds ? static_cast<const btPoint2PointConstraint*>(joint.get()) : nullptr;
      }
    }
  }

  /// Before the solver, when contacts are known.
  void bounce(btScalar dt) {
    dt_ = dt;
    collect();
    // Of a heap of bodies that bounce again and again, the solver takes what is left.
    constexpr std::size_t most_bounces_of_a_meeting = 50;
    std::size_t left = most_bounces_of_a_meeting * meetings_.size();
    while (left > 0) {
      const std::vector<std::size_t> first = earliest();
      if (first.empty()) break;
      left -= std::min(left, first.size());
      collide(first);
      instance_.bounced += first.size();
      for (const std::size_t of : first)
        for (btRigidBody* const body : {meetings_[of].a, meetings_[of].b})
          if (body->getInvMass() > 0)
            for (const std::size_t i : meetings_of_[body]) bounces_[i] = bounce_of(meetings_[i]);
    }
  }

  /// When bodies have moved.
  void displace() {
    for (auto& [body, displaced] : displaced_) {
      btTransform place = body->getWorldTransform();
      place.getOrigin() += displaced.place;
      if (const btScalar angle = displaced.turn.length(); angle > 0)
        place.setRotation(btQuaternion(displaced.turn / angle, angle) * place.getRotation());
      body->setCenterOfMassTransform(place);
    }
    displaced_.clear();
  }

 private:
  void collect() {
    meetings_.clear();
    for (auto& [body, meetings] : meetings_of_) meetings.clear();
    answers_.clear();
    btDispatcher& dispatcher = instance_.world.dispatcher();
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      // Bullet's const accessors give objects that its own solver changes as well.
      auto* const a = btRigidBody::upcast(const_cast<btCollisionObject*>(manifold.getBody0()));
      auto* const b = btRigidBody::upcast(const_cast<btCollisionObject*>(manifold.getBody1()));
      if (a == nullptr || b == nullptr || manifold.getNumContacts() == 0) continue;
      const btScalar restitution = a->getRestitution() * b->getRestitution();
      if (restitution == 0) continue;
      for (int k = 0; k < manifold.getNumContacts(); ++k) manifold.getContactPoint(k).m_combinedRestitution = 0;
      if ((!a->isActive() && !b->isActive()) || a->getInvMass() + b->getInvMass() == 0) continue;
      meetings_.push_back(meeting_of(manifold, *a, *b, restitution));
    }
    bounces_.clear();
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      meetings_of_[meetings_[i].a].push_back(i);
      meetings_of_[meetings_[i].b].push_back(i);
    }
    for (const Meeting& meeting : meetings_) bounces_.push_back(bounce_of(meeting));
  }

  /// Points that are reached with the first one bounce as one, in their middle: a box that lands flat does not turn.
  Meeting meeting_of(btPersistentManifold& manifold, btRigidBody& a, btRigidBody& b, btScalar restitution) const {
    int first = 0;
    for (int k = 1; k < manifold.getNumContacts(); ++k)
      if (manifold.getContactPoint(k).getDistance() < manifold.getContactPoint(first).getDistance()) first = k;
    const btManifoldPoint& nearest = manifold.getContactPoint(first);
    const btVector3 normal = nearest.m_normalWorldOnB;
    const btScalar closing = btFabs((a.getLinearVelocity() - b.getLinearVelocity()).dot(normal)) * dt_;
    btVector3 middle(0, 0, 0);
    btScalar count = 0;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.getDistance() > nearest.getDistance() + closing / 20) continue;
      middle += (point.getPositionWorldOnA() + point.getPositionWorldOnB()) / 2;
      ++count;
    }
    middle /= count;
    const bool balls = a.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE &&
                       b.getCollisionShape()->getShapeType() == SPHERE_SHAPE_PROXYTYPE;
    const auto radius = [](const btRigidBody& body) {
      return static_cast<const btSphereShape*>(body.getCollisionShape())->getRadius();
    };
    return {&a,
            &b,
            &manifold,
            middle - a.getCenterOfMassPosition(),
            middle - b.getCenterOfMassPosition(),
            normal,
            nearest.getDistance(),
            restitution,
            a.getFriction() * b.getFriction(),
            balls ? radius(a) + radius(b) : 0};
  }

  static btVector3 acceleration(const btRigidBody& body) { return body.getTotalForce() * body.getInvMass(); }

  /// As it is in the middle of the step: Bullet adds what forces do in all of it, and moves bodies by that.
  btVector3 velocity(const btRigidBody& body, const btVector3& arm) const {
    return body.getLinearVelocity() + acceleration(body) * dt_ + body.getAngularVelocity().cross(arm);
  }

  /// How fast its surface moves in addition, if it is a conveyor: of that the body itself knows nothing.
  btVector3 surface(const btRigidBody& body) const {
    const btVector3* const found = surface_velocity(instance_.world.solver().conveyors(), body);
    return found == nullptr ? btVector3(0, 0, 0) : *found;
  }

  btVector3 displacement(const btRigidBody& body, const btVector3& arm) const {
    const auto found = displaced_.find(const_cast<btRigidBody*>(&body));
    return found == displaced_.end() ? btVector3(0, 0, 0) : found->second.place + found->second.turn.cross(arm);
  }
  btScalar last_of(btRigidBody& body) const {
    const auto found = displaced_.find(&body);
    return found == displaced_.end() ? std::numeric_limits<btScalar>::lowest() : found->second.last;
  }

  /// None: it does not touch in this step, or so slowly that it rests.
  std::optional<Bounce> bounce_of(const Meeting& m) const {
    btVector3 normal = m.normal, arm_a = m.arm_a, arm_b = m.arm_b;
    btScalar gap = m.gap + (displacement(*m.a, arm_a) - displacement(*m.b, arm_b)).dot(normal);
    if (m.radii > 0) {
      const btVector3 apart = place(*m.a) - place(*m.b);
      const btVector3 between = touching_balls(apart, velocity(*m.a, {0, 0, 0}) - velocity(*m.b, {0, 0, 0}), m.radii);
      const btScalar size = between.length();
      if (size > 0) {
        normal = between / size;
        // The plane that touches both then, as far off as it is now.
        gap = apart.dot(normal) - m.radii;
        arm_a = normal * -arm_a.length();
        arm_b = normal * arm_b.length();
      }
    }
    const btScalar pull = (acceleration(*m.a) - acceleration(*m.b)).dot(normal);
    const btScalar speed = (velocity(*m.a, arm_a) - velocity(*m.b, arm_b)).dot(normal) - pull * dt_ / 2;
    // gap + speed t + pull t^2 / 2 = 0, where it closes: the root at which the speed is negative.
    const btScalar square = speed * speed - 2 * pull * gap;
    if (square <= 0) return std::nullopt;
    const btScalar closing = btSqrt(square);
    // The form that keeps more digits.
    btScalar time = speed < 0 ? 2 * gap / (closing - speed) : (pull < 0 ? (-closing - speed) / pull : 2 * dt_);
    time = std::max({time, -dt_, last_of(*m.a), last_of(*m.b)});
    if (time > dt_) return std::nullopt;
    // What is lifted no higher than it falls in a step rests.
    const btScalar at_time = speed + pull * time;
    const btScalar rest = 2 * btFabs(pull) * dt_;
    if (at_time >= -rest || at_time >= 0) return std::nullopt;
    return Bounce{time, at_time, normal, arm_a, arm_b};
  }

  btVector3 place(const btRigidBody& body) const {
    return body.getCenterOfMassPosition() + displacement(body, {0, 0, 0});
  }

  /// From one ball to the other when they touch; zero: they pass each other by.
  static btVector3 touching_balls(const btVector3& apart, const btVector3& velocity, btScalar radii) {
    const btScalar fast = velocity.length2(), closing = apart.dot(velocity);
    const btScalar square = closing * closing - fast * (apart.length2() - radii * radii);
    if (closing >= 0 || square < 0) return {0, 0, 0};
    return apart + velocity * ((-closing - btSqrt(square)) / fast);
  }

  /// Meetings that bounce first, at one time: they share what they do.
  std::vector<std::size_t> earliest() const {
    std::vector<std::size_t> first;
    btScalar time = dt_;
    for (const auto& bounce : bounces_)
      if (bounce) time = std::min(time, bounce->time);
    for (std::size_t i = 0; i < meetings_.size(); ++i)
      if (bounces_[i] && bounces_[i]->time <= time + dt_ / 1000) first.push_back(i);
    return first;
  }

  /// Found when it is asked for first in a substep.
  const Answer& answer_of(btRigidBody& body) {
    const auto [at, is_new] = answers_.try_emplace(&body);
    Answer& answer = at->second;
    if (!is_new || body.getInvMass() == 0) return answer;
    answer.inverse_mass = body.getInvMass();
    answer.inverse_moments = body.getInvInertiaTensorWorld();
    const auto held = held_.find(&body);
    if (held == held_.end() || held->second == nullptr) return answer;
    answer.is_held = true;
    const bool is_first = &held->second->getRigidBodyA() == &body;
    const btVector3 pivot =
        body.getCenterOfMassTransform() * (is_first ? held->second->getPivotInA() : held->second->getPivotInB());
    const btVector3 r = body.getCenterOfMassPosition() - pivot;
    const btScalar mass = 1 / body.getInvMass(), square = r.length2();
    const btMatrix3x3 about(square - r.x() * r.x(), -r.x() * r.y(), -r.x() * r.z(), -r.y() * r.x(),
                            square - r.y() * r.y(), -r.y() * r.z(), -r.z() * r.x(), -r.z() * r.y(),
                            square - r.z() * r.z());
    answer.inverse_moments = (answer.inverse_moments.inverse() + about * mass).inverse();
    answer.from_pivot = r;
    return answer;
  }

  struct Change {
    btVector3 velocity, spin;
  };
  Change change_by(btRigidBody& body, const btVector3& arm, const btVector3& impulse) {
    const Answer& answer = answer_of(body);
    const btVector3 spin = answer.inverse_moments * (answer.from_pivot + arm).cross(impulse);
    return {answer.is_held ? spin.cross(answer.from_pivot) : impulse * answer.inverse_mass, spin};
  }

  /// What an impulse of 1 N s does to the velocity along its direction.
  btScalar give(const Meeting& m, const Bounce& bounce, const btVector3& direction) {
    const auto of = [&](btRigidBody& body, const btVector3& arm) {
      const Change change = change_by(body, arm, direction);
      return (change.velocity + change.spin.cross(arm)).dot(direction);
    };
    return of(*m.a, bounce.arm_a) + of(*m.b, bounce.arm_b);
  }

  void push(btRigidBody& body, const btVector3& arm, const btVector3& impulse, btScalar time) {
    if (body.getInvMass() == 0) return;
    instance_.acting_on(body);
    const auto [change, turn] = change_by(body, arm, impulse);
    body.setLinearVelocity(body.getLinearVelocity() + change);
    body.setAngularVelocity(body.getAngularVelocity() + turn);
    body.activate();
    Displaced& displaced = displaced_[&body];
    displaced.place -= change * time;
    displaced.turn -= turn * time;
    displaced.last = time;
  }
  void push(const Meeting& m, const Bounce& bounce, const btVector3& impulse) {
    push(*m.a, bounce.arm_a, impulse, bounce.time);
    push(*m.b, bounce.arm_b, -impulse, bounce.time);
  }

  /// Meetings of one time part with what the restitution says of each; where they share a body, by going through them
  /// until that is so.
  void collide(const std::vector<std::size_t>& together) {
    constexpr int most_rounds = 50;
    std::vector<Bounce> bounces;
    std::vector<btScalar> impulses(together.size()), closing(together.size());
    for (const std::size_t i : together) bounces.push_back(*bounces_[i]);
    const auto speed = [&](std::size_t k) {
      const Meeting& m = meetings_[together[k]];
      return (velocity(*m.a, bounces[k].arm_a) - velocity(*m.b, bounces[k].arm_b)).dot(bounces[k].normal);
    };
    // Of velocities in the middle of the step, of which all that follows changes both alike.
    for (std::size_t k = 0; k < together.size(); ++k) closing[k] = speed(k) - bounces[k].speed;
    for (int round = 0; round < most_rounds; ++round) {
      btScalar most = 0;
      for (std::size_t k = 0; k < together.size(); ++k) {
        const Meeting& m = meetings_[together[k]];
        const btScalar wanted = -m.restitution * bounces[k].speed + closing[k];
        const btScalar all = impulses[k] + (wanted - speed(k)) / give(m, bounces[k], bounces[k].normal);
        const btScalar more = std::max(all, btScalar(0)) - impulses[k];
        impulses[k] += more;
        push(m, bounces[k], bounces[k].normal * more);
        most = std::max(most, btFabs(more) / std::max(impulses[k], SIMD_EPSILON));
      }
      if (together.size() == 1 || most < btScalar(1e-6)) break;
    }
    for (std::size_t k = 0; k < together.size(); ++k) rub(meetings_[together[k]], bounces[k], impulses[k]);
  }

  void rub(const Meeting& m, const Bounce& bounce, btScalar along) {
    if (m.friction > 0) {
      const btVector3 belts = surface(*m.a) - surface(*m.b);
      const btVector3 all = velocity(*m.a, bounce.arm_a) - velocity(*m.b, bounce.arm_b) + belts;
      const btVector3 across = all - bounce.normal * all.dot(bounce.normal);
      if (const btScalar sliding = across.length(); sliding > SIMD_EPSILON) {
        const btVector3 direction = across / sliding;
        const btVector3 impulse = direction * -std::min(m.friction * along, sliding / give(m, bounce, direction));
        push(m, bounce, impulse);
        instance_.world.solver().add_work_of_surfaces(-double{impulse.dot(belts)});
      }
    }
    // The solver has nothing to push out of each other here: the overlap goes with the displacement.
    for (int k = 0; k < m.manifold->getNumContacts(); ++k) {
      btManifoldPoint& point = m.manifold->getContactPoint(k);
      point.setDistance(std::max(point.getDistance(), btScalar(0)));
    }
  }

  SceneInstance& instance_;
  btScalar dt_ = 0;
  std::vector<Meeting> meetings_;
  std::vector<std::optional<Bounce>> bounces_;
  std::unordered_map<const btRigidBody*, std::vector<std::size_t>> meetings_of_;
  std::unordered_map<btRigidBody*, Displaced> displaced_;
  std::unordered_map<const btRigidBody*, Answer> answers_;
  std::unordered_map<const btRigidBody*, const btPoint2PointConstraint*> held_;  // null: by more than one joint
};

std::optional<Call> calls_for_bounces(const Subject& subject) {
  if (subject.scene.solver.bounces == Bounces::in_solver || !restitution.called_for(subject)) return std::nullopt;
  return Call{"/solver/bounces", bounces_names().at(static_cast<std::size_t>(subject.scene.solver.bounces))};
}

void start_bounces(SceneInstance& instance) {
  if (instance.scene.solver.bounces == Bounces::in_solver) return;
  const auto bouncer = std::make_shared<Bouncer>(instance);
  instance.before_solver(bounces_on_contact, [bouncer](double dt) { bouncer->bounce(static_cast<btScalar>(dt)); });
  instance.after_motion(bounces_on_contact, [bouncer](double) { bouncer->displace(); });
}

}  // namespace

const Effect bounces_on_contact{
    "bounces_on_contact",
    "bodies bounce at the moment they touch, one pair after the other",
    "impulses of contacts that close, before the solver is called",
    calls_for_bounces,
    {.start = start_bounces},
    {"bounces", [](const SceneInstance& instance) { return instance.bounced; }, Effect::Activity::of_run}};

}  // namespace boxstream::effects
