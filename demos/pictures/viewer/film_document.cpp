// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>

#include "pictures/solids/surface.hpp"
#include "pictures/viewer/film.hpp"
#include "pictures/viewer/glb_file.hpp"
#include "simulation/engine/drawable.hpp"

namespace boxstream::view {
namespace {

/// Colours of a film: bodies run through a palette in order of creation, so that mixing shows.
inline constexpr std::size_t paint_count = 12;

struct Paint {
  const char* name;
  float r, g, b;  // sRGB
  float opacity = 1;
};

constexpr Paint paints[paint_count] = {
    {"created 1", 0.13F, 0.36F, 0.56F}, {"created 2", 0.14F, 0.49F, 0.56F},     {"created 3", 0.16F, 0.61F, 0.56F},
    {"created 4", 0.93F, 0.77F, 0.42F}, {"created 5", 0.94F, 0.66F, 0.36F},     {"created 6", 0.94F, 0.55F, 0.30F},
    {"created 7", 0.86F, 0.30F, 0.26F}, {"floor", 0.78F, 0.79F, 0.80F},         {"scenery", 0.72F, 0.71F, 0.68F},
    {"kinematic", 0.30F, 0.33F, 0.38F}, {"sensor", 0.10F, 0.62F, 0.45F, 0.25F}, {"character", 0.84F, 0.15F, 0.24F}};
constexpr std::size_t created_count = 7;
enum Special : std::size_t { floor_paint = created_count, scenery, kinematic, sensor, character };

/// Materials are given in linear light.
double linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// Of an object in the given state when the film began.
std::size_t paint_of(scenes::Drawable::State state, bool is_plane, std::uint32_t object, std::size_t objects) {
  using State = scenes::Drawable::State;
  if (is_plane) return floor_paint;
  switch (state) {
    case State::fixed:
      return scenery;
    case State::kinematic:
    case State::wheel:
      return kinematic;
    case State::sensor:
      return sensor;
    case State::character:
      return character;
    case State::moving:
    case State::sleeping:
    case State::soft:
      break;
  }
  return std::min(created_count - 1, object * created_count / std::max<std::size_t>(objects, 1));
}

/// As a glTF material.
nlohmann::ordered_json material_json(std::size_t paint) {
  const Paint& p = paints[paint];
  nlohmann::ordered_json json{
      {"name", p.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {linear(p.r), linear(p.g), linear(p.b), static_cast<double>(p.opacity)}},
        {"metallicFactor", 0},
        {"roughnessFactor", 0.7}}},
      {"doubleSided", true}};
  if (p.opacity < 1) json["alphaMode"] = "BLEND";
  return json;
}

using Json = GlbFile::Json;

std::vector<float> flat(const std::vector<Point>& points) {
  std::vector<float> floats;
  floats.reserve(3 * points.size());
  for (const Point& p : points) floats.insert(floats.end(), p.begin(), p.end());
  return floats;
}

/// Of a form at unit size. A plane is a square from -1 to 1.
solids::Surface surface_of(const Form& form) {
  using Kind = scenes::Drawable::Kind;
  constexpr int segments = 24;
  switch (form.kind) {
    case Kind::box:
      return solids::box({1, 1, 1});
    case Kind::sphere:
      return solids::capsule(1, 0, segments);
    case Kind::capsule:
      return solids::capsule(1, form.ratio, segments);
    case Kind::cylinder:
      return solids::cylinder(1, 1, segments);
    case Kind::cone:
      return solids::cone(1, 1, segments);
    case Kind::plane:
      return solids::square(1);
    case Kind::triangles:
      break;
  }
  return solids::flat(form.vertices, form.triangles);
}

/// Puts the document together.
class FilmDocument {
 public:
  FilmDocument(const FilmRecord& film, const scenes::Scene& scene, double frame_seconds)
      : film_(film), scene_(scene), frame_seconds_(frame_seconds) {}

