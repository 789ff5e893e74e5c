// SPDX-License-Identifier: MIT
#include "named.hpp"

#include <string>
#include <vector>

#include "base/words.hpp"
#include "formats/scene_model/expand.hpp"

namespace boxstream::accuracy {

using scenes::Scene;

std::optional<std::size_t> body_of(const Request& request, const Scene& scene) {
  if (request.body_name.empty()) return std::nullopt;
  const std::vector<scenes::Body> bodies = scenes::expand(scene).bodies;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == request.body_name || std::to_string(i) == request.body_name) return i;
    if (!bodies[i].name.empty()) names.push_back(bodies[i].name);
  }
  throw BadKnob(unknown_word("body", request.body_name, names) + " (names of the scene, or numbers from 0 to " +
                std::to_string(bodies.size() - 1) + ")");
}

std::optional<std::size_t> joint_of(const Request& request, const Scene& scene) {
  const std::string& wanted = request.joint_name;
  if (wanted.empty()) return std::nullopt;
  const scenes::Expanded expanded = scenes::expand(scene);
  const auto name = [&](std::size_t body) {
    return expanded.bodies[body].name.empty() ? std::to_string(body) : expanded.bodies[body].name;
  };
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < expanded.joints.size(); ++i) {
    if (std::to_string(i) == wanted) return i;
    const scenes::Joint& joint = expanded.joints[i];
    const std::string a = name(joint.a), b = joint.b ? name(*joint.b) : "world";
    if (wanted == a + "," + b || wanted == b + "," + a) return i;
    if (wanted != a && wanted != b) continue;
    if (found) throw BadKnob("--joint " + wanted + ": it has several; name both bodies: " + a + "," + b);
    found = i;
  }
  if (!found)
    throw BadKnob("--joint " + wanted + ": there is none; the scene has " + std::to_string(expanded.joints.size()) +
                  ", named by number from 0 or by their bodies: a,b or a,world");
  return found;
}

}  // namespace boxstream::accuracy
