// SPDX-License-Identifier: MIT
#include "boxstream/explain/price_list.hpp"

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "boxstream/shared/scene_files.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/repeated.hpp"
#include "measure/interleave.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::tool {
namespace {

using effects::Plan;
using scenes::Scene;
using scenes::Simulation;

constexpr double pitch = 24;  // grounds of the gallery are 20 m wide
constexpr int steps_not_timed = 10;

/// A scene, and what of it is built.
struct PricedScene {
  Scene scene;
  Plan plan;
};

Scene gallery(const std::string& name, int copies) {
  const Scene scene = scenes::load_scene(resolve_scene("effects/" + name, SceneKind::simulation).string());
  // Generators stay as they are, so there is nothing to repeat.
  return scene.generators.empty() ? scenes::repeated(scene, copies, pitch) : scene;
}

Plan changed(Plan plan, const effects::Effect& effect, bool on) {
  for (effects::Decision& decision : plan)
    if (decision.effect == &effect) decision.on = on;
  return plan;
}

/// Shapes and parts of joints have no code of their own to leave out: the price is that of the scene next to it.
const std::map<const effects::Effect*, std::string>& neighbours() {
  using namespace effects;
  static const std::map<const Effect*, std::string> scenes{
      {&planes, "contacts"},     {&meshes, "contacts"}, {&heightfields, "contacts"},     {&compounds, "contacts"},
      {&joint_limits, "joints"}, {&motors, "joints"},   {&collision_filters, "contacts"}};
  return scenes;
}

bool has_code(const effects::Effect& effect) {
  return effect.build.prepare != nullptr || effect.build.configure_body != nullptr || effect.build.start != nullptr;
}

std::uint64_t moving_bodies(const Simulation& simulation) {
  const scenes::Census census = simulation.census();
  return census.objects - census.fixed - census.sensors;
}

std::int64_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

/// One of the two interleaved worlds.
struct Runner {
  std::unique_ptr<Simulation> simulation;
  double bytes = 0, pairs = 0;

  void build(const PricedScene& subject) {
    bytes = -static_cast<double>(bytes_in_use());
    simulation = std::make_unique<Simulation>(subject.scene, "boxstream", Simulation::Wrap{}, subject.plan);
    bytes += static_cast<double>(bytes_in_use());
  }
  double step() {
    const std::int64_t before = bytes_in_use();
    const auto start = measure::now();
    simulation->advance();
    const std::chrono::duration<double, std::nano> time = measure::now() - start;
    bytes += static_cast<double>(bytes_in_use() - before);
    pairs += simulation->broadphase().getOverlappingPairCache()->getNumOverlappingPairs();
    return time.count();
  }
};

Difference timed(const PricedScene& with, const PricedScene& without, const PriceEffort& effort,
                 std::uint64_t& bodies) {
  std::vector<double> medians;
  double bytes = 0, pairs = 0;
  for (int round = 0; round < effort.rounds; ++round) {
    std::array<Runner, 2> runners;
    runners[0].build(with);
    runners[1].build(without);
    std::vector<double> differences;
    bodies = moving_bodies(*runners[0].simulation);
    for (int i = 0; i < effort.steps; ++i) {
      // With, without, without, with: neither is always the one that finds the caches cold.
      const std::size_t first = static_cast<std::size_t>(i % 2);
      std::array<double, 2> times{};
      times[first] = runners[first].step();
      times[1 - first] = runners[1 - first].step();
      if (i >= steps_not_timed) differences.push_back(times[0] - times[1]);
    }
    medians.push_back(measure::median(std::move(differences)));
    bytes += runners[0].bytes - runners[1].bytes;
    pairs += (runners[0].pairs - runners[1].pairs) / effort.steps;
  }
  const auto [least, greatest] = std::minmax_element(medians.begin(), medians.end());
  const double low = *least, high = *greatest, each = 1 / static_cast<double>(bodies),
               each_round = each / effort.rounds;
  return {measure::median(std::move(medians)) * each, low * each, high * each, bytes * each_round, pairs * each_round};
}

/// Of one step, of those that are timed otherwise.
double instructions_of(Simulation& simulation, int steps) {
  const auto run = [&](int count) {
    for (int i = 0; i < count; ++i) simulation.advance();
  };
  run(steps_not_timed);
  const double before = measure::counted_instructions();
  measure::time_once([&] { run(steps - steps_not_timed); });
  return (measure::counted_instructions() - before) / (steps - steps_not_timed);
}

/// Other work on the machine changes no count, so these worlds need not take turns.
Difference counted(const PricedScene& with, const PricedScene& without, const PriceEffort& effort,
                   std::uint64_t& bodies) {
  std::array<Runner, 2> runners;
  runners[0].build(with);
  runners[1].build(without);
  bodies = moving_bodies(*runners[0].simulation);
  Difference difference;
  difference.instructions =
      (instructions_of(*runners[0].simulation, effort.steps) - instructions_of(*runners[1].simulation, effort.steps)) /
      static_cast<double>(bodies);
  return difference;
}

}  // namespace

std::vector<Price> measure_prices(const PriceEffort& effort, StatusLine& status) {
  const auto compare = std::isnan(measure::counted_instructions()) ? timed : counted;
  std::vector<Price> prices;
  const std::size_t count = effects::all_effects().size();
  for (const effects::Effect* const effect : effects::all_effects()) {
    status.say(fmt::format("effect {} of {}: {}", prices.size() + 1, count, effect->name));
    Price price{effect->name, effect->name, effect->name, 0, {}, {}};
    PricedScene with{gallery(price.with, effort.copies), {}};
    with.plan = effects::plan(with.scene);
    // A world without sweeping must not switch it on.
    if (effect == &effects::ccd) with.plan = changed(std::move(with.plan), effects::ccd_on_demand, false);
    std::uint64_t uncalled_bodies = 0;
    if (const auto other = neighbours().find(effect); other != neighbours().end()) {
      price.without = other->second;
      const Scene scene = gallery(price.without, effort.copies);
      price.called = compare(with, {scene, effects::plan(scene)}, effort, price.bodies);
    } else if (has_code(*effect)) {
      price.called = compare(with, {with.scene, changed(with.plan, *effect, false)}, effort, price.bodies);
    }
    if (has_code(*effect)) {
      // Balls that glide over ice, or where these are the price, balls in empty space.
      Scene scene = gallery("contacts", effort.copies);
      if (effects::is_on(effects::plan(scene), *effect)) scene = gallery("nothing", effort.copies);
      const Plan plan = effects::plan(scene);
      price.uncalled = compare({scene, changed(plan, *effect, true)}, {scene, changed(plan, *effect, false)}, effort,
                               uncalled_bodies);
    }
    prices.push_back(std::move(price));
  }
  return prices;
}

std::string cost_text(const MeasuredPrice& price, const effects::Effect& effect) {
  const auto [ns, low, high] = price;
  if (low <= 0 && high >= 0) return fmt::format("within noise: {:.1f} to {:.1f}", low, high);
  // Of all effects one is there to save time.
  if (ns < 0 && &effect == &effects::sleeping) return fmt::format("saves {:.3g}", -ns);
  if (ns < 0) return fmt::format("noise: {:.3g}", ns);
  return fmt::format("{:.3g}", ns);
}

}  // namespace boxstream::tool
