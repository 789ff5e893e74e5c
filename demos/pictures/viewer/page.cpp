// SPDX-License-Identifier: MIT
#include "pictures/viewer/page.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "pictures/viewer/names.hpp"
#include "pictures/viewer/shell.hpp"
#include "pictures/viewer/snapshot.hpp"
#include "pictures/viewer/text.hpp"

namespace boxstream::view {
namespace {

void put(std::ostream& out, const std::string& id, std::string_view bytes) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">" << base64(bytes) << "</script>\n";
}

}  // namespace

bool has_pages() {
  return !shell().empty();
}

void write_page(std::ostream& out, const std::vector<PageWorld>& worlds, const std::string& versions) {
  const std::string_view page = shell();
  const std::size_t mark = page.find(shell_mark);
  if (mark == std::string_view::npos) return;
  out << page.substr(0, mark);
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const std::string number = std::to_string(w);
    put(out, "world-" + number, deflated(describe(worlds[w], versions)));
    const std::vector<std::string>& blocks = worlds[w].recording->blocks();
    for (std::size_t i = 0; i < blocks.size(); ++i) put(out, "frames-" + number + "-" + std::to_string(i), blocks[i]);
  }
  out << page.substr(mark + shell_mark.size());
}

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

/// Each name once, and which of them each object has.
ShortJson names_json(const std::vector<std::string>& names) {
  ShortJson words = ShortJson::array(), of = ShortJson::array();
  std::map<std::string, std::size_t> places;
  for (const std::string& name : names) {
    const auto [place, is_new] = places.emplace(name, places.size());
    if (is_new) words.push_back(name);
    of.push_back(place->second);
  }
  return {{"words", std::move(words)}, {"of", std::move(of)}};
}

ShortJson link_json(const Link& link) {
  return {link.a, link.b, link.pivot_in_a, link.pivot_in_b};
}

/// Which objects of the world are those of the page: all, or each since the one before. Wheels are no objects.
ShortJson kept_json(const Kept& kept) {
  ShortJson json{{"inWorld", kept.in_world}, {"landmarks", kept.landmarks}, {"nearest", kept.nearest}};
  if (kept.is_all()) return json;
  std::uint32_t last = 0;
  json["steps"] = list(kept.objects, [&](std::uint32_t object) { return object - std::exchange(last, object); });
  return json;
}

ShortJson crowd_json(const Snapshot::Box& box) {
  return {box.min, box.max};
}

}  // namespace

std::string describe(const PageWorld& world, const std::string& versions) {
  using Step = scenes::StepResult;
  const Recording& recording = *world.recording;
  const Model& model = recording.model();
  const scenes::Scene& scene = recording.simulation().scene();
  const std::vector<Step>& results = *world.results;
  ShortJson states = ShortJson::array();
  for (const scenes::Drawable::State state : model.states) states.push_back(static_cast<unsigned>(state));
  const ShortJson json{{"title", scene.meta.name},
                       {"about", scene.meta.about},
                       {"broadphase", recording.simulation().broadphase_name()},
                       {"label", world.label},
                       {"versions", versions},
                       {"dt", static_cast<float>(scene.time.dt)},
                       {"unit", recording.unit()},
                       {"fine", Series::fine},
                       {"rotationUnit", FrameEncoder::rotation_unit},
                       {"contactQuantum", PairCode::contact_quantum},
                       {"framesInBlock", FrameEncoder::frames_in_block},
                       {"blocks", recording.blocks().size()},
                       {"frameSteps", recording.frame_steps()},
                       {"crowds", list(recording.crowds(), crowd_json)},
                       {"firstDirection", first_direction},
                       {"kept", kept_json(model.kept)},
                       {"states", std::move(states)},
                       {"names", names_json(names_of(recording.simulation(), model.kept))},
                       {"forms", list(model.forms, form_json)},
                       {"parts", list(model.parts, part_json)},
                       {"softParts", list(model.soft_parts, soft_json)},
                       {"joints", list(links_of(recording.simulation(), model.kept), link_json)},
                       {"series",
                        {{"pairs", series(results, [](const Step& s) { return s.pairs; })},
                         {"broadphase", series(results, [](const Step& s) { return rounded(s.broadphase_ms); })},
                         {"dispatch", series(results, [](const Step& s) { return rounded(s.dispatch_ms); })},
                         {"solve", series(results, [](const Step& s) { return rounded(s.solve_ms); })},
                         {"step", series(results, [](const Step& s) { return rounded(s.step_ms); })}}}};
  return json.dump(-1, ' ', false, ShortJson::error_handler_t::replace);
}

}  // namespace boxstream::view
