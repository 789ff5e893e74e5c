// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/unit_contacts.hpp"

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/engine/world_recipe.hpp"

// Bodies that are so small that what Bullet has in metres matters.
namespace boxstream::effects {
namespace {

using namespace scenes;

bool is_small(const Subject& subject, const Body& body) {
  return is_dynamic(body) && size_of(subject.expanded.shapes, body.traits.shape).is_small();
}

std::optional<Call> calls_for_unit_contacts(const Subject& subject) {
  const auto any = [](const Body&) { return true; };
  const auto small = [&](const Body& body) { return is_small(subject, body); };
  const auto reason = [&](const Body& body) {
    const ShapeSize size = size_of(subject.expanded.shapes, body.traits.shape);
    return fmt::format("{:.3g} m large, {:.3g} m are enough for contacts in metres", size.largest, size.enough);
  };
  if (auto call = first_meeting(subject, small, any, reason)) return call;
  return first_body_at(subject, [&](std::size_t i) -> std::string {
    const Body& body = subject.expanded.bodies[i];
    return small(body) && meets_character(subject, i) ? reason(body) : "";
  });
}

void prepare_unit_contacts(const Subject&, WorldRecipe& recipe) {
  recipe.unit_contacts = true;
}

void configure_unit_contacts(const Subject& subject, const Body& description, btRigidBody& body) {
  if (is_small(subject, description)) UnitContacts::mark(body);
}

std::uint64_t count_unit_contacts(const SceneInstance& instance) {
  return count_points(instance, [](const btManifoldPoint&, const btCollisionObject& a, const btCollisionObject& b) {
    return UnitContacts::is_marked(a) || UnitContacts::is_marked(b);
  });
}

}  // namespace

const Effect unit_contacts{"unit_contacts",
                           "small bodies touch as large ones do",
                           "contacts of them are found in units of their own size, all points of a face at once",
                           calls_for_unit_contacts,
                           {.prepare = prepare_unit_contacts, .configure_body = configure_unit_contacts},
                           {"contact points", count_unit_contacts}};

}  // namespace boxstream::effects
