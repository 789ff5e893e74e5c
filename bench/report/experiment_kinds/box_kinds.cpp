// SPDX-License-Identifier: MIT
// The effect of kinds of boxes in the broad-phase on a whole step of a Bullet world.
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <array>

#include "boxes/changed_boxes.hpp"
#include "boxes/conversions.hpp"
#include "boxes/inputs.hpp"
#include "boxes/pair_difference.hpp"
#include "experiment_kinds/kinds.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/profile_zones.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {
namespace {

using nlohmann::json;
using scenes::ProfileZones;
using scenes::Simulation;

enum Part : std::size_t { update, pairs, narrow, rest, part_count };

struct Candidate {
  std::string kind, setting;
  double x;
  ChangeOfBox change;
  PairDifference difference;
  double held = 0, needed = 0, touching = 0;  ///< pairs of a step
  std::vector<std::uint64_t> hashes;          ///< of the state after each step
  std::array<std::vector<double>, part_count> ms;
  std::string failure;
};

/// As if the world were `offset` metres away from the origin on each axis, and the broad-phase one of floats there.
ChangeOfBox far_away(double offset, Aabb (*convert)(const Aabb64&)) {
  return [=](const Aabb& given, const btCollisionObject&) {
    Aabb64 there{};
    for (int d = 0; d < 3; ++d) {
      there.min[d] = static_cast<double>(given.min[d]) + offset;
      there.max[d] = static_cast<double>(given.max[d]) + offset;
    }
    const Aabb converted = convert(there);
    Aabb back{};
    for (int d = 0; d < 3; ++d) {
      back.min[d] = static_cast<float>(static_cast<double>(converted.min[d]) - offset);
      back.max[d] = static_cast<float>(static_cast<double>(converted.max[d]) - offset);
    }
    return back;
  };
}

ChangeOfBox change_of(const std::string& kind, double value) {
  if (kind == "bullet") return [](const Aabb& given, const btCollisionObject&) { return given; };
  if (kind == "tight") return [](const Aabb& given, const btCollisionObject&) { return tight_box(given); };
  if (kind == "cube") return [](const Aabb& given, const btCollisionObject&) { return cube_around(given); };
  if (kind == "sphere") return sphere_box;
  if (kind == "margin")
    return [margin = static_cast<float>(value)](const Aabb& given, const btCollisionObject&) {
      return expanded(given, margin);
    };
  if (kind == "float") return far_away(value, nearest_floats);
  if (kind == "float, outward") return far_away(value, outward_floats);
  if (kind == "16 bit")
    return [lattice = Lattice16({{-value, -value, -value}, {value, value, value}})](
               const Aabb& given, const btCollisionObject&) { return lattice.outward(given); };
  throw std::invalid_argument("no kind of box \"" + kind + "\"");
}

/// Of kinds with a number, what it is.
std::string unit_of(const std::string& kind) {
  if (kind == "margin") return " m";
  return kind == "16 bit" ? " m world" : " m away";
}

std::vector<Candidate> candidates_of(const json& boxes) {
  std::vector<Candidate> candidates;
  const auto add = [&](const std::string& kind, const std::string& setting, double value) {
    candidates.push_back({kind, setting, value, change_of(kind, value), {}, 0, 0, 0, {}, {}, {}});
  };
  for (const json& entry : boxes) {
    if (entry.is_string()) {
      add(entry, "", NAN);
      continue;
    }
    const auto kind = entry.at("box").get<std::string>();
    for (const auto value : entry.at("values").get<std::vector<double>>())
      add(kind, fmt::format("{:g}{}", value, unit_of(kind)), value);
  }
  if (candidates.empty()) throw std::invalid_argument("no kinds of boxes");
  return candidates;
}

/// A world whose boxes are changed.
struct World {
  World(const scenes::Scene& scene, const ChangeOfBox& change)
      : simulation(scene, "boxstream", [&](std::unique_ptr<btBroadphaseInterface> inner) {
          auto wrapped = std::make_unique<ChangedBoxes>(std::move(inner), change);
          boxes = wrapped.get();
          return wrapped;
        }) {}

