// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <fmt/format.h>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// Most effects are called for by the first element of some kind: these find it.

inline bool is_dynamic(const scenes::Body& body) {
  return body.traits.type == scenes::BodyType::dynamic;
}

inline bool has_dynamic(const Subject& subject) {
  return std::any_of(subject.expanded.bodies.begin(), subject.expanded.bodies.end(), is_dynamic);
}

/// The first body of which `reason(index)` is not empty.
template <class Reason>
std::optional<Call> first_body_at(const Subject& subject, Reason reason) {
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i)
    if (std::string text = reason(i); !text.empty())
      return Call{scenes::pointer_of_body(subject.expanded, i), std::move(text)};
  return std::nullopt;
}

/// The first body of which `reason(body)` is not empty.
template <class Reason>
std::optional<Call> first_body(const Subject& subject, Reason reason) {
  return first_body_at(subject, [&](std::size_t i) -> std::string { return reason(subject.expanded.bodies[i]); });
}

/// The first body with `one(body)` that can touch another with `other(body)`, for which `reason(body)` says so.
template <class One, class Other, class Reason>
std::optional<Call> first_meeting(const Subject& subject, One one, Other other, Reason reason) {
  const std::optional<std::size_t> body = subject.collidable.first(one, other);
  if (!body) return std::nullopt;
  return Call{scenes::pointer_of_body(subject.expanded, *body), reason(subject.expanded.bodies[*body])};
}

/// Whether a body is dynamic and can touch a character. Bullet's characters are solved as bodies that nothing moves,
/// with a friction that no scene sets.
inline bool meets_character(const Subject& subject, std::size_t body) {
  return !subject.scene.characters.empty() && is_dynamic(subject.expanded.bodies[body]) &&
         subject.collidable.meets_other(body, btBroadphaseProxy::CharacterFilter,
                                        static_cast<std::uint32_t>(btBroadphaseProxy::AllFilter));
}

/// Whether the solver can have a contact.
inline bool has_contacts(const Subject& subject) {
  const auto any = [](const scenes::Body&) { return true; };
  if (subject.collidable.first(is_dynamic, any)) return true;
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i)
    if (meets_character(subject, i)) return true;
  return false;
}

/// In m/s^2; of tumbling gravity as well.
inline double strength_of_gravity(const scenes::WorldSettings& world) {
  return world.tumbling ? world.tumbling->strength : std::hypot(world.gravity[0], world.gravity[1], world.gravity[2]);
}

/// The first joint of which `reason(joint)` is not empty.
template <class Reason>
std::optional<Call> first_joint(const Subject& subject, Reason reason) {
  const std::vector<scenes::Joint>& list = subject.expanded.joints;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (std::string text = reason(list[i]); !text.empty())
      return Call{scenes::pointer_of_joint(subject.expanded, i), std::move(text)};
  return std::nullopt;
}

/// Whether a joint moves bodies by itself, as slowly as it likes: a spring, or a motor that turns or pushes.
inline bool drives(const scenes::Joint& joint) {
  const auto has_motor = [](const auto& value) {
    if constexpr (requires { value.motor; })
      return value.motor && value.motor->acts() && value.motor->speed != 0;
    else
      return false;
  };
  return std::holds_alternative<scenes::SpringJoint>(joint.value) || std::visit(has_motor, joint.value);
}

/// The first element of a block, if it has any.
template <class T>
std::optional<Call> first_of(const std::vector<T>& block, const char* pointer, const char* reason) {
  if (block.empty()) return std::nullopt;
  return Call{std::string(pointer) + "/0", reason};
}

/// The first element of a block of variants that is a T.
template <class T, class Variant>
std::optional<Call> first_kind(const std::vector<Variant>& block, const char* pointer, const char* reason) {
  for (std::size_t i = 0; i < block.size(); ++i)
    if (std::holds_alternative<T>(block[i])) return Call{std::string(pointer) + "/" + std::to_string(i), reason};
  return std::nullopt;
}

/// The first body whose shape is a T.
template <class T>
std::optional<Call> first_shape(const Subject& subject, const char* reason) {
  return first_body(subject, [&](const scenes::Body& body) -> std::string {
    return std::holds_alternative<T>(subject.expanded.shapes[body.traits.shape].value) ? reason : "";
  });
}

}  // namespace boxstream::effects
