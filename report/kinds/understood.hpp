// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "accuracy/knob.hpp"
#include "kinds.hpp"
#include "scene/scene_error.hpp"

namespace boxstream::report {

/// What `measure` returns; what it throws about settings becomes a BadExperiment that begins with the file.
template <class Measure>
Results with_settings_of(const Experiment& experiment, Measure&& measure) {
  try {
    return measure(experiment.settings);
  } catch (const nlohmann::json::exception& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  } catch (const accuracy::BadKnob& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  } catch (const scenes::SceneError& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  }
}

}  // namespace boxstream::report
