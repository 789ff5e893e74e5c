// SPDX-License-Identifier: MIT
#include <optional>
#include <stdexcept>

#include "accuracy/knob.hpp"
#include "experiment_kinds/kinds.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "measure/pinned.hpp"

namespace boxstream::report {

// Each is defined in the source of its name.
Measure measure_box_kinds, measure_cells, measure_far_boxes, measure_fcl_boxes, measure_fcl_managers, measure_frames,
    measure_narrow_phases, measure_neutrality, measure_orders, measure_outputs, measure_precision,
    measure_predictability, measure_scenes;

const std::vector<ExperimentKind>& experiment_kinds() {
  static const std::vector<ExperimentKind> all{
      {"box-kinds",
       "ms per step",
       {"missed", "pairs", "extra", "false_positive_rate", "update_ms", "pairs_ms", "narrow_ms", "rest_ms",
        "steps_alike"},
       measure_box_kinds},
      {"cells", "ns per box", {"missed", "extra", "other_order"}, measure_cells, true},
      {"far-boxes",
       "ns per box",
       {"missed", "duplicates", "extra_per_box", "pairs_per_box", "share_cut_off"},
       measure_far_boxes},
      {"fcl-boxes", "ms per query", {"missed", "narrow_calls", "touching", "false_positive_rate"}, measure_fcl_boxes},
      {"fcl-managers", "ms per query", {"missed", "extra", "duplicates", "distance_ulp"}, measure_fcl_managers},
      {"frames",
       "ns per box and frame",
       {"missed", "duplicates", "extra_per_box", "pairs_per_box", "false_positive_rate"},
       measure_frames},
      {"narrow",
       "us per query",
       {"error_max", "error_p95", "wrong", "missed", "extra", "unanswered"},
       measure_narrow_phases},
      {"neutrality",
       "ms per simulated second",
       {"identical", "first_difference_step", "missed", "extra_per_step", "distance_at_end_m"},
       measure_neutrality},
      {"orders",
       "ms per simulated second",
       {"depth_mm", "deepest_mm", "contacts", "energy_gain_J", "depth_ratio", "cost_ratio", "contact_ratio",
        "beyond_noise", "better", "worse"},
       measure_orders},
      {"outputs", "ms per batch", {"ns_per_pair", "bytes_per_pair", "pairs", "changes", "wrong"}, measure_outputs},
      {"precision", "ms per simulated second", {"way_error"}, measure_precision},
      {"predictability",
       "ms per simulated second",
       {"parts_after_s.p10", "parts_after_s.p50", "parts_after_s.p90", "parted_share", "distance_at_end_m",
        "growth_per_s", "growth_per_s.low", "growth_per_s.high", "rate_differs_by_kick", "rate_differs_by_broadphase"},
       measure_predictability},
      {"scene", "ms per simulated second", {}, measure_scenes},  // with the metrics that its settings list
  };
  return all;
}

const ExperimentKind& kind_of(const Experiment& experiment) {
  std::string names;
  for (const ExperimentKind& kind : experiment_kinds()) {
    if (kind.name == experiment.kind) return kind;
    names += " " + kind.name;
  }
  throw BadExperiment(experiment.file + ": no kind \"" + experiment.kind + "\" here; there are:" + names);
}

Results run_experiment(const Experiment& experiment, int repeats, const Progress& progress) {
  const ExperimentKind& kind = kind_of(experiment);
  Results results{kind.cost_unit, kind.metrics, {}, {}, {}};
  std::optional<measure::Pinned> pinned;
  if (!kind.has_threads) pinned.emplace();
  const auto refuse = [&](const std::exception& error) { return BadExperiment(experiment.file + ": " + error.what()); };
  try {
    Measurement measurement{experiment, repeats, progress, results};
    kind.measure(measurement);
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error);
  } catch (const std::invalid_argument& error) {
    throw refuse(error);
  } catch (const accuracy::BadKnob& error) {
    throw refuse(error);
  } catch (const scenes::SceneError& error) {
    throw refuse(error);
  }
  return results;
}

}  // namespace boxstream::report
