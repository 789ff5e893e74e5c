// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"

/// scene_steps called|all|told|account SCENE STEPS: runs a scene with what it calls for; with everything; or with what
/// it calls for, in steps that are told of without the account of energy or with it. Prints the hash of the state that
/// it ends in.
int main(int, char** argv) {
  using namespace boxstream;
  const bool all = argv[1] == std::string_view("all");
  scenes::Simulation simulation(scenes::load_scene(argv[2]), "boxstream", {},
                                all ? effects::Extent::all : effects::Extent::only_called);

  const bool accounts = argv[1] == std::string_view("account"), tells = accounts || argv[1] == std::string_view("told");
  for (int i = std::atoi(argv[3]); i > 0; --i)
    if (tells)
      simulation.step({.events = false, .hash = false, .energy = accounts});
    else
      simulation.advance();
  fmt::print("{:016x}\n", simulation.state_hash());
  return 0;
}
