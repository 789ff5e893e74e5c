// SPDX-License-Identifier: MIT
#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>
#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

bool has_it(const Subject& subject, const Body& body) {
  const auto* const mesh = std::get_if<MeshShape>(&subject.expanded.shapes[body.traits.shape].value);
  return mesh != nullptr && mesh->internal_edges;
}

std::optional<Call> calls_for_internal_edges(const Subject& subject) {
  return first_body(subject,
                    [&](const Body& body) -> std::string { return has_it(subject, body) ? "a mesh with it" : ""; });
}

bool adjust(btManifoldPoint& point, const btCollisionObjectWrapper* a, int part_a, int index_a,
            const btCollisionObjectWrapper* b, int part_b, int index_b) {
  const btVector3 before = point.m_normalWorldOnB;
  btAdjustInternalEdgeContacts(point, b, a, part_b, index_b);
  btAdjustInternalEdgeContacts(point, a, b, part_a, index_a);
  if (point.m_normalWorldOnB == before) return true;
  for (const btCollisionObjectWrapper* const side : {a, b})
    if (void* const count = side->getCollisionObject()->getUserPointer()) ++*static_cast<std::uint64_t*>(count);
  return true;
}

void configure_internal_edges(const Subject& subject, const Body& description, btRigidBody& body) {
  if (has_it(subject, description))
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
}

void start_internal_edges(SceneInstance& instance) {
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    if (!has_it(instance.subject, instance.expanded.bodies[i])) continue;
    instance.bodies[i]->setUserPointer(&instance.adjusted_contacts);
    auto& mesh = static_cast<btBvhTriangleMeshShape&>(*instance.bodies[i]->getCollisionShape());
    if (mesh.getTriangleInfoMap() != nullptr) continue;
    instance.edges.push_back(std::make_unique<btTriangleInfoMap>());
    btGenerateInternalEdgeInfo(&mesh, instance.edges.back().get());
  }
  // The callback is one for the whole process; it minds only bodies with the flag, so it may stay.
  gContactAddedCallback = &adjust;
}

std::uint64_t count_adjusted(const SceneInstance& instance) {
  return instance.adjusted_contacts;
}

}  // namespace

const Effect internal_edges{"internal_edges",
                            "bodies do not stumble over edges inside a mesh",
                            "gContactAddedCallback, and a map of the edges of the mesh",
                            calls_for_internal_edges,
                            {.configure_body = configure_internal_edges, .start = start_internal_edges},
                            {"adjusted contact points", count_adjusted, Effect::Activity::of_run}};

}  // namespace boxstream::effects
