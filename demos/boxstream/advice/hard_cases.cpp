// SPDX-License-Identifier: MIT
#include "boxstream/advice/hard_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "boxstream/advice/columns.hpp"
#include "boxstream/advice/hard_families.hpp"
#include "boxstream/advice/reaching.hpp"
#include "formats/geometry/frame.hpp"
#include "formats/scene_model/names.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/effects/springs.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::tool {
namespace {

using effects::Subject;
using geometry::dot;
using scenes::Body;

struct Weight {
  double gravity;   ///< m/s^2
  scenes::Vec3 up;  ///< unit vector; zero where gravity tumbles
};

Weight weight_of(const scenes::WorldSettings& world) {
  const double size = effects::strength_of_gravity(world);
  return {size, size == 0 || world.tumbling ? scenes::Vec3{} : scenes::times(world.gravity, -1 / size)};
}

/// The lowest point of a body's box.
double low_end(const scenes::BuiltShape& shape, const Body& body, const scenes::Vec3& up) {
  btVector3 low, high;
  shape.shape->getAabb(scenes::transform(body.position, body.rotation), low, high);
  double end = 0;
  for (int d = 0; d < 3; ++d) end += up[d] * (up[d] > 0 ? low[d] : high[d]);
  return end;
}

/// What the first body of a column bears, as a multiple of its own mass.
double borne_by(const Column& column) {
  return column.load + static_cast<double>(column.bodies - 2);
}

/// A family of columns, and the scene's settings as that family's measure has them: what matters is how far a body
/// falls in a step, as a fraction of its size.
class Judge {
 public:
  using ByKind = std::map<scenes::SolverKind, Family>;

  Judge(const scenes::Scene& scene, const ByKind& families, double gravity, double size,
        int starts = measured_families().starts)
      : families_(families),
        starts_(starts),
        kind_(scene.solver.kind),
        family_(family_of(families, kind_)),
        substeps_(scene.time.substeps),
        scale_(std::sqrt(9.81 / gravity * size) / scene.time.dt),
        iterations_(scene.solver.iterations) {}

  bool holds(const Column& column) const { return family_.holds(column, {scale_ * substeps_, iterations_}); }

  /// The column that asks for most, of those that do not hold, and what it asks for.
  std::optional<Column> hardest(const std::vector<Column>& columns) const {
    std::optional<Column> hardest;
    std::pair<int, double> most;
    for (const Column& column : columns) {
      if (holds(column)) continue;
      const std::optional<Settings> settings = family_.cheapest(column, {scale_, iterations_});
      const std::pair<int, double> asked{settings ? price_of(*settings) : std::numeric_limits<int>::max(),
                                         borne_by(column)};
      if (hardest && asked <= most) continue;
      hardest = column;
      most = asked;
    }
    return hardest;
  }

  /// Whether there are settings that held it.
  bool is_advised(const Column& column) const {
    const std::optional<Settings> settings = family_.cheapest(column, {scale_, iterations_});
    return settings || !other_solver(column, settings).empty();
  }

  std::string advice(const Column& column, const char* remedy) const {
    const std::optional<Settings> settings = family_.cheapest(column, {scale_, iterations_});
    const std::string other = other_solver(column, settings);
    if (!settings && other.empty())
      return fmt::format(
          "Scenes like this one held with no setting that they were measured with; others may hold this one "
          "(explain --try runs it), or {}",
          remedy);
    const std::string held = starts_ == 1
                                 ? "Chains like this one that hung at rest held"
                                 : fmt::format("Scenes like this one held from {} of {} starts", starts_, starts_);
    if (!settings) return fmt::format("{} {}", held, other);
    return fmt::format("{} with {}{} iterations{}", held,
                       settings->substeps == 1 ? "" : fmt::format("{} substeps of ", settings->substeps),
                       settings->iterations, other.empty() ? "" : ", and " + other);
  }

