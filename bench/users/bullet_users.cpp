// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "suites/race.hpp"
#include "users/bare_broadphases.hpp"
#include "users/bullet_games.hpp"
#include "users/scene_world.hpp"

namespace boxstream::bench {

namespace {

const std::vector<BareCase> bare_cases = {{"bare:asleep", 0, BareCase::plain, {10, 50, 250, 1000}},
                                          {"bare:slow", 0.01, BareCase::plain, {10, 50, 250, 1000}},
                                          {"bare:creep", 0.002, BareCase::plain, {105, 301, 1005, 3000}},
                                          {"bare:fast", 0.3, BareCase::plain, {10, 50, 250, 1000}},
                                          {"bare:refused", 0.3, BareCase::refused, {2500, 10000}},
                                          {"bare:eager", 0.03, BareCase::eager, {100, 500, 2000, 5000}}};

/// Rebuilt from the descriptions of Bullet's own benchmarks and demos.
const std::vector<SceneCase> demo_cases = {
    {"bullet1", {{"", warm_up_steps, 200}}, 30}, {"bullet2", {{"", warm_up_steps, 120}}, 40},
    {"bullet3", {{"", warm_up_steps, 200}}, 30}, {"bullet4", {{"", warm_up_steps, 200}}, 30},
    {"bullet7", {{"", warm_up_steps, 150}}, 25}, {"bullet8", {{"", warm_up_steps, 200}}, 30},
    {"cloth", {{"", warm_up_steps, 300}}, 60},
};

template <class Case>
auto find(const std::vector<Case>& cases, const std::string& name, std::string Case::*key) {
  return std::find_if(cases.begin(), cases.end(), [&](const Case& each) { return each.*key == name; });
}

/// Natives that can hold `objects`; a sort by insertion of more than 10^4 takes too long for `quick`.
std::vector<std::string> natives(const Options& options, std::size_t objects) {
  std::vector<std::string> names = options.peers;
  if (names.empty()) names = {"hybrid", "dbvt", "dbvt-deferred", "sap16", "sap"};
  std::erase_if(names, [&](const std::string& name) {
    const bool sorts = name == "sap" || name == "sap16";
    return !can_hold(name, objects) || (sorts && options.quick && objects > 10000);
  });
  return names;
}

std::unique_ptr<Game> make_game(const GameCase& chosen, int n, const Options& options, const std::string& broadphase) {
  Game::Setup setup;
  setup.broadphase = broadphase;
  setup.borrows_cache = chosen.borrows_cache;
  setup.most = std::size_t(2 * n) + 6000;
  setup.seed = options.seed;
  auto game = std::make_unique<Game>(setup);
  chosen.build(*game, n);
  return game;
}

void run_stepped(const GameCase& chosen, std::vector<std::unique_ptr<SteppedWorld>> worlds, const Options& options,
                 Report& report, Progress& progress) {
  const int steps = options.steps > 0 ? options.steps : options.quick ? std::min(chosen.steps, 60) : chosen.steps;
  contest_steps({"users", chosen.name, {{"", std::min(warm_up_steps, steps - 1), steps}}}, std::move(worlds), report,
                progress);
}

/// For worlds in which nothing moves: enough calls to make the clock's resolution irrelevant.
void run_resting(const GameCase& chosen, std::vector<std::unique_ptr<SteppedWorld>> worlds, const Options& options,
                 Report& report, Progress& progress) {
  for (const auto& world : worlds) world->step(true);
  const SteppedWorld& ours = *worlds.front();
  const auto detect = [](SteppedWorld& world) { return [&game = static_cast<Game&>(world)] { game.detect_only(); }; };
  Race race(options, report, progress,
            {.suite = "users", .case_name = chosen.name, .n = ours.objects(), .k = ours.pairs()});
  for (std::size_t i = 1; i < worlds.size(); ++i)
    race.add(worlds[i]->broadphase(), detect(*worlds[i]),
             [&, i] { return ours.difference().empty() && worlds[i]->difference().empty(); });
  race.run(detect(*worlds.front()));
}

void run_game(const GameCase& chosen, int n, const Options& options, Report& report, Progress& progress) {
  progress.show(fmt::format("users {}, {}: settles", chosen.name, n));
  Game::State state;
  if (chosen.settle > 0) {
    const auto game = make_game(chosen, n, options, "dbvt");
    for (int step = 0; step < chosen.settle; ++step) game->step(false);
    state = game->state();
  }
  std::vector<std::unique_ptr<SteppedWorld>> worlds;
  std::vector<std::string> broadphases = natives(options, std::size_t(n) * (chosen.borrows_cache ? 13 : 2) + 6000);
  broadphases.insert(broadphases.begin(), "boxstream");
  for (const std::string& broadphase : broadphases) {
    auto game = make_game(chosen, n, options, broadphase);
    if (chosen.settle > 0) game->restore(state);
    worlds.push_back(std::move(game));
  }
  if (chosen.only_detects)
    run_resting(chosen, std::move(worlds), options, report, progress);
  else
    run_stepped(chosen, std::move(worlds), options, report, progress);
}

std::vector<int> sizes_of(const std::vector<int>& all, const std::vector<int>& quick, const Options& options) {
  if (options.sizes.empty()) return options.quick ? quick : all;
  return {options.sizes.begin(), options.sizes.end()};
}

void run_demo(const SceneCase& demo, const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> peers = natives(options, 0);
  std::erase(peers, "sap16");
  run_scene({"users", Part::pairs}, demo, options, peers, report, progress);
}

void run_case(const std::string& name, const Options& options, Report& report, Progress& progress) {
  const auto bare = find(bare_cases, name, &BareCase::name);
  const auto game = find(game_cases(), name, &GameCase::name);
  const auto demo = find(demo_cases, name, &SceneCase::scene);
  if (bare != bare_cases.end())
    for (const int n : sizes_of(bare->sizes, bare->sizes, options))
      run_bare("users", *bare, n, options, natives(options, std::size_t(n)), report, progress);
  if (game != game_cases().end())
    for (const int n : sizes_of(game->sizes, game->quick_sizes, options)) run_game(*game, n, options, report, progress);
  if (demo != demo_cases.end()) run_demo(*demo, options, report, progress);
}

}  // namespace

void run_bullet_users(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty()) {
    for (const BareCase& bare : bare_cases) cases.push_back(bare.name);
    for (const GameCase& game : game_cases()) cases.push_back(game.name);
    for (const SceneCase& demo : demo_cases) cases.push_back(demo.scene);
  }
  for (const std::string& name : cases) run_case(name, options, report, progress);
}

std::vector<CaseText> bullet_user_texts() {
  std::vector<CaseText> texts = texts_of(game_cases());
  for (const BareCase& bare : bare_cases) texts.push_back({bare.name, "a broad-phase alone"});
  for (const SceneCase& demo : demo_cases) texts.push_back({demo.scene, "the scene of that name"});
  return texts;
}

}  // namespace boxstream::bench
