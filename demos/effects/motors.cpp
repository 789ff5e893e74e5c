// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Reason {
  std::string operator()(const HingeJoint& joint) const { return joint.motor ? "a hinge with a motor" : ""; }
  std::string operator()(const SliderJoint& joint) const { return joint.motor ? "a slider with a motor" : ""; }
  template <class Other>
  std::string operator()(const Other&) const {
    return {};
  }
};

std::optional<Call> called_for(const Subject& subject) {
  return first_joint(subject, [](const Joint& joint) { return std::visit(Reason{}, joint.value); });
}

}  // namespace

const Effect motors{"motors", "joints are driven", "a row of each motor, which the joint itself makes", called_for};

}  // namespace boxstream::effects