 private:
  /// A solver that holds a column for less, as "with ..."; empty: there is none.
  std::string other_solver(const Column& column, const std::optional<Settings>& settings) const {
    double least = settings ? family_.price(column, *settings) : std::numeric_limits<double>::infinity();
    const double own = least;
    std::string best;
    for (const auto& [kind, family] : families_) {
      if (kind == kind_) continue;
      const std::optional<Settings> held = family.cheapest(column, {scale_, 10});
      if (!held || family.price(column, *held) >= least) continue;
      least = family.price(column, *held);
      best = fmt::format("with \"solver\": {{\"kind\": \"{}\"}} in {}",
                         scenes::solver_names().at(static_cast<std::size_t>(kind)),
                         held->substeps == 1 ? "one substep" : fmt::format("{} substeps", held->substeps));
      if (settings) best += fmt::format(", at {:.2g} of the price there", least / own);
    }
    return best;
  }

  const ByKind& families_;
  int starts_;
  scenes::SolverKind kind_;
  const Family& family_;
  int substeps_;
  double scale_;  ///< steps a second, as the family counts them
  int iterations_;
};

void find_stack(const Subject& subject, const std::vector<double>& masses, const Weight& weight,
                std::vector<HardCase>& found) {
  const Columns stacks = stacks_of(subject, masses, weight.up);
  const Families& families = measured_families();
  const Judge asleep(subject.scene, families.stack, weight.gravity, stacks.size),
      awake(subject.scene, families.awake, weight.gravity, stacks.size);
  const std::optional<Column> hard = asleep.hardest(stacks.list);
  // What may sleep stands still from then on.
  const bool creeps = stacks.awake && families.awake.contains(subject.scene.solver.kind);
  const std::optional<Column> creeping = hard || !creeps ? std::nullopt : awake.hardest(stacks.list);
  const std::optional<Column>& column = hard ? hard : creeping;
  if (!column) return;
  const Judge& judge = creeps ? awake : asleep;
  found.push_back({fmt::format("a stack of {} bodies with {:.3g} times its own mass upon one{}: it sinks in or falls",
                               column->bodies, borne_by(*column), creeping ? ", kept awake" : ""),
                   judge.advice(*column, "make the stack lower, or bring the masses nearer to each other"),
                   column->load > 1.5 ? "mass_ratio_1000_stable" : "stack_30_stable"});
}

/// The pair with the largest quotient of masses of which the heavy one can come to rest on the light one.
void find_mass_ratio(const Subject& subject, const std::vector<double>& masses, const Weight& weight,
                     std::vector<HardCase>& found) {
  constexpr double least_ratio = 1.5;
  constexpr std::size_t most_pairs = 1'000'000;
  std::vector<std::size_t> by_mass;
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (masses[i] > 0) by_mass.push_back(i);
  std::stable_sort(by_mass.begin(), by_mass.end(), [&](std::size_t a, std::size_t b) { return masses[a] < masses[b]; });
  const Reaching reaching(subject);
  const auto judge_of = [&](double size) {
    return Judge(subject.scene, measured_families().stack, weight.gravity, size);
  };
  double worst = least_ratio, size_of_worst = 1;
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  std::size_t asked = 0;
  for (auto heavy = by_mass.rbegin(); heavy != by_mass.rend() && asked < most_pairs; ++heavy)
    for (const std::size_t light : by_mass) {
      const double ratio = masses[*heavy] / masses[light];
      if (ratio <= worst || ++asked > most_pairs) break;
      if (!subject.collidable.can_touch(*heavy, light) || !reaching.can_stack(*heavy, light)) continue;
      const double size = (reaching.size(*heavy) + reaching.size(light)) / 2;
      if (judge_of(size).holds({2, ratio})) continue;
      worst = ratio;
      size_of_worst = size;
      pair = {*heavy, light};
    }
  if (!pair) return;
  const auto& [heavy, light] = *pair;
  found.push_back(
      {fmt::format("bodies of {:.3g} to {:.3g} kg: a heavy one ({}) sinks into a light one ({}) that it comes to "
                   "rest on",
                   masses[light], masses[heavy], heavy, light),
       judge_of(size_of_worst).advice({2, worst}, "bring the masses nearer to each other"), "mass_ratio_1000_stable"});
}

/// Whether all that joints hold hangs straight down at rest.
bool hangs(const Subject& subject, const Weight& weight) {
  const std::vector<scenes::Vec3> centres = centres_of(subject);
  const auto is_below = [&](std::size_t index, const scenes::Vec3& pivot) {
    const Body& body = subject.expanded.bodies[index];
    if (!effects::is_dynamic(body)) return true;
    const scenes::Vec3 arm = geometry::minus(centres[index], pivot), aside = geometry::cross(arm, weight.up);
    return body.velocity == scenes::Vec3{} && body.spin == scenes::Vec3{} && dot(aside, aside) <= 1e-4 * dot(arm, arm);
  };
  return std::all_of(subject.expanded.joints.begin(), subject.expanded.joints.end(), [&](const scenes::Joint& joint) {
    const scenes::Vec3 pivot = std::visit([](const auto& value) { return value.pivot; }, joint.value);
    return is_below(joint.a, pivot) && (!joint.b || is_below(*joint.b, pivot));
  });
}

void find_chain(const Subject& subject, const std::vector<double>& masses, const Weight& weight,
                std::vector<HardCase>& found) {
  const Columns chains = chains_of(subject, masses);
  // The family's links are 0.5 m long.
  const double size = chains.size / 0.5;
  const Judge swinging(subject.scene, measured_families().chain, weight.gravity, size),
      hanging(subject.scene, measured_families().hanging, weight.gravity, size, 1);
  const std::optional<Column> column = swinging.hardest(chains.list);
  const bool at_rest = hangs(subject, weight);
  if (!column || (at_rest && hanging.holds(*column))) return;
  const Judge& judge = at_rest && hanging.is_advised(*column) ? hanging : swinging;
  found.push_back({fmt::format("a chain of {} bodies with {:.3g} times its own mass hanging from one: it stretches",
                               column->bodies, borne_by(*column)),
                   judge.advice(*column, "make the chain shorter, or its end lighter"),
                   column->load > 1.5    ? "ball_and_chain_stable"
                   : column->bodies > 41 ? "chain_160_stable"
                                         : "chain_40_stable"});
}

void find_bounce(const Subject& subject, std::vector<HardCase>& found) {
  const auto is_elastic = [](const Body& body) { return body.traits.material.restitution >= 0.99; };
  if (!subject.collidable.first(is_elastic, is_elastic)) return;
  if (subject.scene.solver.bounces == scenes::Bounces::on_contact) return;
  found.push_back({"bodies of restitution 1 under gravity: bounces gain energy, or stop at once",
                   "\"solver\": {\"bounces\": \"on_contact\"} keeps it (docs/internals/closed-forms.md)",
                   "bounce_energy"});
}

void find_fast_on_surface(const Subject& subject, const Weight& weight, std::vector<HardCase>& found) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  const std::vector<scenes::Shape>& shapes = subject.expanded.shapes;
  const auto is_surface = [&](const Body& body) {
    const scenes::ShapeValue& shape = shapes[body.traits.shape].value;
    return std::holds_alternative<scenes::MeshShape>(shape) || std::holds_alternative<scenes::HeightfieldShape>(shape);
  };
  scenes::ShapeSet built(shapes);
  double lowest = std::numeric_limits<double>::max();
  for (const Body& body : bodies)
    if (is_surface(body)) lowest = std::min(lowest, low_end(built.get(body.traits.shape), body, weight.up));

