// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/scene_model/checks.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::accuracy {

/// Milliseconds for a simulated second of so many steps: processor time; of several threads elapsed time. Building the
/// world is not in it.
double timed(scenes::Scene scene, const std::string& broadphase, std::uint64_t steps);

/// A quantity of a run.
struct Measure {
  enum class Kind {
    metric,                   ///< one of scenes::metric_names(), after each step
    momentum_drift,           ///< |P - P at the start| / |P at the start|, of all dynamic bodies
    angular_momentum_drift,   ///< the same of the angular momentum about the origin
    energy_change,            ///< `energy_drift` with its sign, which says where energy went
    joint_error,              ///< m, the largest distance between the two ends of a joint that holds a point
    joint_angle,              ///< degrees, the largest angle between the two axes of a hinge, or sides of a fixed joint
    mean_square_penetration,  ///< m^2, over all contact points, of which some may not be deep at all
    height_loss,              ///< of the top of the dynamic bodies, as a share of its height over their lowest point;
                              ///< up is against gravity
    tunnelled,      ///< share of the dynamic bodies whose centre is out of the scene's bounds, also of those taken out
    collapse_time,  ///< s, until a tenth of the height is lost; the whole run if it never is
    stands,         ///< 1 if it never is, else 0: `collapse_time` is then a lower bound
    trajectory,     ///< m, how far dynamic bodies are from where the reference has them (RMS)
    orientation,    ///< degrees, by which they are turned from there (RMS)
    agrees_for,     ///< s, until contacts differ from those of the reference by more than a step
    trajectory_until,  ///< `trajectory`, only as long as they agree
    velocity_error,    ///< |v - expected| / |expected|, of the body that the request names, at the end
    direction_error,   ///< degrees, between these two velocities
    body_x,            ///< m, where the body that the request names is
    body_y,
    body_z,
    body_speed,  ///< m/s, of that body
    body_spin,   ///< rad/s
    truth,       ///< m, how far that body is from where the request knows it to be, at those times
    repeatable,  ///< 1 if a second run ends with the same bits, else 0
    field        ///< a number in the JSON of a run: the measure's name is a pointer to it
  };
  /// Of the values of all steps.
  enum class Statistic {
    worst,  ///< the largest; of what is better when larger the smallest
    p95,
    mean,
    last,
    integral  ///< over time
  };
  std::string name;
  Kind kind = Kind::metric;
  scenes::Check::Metric metric = scenes::Check::Metric::finite;
  Statistic statistic = Statistic::worst;
};

/// One of scenes::metric_names() or of the kinds above, "penetration" for "max_penetration"; with a statistic behind a
/// dot, if it is not to be the worst: "penetration.p95"; or a JSON pointer (RFC 6901). Throws BadKnob.
Measure parse_measure(const std::string& name);

/// All names: scenes::metric_names() and those of the kinds above.
std::vector<std::string> measure_names();

/// Whether it compares with a reference.
bool needs_reference(const Measure& measure);

/// Whether it is of the one body that a request names.
bool is_of_body(const Measure& measure);

/// Which of its values are better. `as_reference`: no value is better by itself, such as a place; what counts is how
/// far it is from the reference's, or from the truth.
enum class Better { low, high, near_zero, as_reference };
Better better(const Measure& measure);

/// What a scene must have for it to have a value; empty: any scene has one.
std::string needs(const Measure& measure);

/// Of one measure over the steps of a run.
struct Series {
  double worst = 0, p95 = 0, mean = 0, last = 0, integral = 0;

  /// The one that the measure names.
  double of(const Measure& measure) const {
    const double all[] = {worst, p95, mean, last, integral};
    return all[static_cast<int>(measure.statistic)];
  }
};

/// Of at least one value, `seconds` long altogether.
Series summed_up(const Measure& measure, const std::vector<double>& values, double seconds);

}  // namespace boxstream::accuracy
