// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_writers.hpp"

#include <fmt/format.h>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/report.hpp"
#include "formats/scene_model/scene.hpp"
#include "pictures/viewer/page.hpp"

namespace boxstream::tool {
namespace {

/// A run with one setting, recorded.
struct SeenRun {
  /// `first`: the run beside it, if that has been made, whose objects this one shows too.
  SeenRun(const accuracy::Request& request, const accuracy::Setting& setting, const SeenRun* first, StatusLine& status)
      : scene(accuracy::scene_with(request, setting)),
        label(accuracy::label(request.knobs, setting)),
        simulation(scene, request.broadphase),
        recording(simulation, {steps(), 0, view::Recording::Options().size / 2}, kept(first)) {
    for (std::uint64_t step = 0; step < steps(); ++step) {
      results.push_back(simulation.step());
      recording.add_step();
      status.step(step + 1, steps(), results.back().bodies, results.back().pairs);
    }
    recording.finish();
  }

  view::Kept kept(const SeenRun* first) const {
    return first ? first->recording.model().kept : view::choose_kept(simulation, view::Recording::Options().bodies);
  }
  std::uint64_t steps() const { return static_cast<std::uint64_t>(scene.time.steps); }

  scenes::Scene scene;
  std::string label;
  scenes::Simulation simulation;
  view::Recording recording;
  std::vector<scenes::StepResult> results;
};

}  // namespace

void check_view(const std::string& name, const accuracy::Request& request) {
  if (name.empty()) return;
  if (!name.ends_with(".html")) throw BadInput(fmt::format("--view {}: the file's name must end in .html", name));
  if (!view::has_pages())
    throw BadInput("--view: this boxstream was built without the viewer, which takes node and npm");
  const std::vector<accuracy::Setting> settings = accuracy::grid(request.knobs);
  if (settings.size() < 2) throw BadInput("--view: shows two settings, and there is one");
  for (const accuracy::Setting& seen : {settings.front(), settings.back()})
    if (accuracy::is_for_elsewhere(accuracy::scene_with(request, seen)))
      throw BadInput("--view: shows worlds of single precision alone");
}

void write_accuracy_view(const accuracy::Request& request, std::ostream& out, StatusLine& status) {
  const std::vector<accuracy::Setting> settings = accuracy::grid(request.knobs);
  const SeenRun first(request, settings.front(), nullptr, status);
  const SeenRun last(request, settings.back(), &first, status);
  view::write_page(out, {{&first.recording, first.label, &first.results}, {&last.recording, last.label, &last.results}},
                   versions());
}

}  // namespace boxstream::tool