  const scenes::Vec3 across = geometry::minus(subject.scene.world.bounds.max, subject.scene.world.bounds.min);
  // Where gravity tumbles, a body can fall through all of the world.
  const bool tumbling = subject.scene.world.tumbling.has_value();
  const double extent = std::sqrt(dot(across, across));
  const std::vector<std::uint32_t> surfaces = subject.collidable.count(is_surface);
  const std::vector<double> half_thickness = effects::half_thicknesses(shapes);
  double worst = 0, motion_of_worst = 0, thickness_of_worst = 0;  // worst: motions over those that are safe
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    // A ball is what Bullet sweeps.
    if (!effects::is_dynamic(body) || std::holds_alternative<scenes::SphereShape>(shapes[body.traits.shape].value) ||
        subject.collidable.partners(i, surfaces, is_surface) == 0)
      continue;
    const scenes::Vec3& v = body.velocity;
    const double fall = tumbling ? extent : std::max(0.0, dot(weight.up, body.position) - lowest);
    const double speed = std::sqrt(dot(v, v) + 2 * weight.gravity * fall), motion = speed * subject.scene.time.dt;
    const double half = half_thickness[body.traits.shape], safe = effects::safe_share(shapes[body.traits.shape]) * half;
    if (safe == 0 || motion / safe <= worst) continue;
    worst = motion / safe;
    motion_of_worst = motion;
    thickness_of_worst = 2 * half;
  }
  const int substeps = subject.scene.time.substeps;
  if (worst <= substeps) return;
  found.push_back({fmt::format("a body {:.3g} m thick that can come to move {:.3g} m in a step, and a mesh or height "
                               "field: it can fall through, swept or not",
                               thickness_of_worst, motion_of_worst / substeps),
                   fmt::format("None fell through that moved at most a quarter of its thickness: {:.0f} substeps",
                               std::ceil(worst)),
                   "thin_boxes_on_mesh_stable"});
}

