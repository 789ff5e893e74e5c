// SPDX-License-Identifier: MIT
#include "advice.hpp"

#include <utility>

#include "formats/scene_json/load_scene.hpp"
#include "usual_knobs.hpp"
#include "work_precision.hpp"

namespace boxstream::accuracy {

Request advice_request(const nlohmann::json& scene, const std::string& file, double budget_seconds,
                       Elsewhere elsewhere) {
  Request request;
  request.file = file;
  request.scene = scene;
  request.knobs = usual_knobs(scenes::parse_scene(scene.dump(), file), elsewhere != nullptr);
  request.elsewhere = std::move(elsewhere);
  for (const char* name : {"penetration", "energy_drift"}) request.measures.push_back(parse_measure(name));
  request.budget = budget_seconds;
  request.compare = true;
  request.seek.emplace();
  return request;
}

Advice advise(const Request& request, const Progress& progress) {
  return advice_of(request, run(request, progress), 0, request.seek->bound);
}

Advice advice_of(const Request& request, Sweep sweep, std::size_t measure, double bound) {
  Advice advice;
  advice.sweep = std::move(sweep);
  advice.best = cheapest_within(request, advice.sweep, measure, bound);
  const Row *const best = advice.best_row(), *const own = advice.own_row();
  if (best == nullptr || own == nullptr || !own->failure.empty()) return advice;
  if (best == own)
    advice.price.emplace();
  else
    advice.price = Price{best->ms.median / own->ms.median, best->ms.low / own->ms.high, best->ms.high / own->ms.low};
  return advice;
}

}  // namespace boxstream::accuracy
