// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Reason {
  std::string operator()(const HingeJoint& joint) const { return joint.limits ? "a hinge with limits" : ""; }
  std::string operator()(const SliderJoint& joint) const { return joint.limits ? "a slider with limits" : ""; }
  std::string operator()(const ConeTwistJoint&) const { return "a cone with limits"; }
  std::string operator()(const SixDofJoint& joint) const {
    for (const auto& axes : {joint.linear, joint.angular})
      for (const auto& [low, high] : axes)
        if (low < high) return "an axis with limits";
    return {};
  }
  template <class Other>
  std::string operator()(const Other&) const {
    return {};
  }
};

std::optional<Call> called_for(const Subject& subject) {
  return first_joint(subject, [](const Joint& joint) { return std::visit(Reason{}, joint.value); });
}

}  // namespace

const Effect joint_limits{"joint_limits", "joints end somewhere",
                          "rows of joints that are at a limit, which the joint itself makes", called_for};

}  // namespace boxstream::effects
