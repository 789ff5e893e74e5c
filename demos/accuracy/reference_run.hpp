// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "reference.hpp"
#include "sweep.hpp"

namespace boxstream::accuracy {

/// The failure of a reference that the budget has no time for.
inline constexpr const char* takes_too_long = "it would take longer than the budget allows";

/// Runs the sequence that settings are compared with: the scene as it is, with steps finer than those of all settings,
/// iterations that do not limit it, and the solvers that are exact where the scene is small enough for them. `finest`:
/// substeps of a step of the scene that the finest setting comes to. `needed`: whatever the budget says. A sequence
/// that gains energy, breaks a check or loses a body is no reference, and `failure` says so. It is of double precision
/// where there is a source, which is what the scene is made of.
Reference run_reference(const Request& request, scenes::Scene scene, const std::optional<Source>& source,
                        std::uint64_t steps, double finest, bool needed,
                        const std::function<void(const std::string&)>& on_run);

}  // namespace boxstream::accuracy
