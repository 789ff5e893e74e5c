// SPDX-License-Identifier: MIT
#include "boxstream/query/run_queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boxstream/query/query_poster.hpp"
#include "boxstream/query/query_report.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "boxstream/shared/status_line.hpp"
#include "simulation/query/run.hpp"

namespace boxstream::tool {

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
