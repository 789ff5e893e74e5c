// SPDX-License-Identifier: MIT
#include "simulation/effects/linked.hpp"

#include <algorithm>

#include "simulation/effects/find.hpp"
#include "simulation/engine/link_joint.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

constexpr const char* instead = R"("dantzig", or more substeps)";

/// What of a scene rules multibodies out altogether; empty: nothing.
std::string ruled_out(const Scene& scene) {
  if (!scene.soft_bodies.empty()) return "there are soft bodies";
  if (scene.solver.bounces == Bounces::on_contact) return "bodies bounce on contact";
  if (scene.world.on_leave == OnLeave::freeze || scene.world.on_leave == OnLeave::remove)
    return "bodies that leave the bounds are frozen or taken out";
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                  [](const Body& body) { return body.surface_velocity != Vec3{}; }))
    return "conveyors would not carry them";
  return {};
}

/// Why a body can be no link; empty: it can.
std::string unfit_body(const Scene& scene, const Expanded& expanded, std::size_t index) {
  const Body& body = expanded.bodies[index];
  if (!is_dynamic(body)) return "holds a kinematic body";
  if (body.late) return "holds a body that comes later";
  if (std::any_of(scene.vehicles.begin(), scene.vehicles.end(),
                  [&](const Vehicle& vehicle) { return vehicle.chassis == index; }))
    return "holds a vehicle";
  return {};
}

std::string unfit_joint(const Scene& scene, const Expanded& expanded, const Joint& joint,
                        const std::optional<LinkJoint>& link) {
  if (!link) return "is " + why_no_link(joint.value);
  std::string reason = unfit_body(scene, expanded, joint.a);
  return reason.empty() && joint.b ? unfit_body(scene, expanded, *joint.b) : reason;
}

std::string name_of(const Expanded& expanded, std::size_t body) {
  const std::string& name = expanded.bodies[body].name;
  return name.empty() ? fmt::format("body {}", body) : fmt::format("body {} (\"{}\")", body, name);
}

/// The first body of a tree of which `which(body)`.
template <class Which>
std::optional<std::size_t> first_link(const Subject& subject, Which which) {
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i)
    if (subject.trees.has_body(i) && which(subject.expanded.bodies[i])) return i;
  return std::nullopt;
}

}  // namespace

JointTrees trees_of(const Scene& scene, const Expanded& expanded) {
  if (scene.solver.kind != SolverKind::multibodies || !ruled_out(scene).empty()) return {};
  std::vector<JointEdge> edges;
  for (const Joint& joint : expanded.joints) {
    const std::optional<LinkJoint> link = link_joint(joint);
    edges.push_back({joint.a, joint.b, link && link->may_close(), unfit_joint(scene, expanded, joint, link)});
  }
  return grow_trees(expanded.bodies.size(), edges);
}

std::vector<std::string> not_by_multibodies(const Subject& subject) {
  std::vector<std::string> lines;
  if (subject.scene.solver.kind != SolverKind::multibodies) return lines;
  const Expanded& expanded = subject.expanded;
  if (const std::string reason = ruled_out(subject.scene); !reason.empty()) {
    lines.push_back(fmt::format("no joint is of a multibody, because {}: sequential impulses hold them; {} hold more",
                                reason, instead));
    return lines;
  }
  for (const JointTrees::Refused& refused : subject.trees.refused)
    lines.push_back(
        fmt::format("joint {} ({}) {}: it and all that is connected with it are of no multibody, and "
                    "sequential impulses hold them; {} hold more",
                    refused.joint, pointer_of_joint(expanded, refused.joint), refused.reason, instead));
  if (subject.trees.trees.empty() && lines.empty())
    lines.emplace_back("nothing is of a multibody: there are no joints");
  const auto is_swept = [](const Body& body) { return body.traits.ccd.has_value(); };
  if (const auto i = first_link(subject, is_swept))
    lines.push_back(
        fmt::format("{} is of a multibody, which is not swept: it can jump over what is thin; take more "
                    "substeps",
                    name_of(expanded, *i)));
  const auto has_other_torque = [](const Body& body) {
    return body.traits.gyro && *body.traits.gyro != Gyro::conserving;
  };
  if (const auto i = first_link(subject, has_other_torque))
    lines.push_back(
        fmt::format("{} is of a multibody, which turns by its inertia whatever \"gyro\" says", name_of(expanded, *i)));
  return lines;
}

}  // namespace boxstream::effects
