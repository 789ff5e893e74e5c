// SPDX-License-Identifier: MIT
#include "boxstream/query/run_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "boxstream/query/query_report.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "pictures/drawing/poster.hpp"
#include "pictures/drawing/render.hpp"
#include "pictures/drawing/set_dressing.hpp"
#include "simulation/query/object_motion.hpp"
#include "simulation/query/run.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::tool {
namespace {

using picture::Colour;
using query::ManagerRun;
using query::QueryStep;
using query::StepResult;

constexpr Colour manager_colours[] = {{0.11F, 0.45F, 0.73F}, {0.90F, 0.49F, 0.16F}};
constexpr Colour hit_colour{0.84F, 0.15F, 0.24F};
constexpr Colour scenery_colour{0.72F, 0.71F, 0.68F};
constexpr std::array<Colour, 4> body_colours{
    {{0.93F, 0.77F, 0.42F}, {0.16F, 0.61F, 0.56F}, {0.94F, 0.55F, 0.30F}, {0.55F, 0.65F, 0.80F}}};
constexpr Colour moving_colour{0.13F, 0.36F, 0.56F};

float narrow(double value) {
  return static_cast<float>(value);
}

struct ToPicture {
  picture::Shape operator()(const scenes::BoxShape& s) const {
    return picture::Box{{narrow(s.half_extents[0]), narrow(s.half_extents[1]), narrow(s.half_extents[2])}};
  }
  picture::Shape operator()(const scenes::SphereShape& s) const { return picture::Sphere{narrow(s.radius)}; }
  picture::Shape operator()(const scenes::CapsuleShape& s) const {
    return picture::Capsule{narrow(s.radius), narrow(s.height / 2)};
  }
  picture::Shape operator()(const scenes::CylinderShape& s) const {
    return picture::Cylinder{narrow(s.radius), narrow(s.height / 2)};
  }
  picture::Shape operator()(const scenes::ConeShape& s) const {
    return picture::Cone{narrow(s.radius), narrow(s.height / 2)};
  }
  picture::Shape operator()(const scenes::MeshShape& s) const {
    auto mesh = std::make_shared<picture::Mesh>();
    for (const scenes::Vec3& v : s.vertices) mesh->vertices.push_back({narrow(v[0]), narrow(v[1]), narrow(v[2])});
    for (const auto& t : s.triangles) mesh->triangles.push_back({t[0], t[1], t[2]});
    return std::shared_ptr<const picture::Mesh>(std::move(mesh));
  }
};

picture::Transform transform_of(const query::Pose& pose) {
  const auto vec = [](const Eigen::Vector3d& v) { return picture::Vec3{narrow(v.x()), narrow(v.y()), narrow(v.z())}; };
  picture::Transform t;
  for (int column = 0; column < 3; ++column) t.column[column] = vec(pose.linear().col(column));
  t.origin = vec(pose.translation());
  return t;
}

std::vector<picture::Drawable> drawables_of(const query::QueryScene& scene, const query::RunResult& result) {
  query::ObjectMotion motion(scene);
  motion.go_to(result.managers[0].steps.size());
  std::vector<picture::Shape> shapes;
  for (const query::ShapeValue& shape : motion.shapes()) shapes.push_back(std::visit(ToPicture{}, shape));
  // The group with the fewest objects is what the scene is about, where there are several.
  std::size_t small = 0;
  for (std::size_t g = 1; g < result.groups.size(); ++g)
    if (result.groups[g].objects < result.groups[small].objects) small = g;
  std::vector<picture::Drawable> drawables;
  for (std::size_t i = 0; i < motion.objects().size(); ++i) {
    const query::Object& object = motion.objects()[i];
    const bool wall = !object.moves && object.part[0] != '\0';
    // Mixed up, since neighbours in number may be neighbours in place.
    Colour colour = wall ? scenery_colour : body_colours[object.body * 2654435761U >> 30];
    if (result.groups.size() > 1 && object.group == small) colour = moving_colour;
    if (std::binary_search(result.touched.begin(), result.touched.end(), i)) colour = hit_colour;
    drawables.push_back({shapes[object.shape], transform_of(motion.poses()[i]), colour, object.moves});
  }
  return drawables;
}

double broad_ms(const StepResult& step) {
  double ms = step.update_ms;
  for (const QueryStep& q : step.queries) ms += q.broad_ms;
  return ms;
}

double median_broad(const ManagerRun& run) {
  std::vector<double> times;
  for (const StepResult& step : run.steps) times.push_back(broad_ms(step));
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

picture::Chart chart_of(const query::RunResult& result, const std::string& title, double (*value)(const StepResult&),
                        std::size_t runs) {
  picture::Chart chart{title, "step", 1, {}};
  for (std::size_t i = 0; i < runs; ++i) {
    picture::Series series{result.managers[i].manager, manager_colours[i], {}};
    for (const StepResult& step : result.managers[i].steps) series.values.push_back(value(step));
    chart.series.push_back(std::move(series));
  }
  return chart;
}

/// The scene after the last step, what touches across groups in red, and what the queries cost.
picture::Poster query_poster(const query::QueryScene& scene, const query::RunResult& result) {
  picture::Poster poster;
  poster.title = scene.meta.name;
  poster.subtitle = scene.meta.about;
  std::vector<picture::Drawable> drawables = drawables_of(scene, result);
  const picture::PanelSize size = picture::panel_size(1);
  const picture::Camera camera = picture::frame(drawables, narrow(size.width) / narrow(size.height), {35, 30});
  picture::cut_away(drawables, camera);
  picture::add_floor(drawables);
  const std::string steps = grouped(result.managers[0].steps.size());
  poster.panels.push_back({picture::render(drawables, camera, {size.width, size.height}),
                           fmt::format("{} objects", grouped(result.objects)),
                           "after " + steps +
                               " steps; in red: what "
                               "touches or is too close, across groups",
                           manager_colours[0]});
  for (std::size_t i = 0; i < result.managers.size(); ++i)
    poster.figures.push_back({fmt::format("{:.3g} ms", median_broad(result.managers[i])),
                              result.managers[i].manager + ": update and queries, median step, without narrow phase",
                              manager_colours[i]});
  if (result.answers_equal)
    poster.figures.push_back({*result.answers_equal ? "answers equal" : "answers differ",
                              "pairs, contacts and distances of " + steps + " steps"});
  poster.charts.push_back(
      chart_of(result, "update and queries without narrow phase, ms", broad_ms, result.managers.size()));
  poster.charts.push_back(chart_of(
      result, "pairs that touch or are too close",
      [](const StepResult& step) {
        double pairs = 0;
        for (const QueryStep& q : step.queries) pairs += static_cast<double>(q.pairs);
        return pairs;
      },
      1));
  if (!result.first_difference.empty()) poster.small_print.push_back("first difference: " + result.first_difference);
  poster.small_print.push_back(fmt::format("boxstream {}, FCL {}, {}, {}", measure::library_version(),
                                           query::fcl_version(), compiler_name(), cpu_name()));
  return poster;
}

}  // namespace

std::vector<std::string> manager_names() {
  return query::manager_names();
}

int run_queries(const QueryOptions& options) {
  // Everything the user may have got wrong is found out before the first step.
  const std::string manager = options.manager.empty() ? query::manager_names().front() : options.manager;
  query::QueryScene scene = query::load_query_scene(resolve_scene(options.scene, SceneKind::query).string());
  if (options.scale != 1) scene = query::scaled(scene, options.scale);
  const auto format = checked_format(options.picture);
  OutputFiles files;
  std::ostream *const json = files.add(options.json), *const picture = files.add(options.picture);

  StatusLine status;
  const std::uint64_t steps = options.steps.value_or(static_cast<std::uint64_t>(scene.steps));
  status.say("setting up");
  const query::RunResult result = query::run(scene, manager, options.compare, steps,
                                             [&](std::uint64_t done, std::uint64_t objects, std::uint64_t pairs) {
                                               status.step(done, steps, objects, pairs);
                                             });
  if (json != nullptr) *json << query_json(scene, result);
  if (picture != nullptr) {
    status.say("drawing");
    picture::write_poster(query_poster(scene, result), *picture, *format);
  }
  status.clear();
  files.commit();
  if (options.json != "-") print(query_table(scene, result));
  if (!result.first_difference.empty()) throw std::runtime_error("answers differ: " + result.first_difference);
  return 0;
}

}  // namespace boxstream::tool