  void write(std::ostream& out, const std::string& versions) {
    const Model& model = film_.model;
    std::vector<std::vector<const Part*>> parts(model.states.size());
    for (const Part& part : model.parts) parts[part.object].push_back(&part);
    for (std::uint32_t object = 0; object < parts.size(); ++object)
      if (!parts[object].empty()) add_object(object, parts[object]);
    for (std::size_t i = 0; i < film_.stills.size(); ++i) add_soft(model.soft_parts[i], film_.stills[i]);

    Json document;
    document["asset"] = {{"generator", versions}, {"extras", {{"about", scene_.meta.about}}}};
    if (!roots_.empty()) {
      document["scene"] = 0;
      document["scenes"] = Json::array({{{"name", scene_.meta.name}, {"nodes", roots_}}});
      document["nodes"] = nodes_;
      document["meshes"] = meshes_;
      document["materials"] = materials_;
    }
    if (!channels_.empty())
      document["animations"] =
          Json::array({{{"name", scene_.meta.name}, {"samplers", samplers_}, {"channels", channels_}}});
    file_.write(out, std::move(document));
  }

 private:
  std::size_t add_node(Json node) {
    nodes_.push_back(std::move(node));
    return nodes_.size() - 1;
  }

  void add_object(std::uint32_t object, const std::vector<const Part*>& parts) {
    const Pose& pose = film_.first[object];
    Json node{{"name", "object " + std::to_string(object)}};
    if (pose.position != Point{}) node["translation"] = pose.position;
    if (pose.rotation != no_rotation) node["rotation"] = pose.rotation;
    const Part& only = *parts.front();
    const Trajectory<3>& scale = film_.scales[object];
    const bool is_always_there = film_.in_world[object] && scale.frames().empty();
    if (!film_.in_world[object]) node["scale"] = Point{};
    if (is_always_there && parts.size() == 1 && only.position == Point{} && only.rotation == no_rotation) {
      node["mesh"] = mesh_of(only);
      node["scale"] = scale_of(only);
    } else {
      for (const Part* const part : parts) {
        Json child{{"mesh", mesh_of(*part)}, {"scale", scale_of(*part)}};
        if (part->position != Point{}) child["translation"] = part->position;
        if (part->rotation != no_rotation) child["rotation"] = part->rotation;
        node["children"].push_back(add_node(std::move(child)));
      }
    }
    const std::size_t index = add_node(std::move(node));
    roots_.push_back(index);
    add_channel(index, "translation", film_.places[object]);
    add_channel(index, "rotation", film_.rotations[object]);
    if (!scale.frames().empty()) add_channel(index, "scale", scale.frames(), scale.values(), 3, "STEP");
  }

  Point scale_of(const Part& part) const {
    if (film_.model.forms[part.form].kind != scenes::Drawable::Kind::plane) return part.scale;
    const scenes::Bounds& bounds = scene_.world.bounds;
    double reach = 0;
    for (std::size_t d = 0; d < 3; ++d) reach = std::max({reach, std::fabs(bounds.min[d]), std::fabs(bounds.max[d])});
    const auto half = static_cast<float>(2 * reach);
    return {half, 1, half};
  }

  std::size_t mesh_of(const Part& part) {
    const Form& form = film_.model.forms[part.form];
    const std::size_t paint = paint_of(film_.model.states[part.object], form.kind == scenes::Drawable::Kind::plane,
                                       part.object, film_.model.states.size());
    const auto [known, is_new] = mesh_by_look_.emplace(std::pair(part.form, paint), meshes_.size());
    if (is_new) {
      if (!primitive_by_form_.contains(part.form)) {
        const bool hills = film_.model.states[part.object] == scenes::Drawable::State::fixed && !form.vertices.empty();
        primitive_by_form_[part.form] =
            add_surface(hills ? solids::smooth(form.vertices, form.triangles) : surface_of(form));
      }
      add_mesh(primitive_by_form_[part.form], paint);
    }
    return known->second;
  }