void find_spring(const Subject& subject, const std::vector<double>& masses, std::vector<HardCase>& found) {
  const std::optional<effects::StiffSpring> spring = effects::stiffest_spring(subject, masses);
  if (!spring) return;
  found.push_back({fmt::format("a spring of {:.3g} N/m on {:.3g} kg, which swings in {:.3g} s: Bullet makes it softer, "
                               "until it swings in 25 substeps, {:.3g} s",
                               spring->stiffness, spring->mass, spring->swing, spring->shown),
                   fmt::format("It is as stiff as it says with {} substeps", spring->substeps),
                   {}});
}

}  // namespace

std::vector<double> masses_of(const Subject& subject) {
  scenes::ShapeSet shapes(subject.expanded.shapes);
  std::vector<double> masses;
  for (const Body& body : subject.expanded.bodies) {
    const scenes::BodyTraits& traits = body.traits;
    masses.push_back(!effects::is_dynamic(body) ? 0
                     : traits.mass              ? *traits.mass
                                                : *traits.density * shapes.solid(traits.shape).volume);
  }
  return masses;
}

std::vector<scenes::Vec3> centres_of(const Subject& subject) {
  constexpr double rounding = 1e-6;  // of the size of a body: points of files have few digits
  scenes::ShapeSet shapes(subject.expanded.shapes);
  std::vector<scenes::Vec3> centres;
  for (const Body& body : subject.expanded.bodies) {
    centres.push_back(body.position);
    if (!effects::is_dynamic(body)) continue;
    const std::size_t shape = body.traits.shape;
    const scenes::Vec3 aside = scenes::mass_of(body, shapes.solid(shape)).frame.origin;
    if (std::sqrt(dot(aside, aside)) > rounding * effects::size_of(subject.expanded.shapes, shape).largest)
      centres.back() = geometry::plus(body.position, geometry::turned(body.rotation, aside));
  }
  return centres;
}

std::vector<HardCase> hard_cases(const scenes::Scene& scene) {
  const scenes::Expanded expanded = scenes::expand(scene);
  const Subject subject{scene, expanded};
  const Weight weight = weight_of(scene.world);
  std::vector<HardCase> found;
  const std::vector<double> masses = masses_of(subject);
  if (weight.gravity > 0) {
    find_stack(subject, masses, weight, found);
    if (found.empty()) find_mass_ratio(subject, masses, weight, found);
    find_chain(subject, masses, weight, found);
    find_bounce(subject, found);
  }
  find_fast_on_surface(subject, weight, found);
  find_spring(subject, masses, found);
  return found;
}

}  // namespace boxstream::tool
