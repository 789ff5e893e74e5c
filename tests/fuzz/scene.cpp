// SPDX-License-Identifier: MIT
// The scene loader: any text gives a scene or a complaint in one line that names the file; what loads is expanded,
// scaled and repeated, and everything in it refers to something that is there.
//
// Input: the text of a scene. It names files that there are not: importers have targets of their own. Scenes of very
// many bodies are scaled down before they are expanded, for the sake of time alone.
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "finding.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/expand_parts.hpp"
#include "formats/scene_model/repeated.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::fuzz {
namespace {

using scenes::Expanded;
using scenes::Scene;

const std::string file = "/nowhere/fuzz.json";
constexpr std::size_t most_expanded = 20'000;

void promise_sound(const Expanded& expanded) {
  for (const scenes::Shape& shape : expanded.shapes)
    if (const auto* const compound = std::get_if<scenes::CompoundShape>(&shape.value))
      for (const scenes::CompoundChild& child : compound->children)
        promise(child.shape < expanded.shapes.size(), "a child without a shape");
  for (const scenes::Body& body : expanded.bodies) {
    promise(body.traits.shape < expanded.shapes.size(), "a body without a shape");
    for (const double x : body.position) promise(std::isfinite(x), "a body at no place");
    for (const double x : body.velocity) promise(std::isfinite(x), "a velocity that is not finite");
  }
  for (const scenes::Joint& joint : expanded.joints)
    promise(joint.a < expanded.bodies.size() && (!joint.b || *joint.b < expanded.bodies.size()),
            "a joint without a body");
  for (const auto& [a, b] : expanded.exclusions)
    promise(a < expanded.bodies.size() && b < expanded.bodies.size(), "apart without a body");
  for (std::size_t i = 0; i < expanded.bodies.size(); i += 1 + expanded.bodies.size() / 16)
    promise(!scenes::pointer_of_body(expanded, i).empty(), "a body from nowhere");
}

std::size_t bodies_of(const Scene& scene) {
  std::size_t bodies = scene.bodies.size();
  for (const scenes::Generator& generator : scene.generators) bodies += scenes::most_bodies(generator);
  return bodies;
}

void expand_all(const Scene& scene) {
  const Expanded expanded = expand(scene);
  promise_sound(expanded);
  promise(expanded.bodies.size() <= bodies_of(scene), "more bodies than were counted");
}

void check(const Scene& scene) {
  const std::size_t bodies = bodies_of(scene);
  if (bodies <= most_expanded) expand_all(scene);
  for (const double factor : {0.25, 3.0}) {
    try {
      const Scene other = scaled(scene, factor);
      if (bodies_of(other) <= most_expanded) expand_all(other);
    } catch (const std::invalid_argument& error) {
      promise(factor > 1, std::string("cannot be made smaller: ") + error.what());
    }
  }
  if (bodies <= most_expanded) {
    const Scene twice = repeated(scene, 2, 10);
    if (bodies_of(twice) <= most_expanded) expand_all(twice);
  }
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    fuzz::check(scenes::parse_scene(text, fuzz::file));
  } catch (const scenes::SceneError& error) {
    fuzz::promise_one_line(error.what());
    fuzz::promise(std::string(error.what()).starts_with(fuzz::file + ": /"), "a complaint without file and place");
  }
  return 0;
}