  Json add_surface(const solids::Surface& surface) {
    using Use = GlbFile::Use;
    return {{"attributes",
             {{"POSITION", file_.add_floats(flat(surface.positions), 3, Use::vertices, true)},
              {"NORMAL", file_.add_floats(flat(surface.normals), 3, Use::vertices, false)}}},
            {"indices", file_.add_indices(surface.indices)}};
  }

  std::size_t add_mesh(Json primitive, std::size_t paint) {
    const auto [known, is_new] = material_by_paint_.emplace(paint, materials_.size());
    if (is_new) materials_.push_back(material_json(paint));
    primitive["material"] = known->second;
    meshes_.push_back({{"primitives", Json::array({std::move(primitive)})}});
    return meshes_.size() - 1;
  }

  void add_soft(const SoftPart& part, const std::vector<FilmRecord::Still>& stills) {
    const std::size_t paint = paint_of(scenes::Drawable::State::soft, false, part.object, film_.model.states.size());
    Json node{{"name", "object " + std::to_string(part.object)}};
    for (std::size_t i = 0; i < stills.size(); ++i) {
      const std::vector<Point>& nodes = stills[i].nodes;
      const std::size_t mesh = add_mesh(add_surface(solids::smooth(nodes, part.triangles)), paint);
      const float shown = i == 0 ? 1.0F : 0.0F;
      const std::size_t child = add_node({{"mesh", mesh}, {"scale", {shown, shown, shown}}});
      node["children"].push_back(child);
      if (stills.size() == 1) continue;
      std::vector<std::uint32_t> frames{0};
      std::vector<float> scales{shown, shown, shown};
      const auto turn = [&](std::uint32_t frame, float scale) {
        frames.push_back(frame);
        scales.insert(scales.end(), 3, scale);
      };
      if (i > 0) turn(stills[i].frame, 1);
      if (i + 1 < stills.size()) turn(stills[i + 1].frame, 0);
      add_channel(child, "scale", frames, scales, 3, "STEP");
    }
    if (!stills.empty()) roots_.push_back(add_node(std::move(node)));
  }

  template <std::size_t components>
  void add_channel(std::size_t node, const char* path, const Trajectory<components>& trajectory) {
    if (!trajectory.frames().empty())
      add_channel(node, path, trajectory.frames(), trajectory.values(), components, "LINEAR");
  }

  void add_channel(std::size_t node, const char* path, const std::vector<std::uint32_t>& frames,
                   const std::vector<float>& values, std::size_t components, const char* interpolation) {
    samplers_.push_back({{"input", times_of(frames)},
                         {"interpolation", interpolation},
                         {"output", file_.add_floats(values, components, GlbFile::Use::animation, false)}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  /// Most of what moves does so all the time, and shares its times.
  std::size_t times_of(const std::vector<std::uint32_t>& frames) {
    const auto known = times_by_frames_.find(frames);
    if (known != times_by_frames_.end()) return known->second;
    std::vector<float> times(frames.size());
    std::transform(frames.begin(), frames.end(), times.begin(),
                   [this](std::uint32_t frame) { return static_cast<float>(frame_seconds_ * frame); });
    return times_by_frames_[frames] = file_.add_floats(times, 1, GlbFile::Use::animation, true);
  }

  const FilmRecord& film_;
  const scenes::Scene& scene_;
  double frame_seconds_;
  GlbFile file_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array();
  Json samplers_ = Json::array(), channels_ = Json::array();
  std::vector<std::size_t> roots_;
  std::map<std::pair<std::uint32_t, std::size_t>, std::size_t> mesh_by_look_;
  std::map<std::uint32_t, Json> primitive_by_form_;
  std::map<std::size_t, std::size_t> material_by_paint_;
  std::map<std::vector<std::uint32_t>, std::size_t> times_by_frames_;
};

}  // namespace

void write_glb(std::ostream& out, const FilmRecord& film, const scenes::Scene& scene, double frame_seconds,
               const std::string& versions) {
  FilmDocument(film, scene, frame_seconds).write(out, versions);
}

}  // namespace boxstream::view
