// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "settle.hpp"

namespace boxstream::accuracy {

struct Reference;
struct Request;
struct Row;
struct Trajectory;

/// CBOR.
using Bytes = std::vector<std::uint8_t>;

/// Has another program, whose Bullet has numbers of the other precision, do a job, and returns what `answer_job` says
/// there; empty: it was interrupted. Throws BadKnob if there is no such program, or it complains.
using Elsewhere = std::function<Bytes(const Bytes& job)>;

/// What a scene is made of, for a program that reads it again.
struct Source {
  nlohmann::json document;
  std::vector<Place> start;  ///< of its bodies; empty: where the document has them
};

/// Whether the scene is of the precision that this program has not.
bool is_for_elsewhere(const scenes::Scene& scene);

/// The scene in the precision that this program has: what it is like in anything else.
scenes::Scene here(scenes::Scene scene);

/// As `run_and_sample`; `scene` is made of `source`, but for its time, its solver and its checks.
bool sample_elsewhere(const Request& request, const Source& source, const scenes::Scene& scene,
                      const Reference& reference, Row& row, Trajectory* trajectory, double most_seconds);

/// Milliseconds for a simulated second, as in `run`; NaN: interrupted.
double time_elsewhere(const Request& request, const Source& source, const scenes::Scene& scene, std::uint64_t steps);

/// Does a job of the two above. `document` as in Request. Throws BadKnob, scenes::SceneError.
Bytes answer_job(const Bytes& job, const std::function<nlohmann::json(const scenes::Scene& scene)>& document);

}  // namespace boxstream::accuracy