  ChangedBoxes* boxes = nullptr;
  Simulation simulation;
};

struct Steps {
  int before, timed, sample_every;
};

void run_and_sample(Candidate& candidate, const scenes::Scene& scene, Steps steps) {
  World world(scene, candidate.change);
  int samples = 0;
  for (int step = 0; step < steps.before + steps.timed; ++step) {
    const bool is_sampled = step >= steps.before && (step - steps.before) % steps.sample_every == 0;
    world.simulation.set_after_pairs([&] {
      if (!is_sampled) return;
      const std::vector<Pair> held = scenes::held_pairs(world.simulation);
      const std::vector<Pair> needed = world.boxes->needed_pairs();
      candidate.difference.add(compare_pairs(needed, held));
      candidate.held += static_cast<double>(held.size());
      candidate.needed += static_cast<double>(needed.size());
      ++samples;
    });
    world.simulation.step({false, false, false});
    candidate.hashes.push_back(world.simulation.state_hash());
    if (is_sampled) candidate.touching += static_cast<double>(touching_pairs(world.simulation.world(), false));
  }
  // Of several substeps each was sampled, and touching pairs are those of the last one.
  candidate.held /= samples;
  candidate.needed /= samples;
  candidate.touching /= (steps.timed + steps.sample_every - 1) / steps.sample_every;
  candidate.failure = candidate.difference.complaint(true);
}

/// Milliseconds of a step.
double timed(Candidate& candidate, const scenes::Scene& scene, Steps steps) {
  World world(scene, candidate.change);
  for (int step = 0; step < steps.before; ++step) world.simulation.advance();
  const ProfileZones zones(measure::Clock::cpu);
  const double cost = measure::time_once([&] {
                        for (int step = 0; step < steps.timed; ++step) world.simulation.advance();
                      }) /
                      steps.timed;
  const auto part = [&](ProfileZones::Zone zone) { return measure::milliseconds(zones.time(zone)) / steps.timed; };
  const double parts[] = {part(ProfileZones::update_aabbs), part(ProfileZones::overlapping_pairs),
                          part(ProfileZones::dispatch)};
  for (const Part p : {update, pairs, narrow}) candidate.ms[p].push_back(parts[p]);
  candidate.ms[rest].push_back(cost - parts[update] - parts[pairs] - parts[narrow]);
  return cost;
}

double steps_alike(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  return static_cast<double>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

void measure_scene(const json& entry, Measurement& measurement) {
  const json& settings = measurement.settings();
  scenes::Scene scene = scenes::load_scene(entry.at("scene").get<std::string>());
  if (entry.contains("scale")) scene = scenes::scaled(scene, entry["scale"].get<double>());
  scene.checks.clear();
  const Steps steps{entry.value("before", settings.value("before", 60)), settings.value("steps", 60),
                    settings.value("look_every", 10)};
  std::vector<Candidate> candidates = candidates_of(settings.at("boxes"));
  for (Candidate& candidate : candidates) {
    measurement.progress(fmt::format("{}: {} {}", scene.meta.name, candidate.kind, candidate.setting));
    run_and_sample(candidate, scene, steps);
  }
  const auto timed_one = [&](Candidate& candidate) {
    measurement.progress(fmt::format("{}: {} {}, time", scene.meta.name, candidate.kind, candidate.setting));
    return timed(candidate, scene, steps);
  };
  measurement.add_points(scene.meta.name, candidates, timed_one, [&](const Candidate& candidate, const auto&) {
    Point point{.series = candidate.kind,
                .setting = candidate.setting,
                .x = candidate.x,
                .values = {static_cast<double>(candidate.difference.missed), candidate.held,
                           candidate.held - candidate.needed, 1 - candidate.touching / candidate.held},
                .failure = candidate.failure};
    for (const std::vector<double>& ms : candidate.ms) point.values.push_back(measure::median(ms));
    point.values.push_back(steps_alike(candidates.front().hashes, candidate.hashes));
    return point;
  });
}

}  // namespace

void measure_box_kinds(Measurement& measurement) {
  for (const json& entry : measurement.settings().at("scenes")) measure_scene(entry, measurement);
}

}  // namespace boxstream::report
