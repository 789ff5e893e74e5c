// SPDX-License-Identifier: MIT
#include "pictures/viewer/description.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <nlohmann/json.hpp>

#include "pictures/viewer/frames.hpp"

namespace boxstream::view {
namespace {

// Floats as short as they can be and still be read back as the same float.
using ShortJson = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, float>;

constexpr const char* kind_names[] = {"box", "sphere", "capsule", "cylinder", "cone", "plane", "triangles"};

ShortJson form_json(const Form& form) {
  ShortJson json{{"kind", kind_names[static_cast<std::size_t>(form.kind)]}};
  if (form.kind == scenes::Drawable::Kind::capsule) json["ratio"] = form.ratio;
  if (form.kind == scenes::Drawable::Kind::triangles) {
    json["vertices"] = form.vertices;
    json["triangles"] = form.triangles;
  }
  return json;
}

/// Object, form and scale; then, where there is one, the place in the object.
ShortJson part_json(const Part& part) {
  ShortJson json{part.object, part.form, part.scale};
  if (part.position != Point{} || part.rotation != no_rotation) {
    json.push_back(part.position);
    json.push_back(part.rotation);
  }
  return json;
}

ShortJson soft_json(const SoftPart& part) {
  return {{"object", part.object}, {"first", part.first_node}, {"count", part.nodes}, {"triangles", part.triangles}};
}

template <class Of>
ShortJson series(const std::vector<scenes::StepResult>& results, Of of) {
  ShortJson json = ShortJson::array();
  for (const scenes::StepResult& result : results) json.push_back(of(result));
  return json;
}

/// To the microsecond: clocks are not finer.
float rounded(double ms) {
  return static_cast<float>(std::round(ms * 1000) / 1000);
}

template <class Part, class ToJson>
ShortJson list(const std::vector<Part>& parts, ToJson to_json) {
  ShortJson json = ShortJson::array();
  std::transform(parts.begin(), parts.end(), std::back_inserter(json), to_json);
  return json;
}

}  // namespace

std::string describe(const Description& d) {
  using Step = scenes::StepResult;
  const scenes::Bounds& bounds = d.scene.world.bounds;
  ShortJson states = ShortJson::array();
  for (const scenes::Drawable::State state : d.model.states) states.push_back(static_cast<unsigned>(state));
  const ShortJson json{{"title", d.scene.meta.name},
                       {"about", d.scene.meta.about},
                       {"broadphase", d.broadphase},
                       {"versions", d.versions},
                       {"dt", static_cast<float>(d.scene.time.dt)},
                       {"bounds", {{"min", bounds.min}, {"max", bounds.max}}},
                       {"unit", d.unit},
                       {"rotationUnit", FrameEncoder::rotation_unit},
                       {"framesInBlock", FrameEncoder::frames_in_block},
                       {"blocks", d.blocks},
                       {"frameSteps", d.frame_steps},
                       {"states", std::move(states)},
                       {"forms", list(d.model.forms, form_json)},
                       {"parts", list(d.model.parts, part_json)},
                       {"softParts", list(d.model.soft_parts, soft_json)},
                       {"series",
                        {{"pairs", series(d.results, [](const Step& s) { return s.pairs; })},
                         {"begun", series(d.results, [](const Step& s) { return s.begun; })},
                         {"ended", series(d.results, [](const Step& s) { return s.ended; })},
                         {"broadphase", series(d.results, [](const Step& s) { return rounded(s.broadphase_ms); })},
                         {"dispatch", series(d.results, [](const Step& s) { return rounded(s.dispatch_ms); })},
                         {"solve", series(d.results, [](const Step& s) { return rounded(s.solve_ms); })},
                         {"step", series(d.results, [](const Step& s) { return rounded(s.step_ms); })}}}};
  return json.dump(-1, ' ', false, ShortJson::error_handler_t::replace);
}

}  // namespace boxstream::view
