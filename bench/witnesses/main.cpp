// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "base/output_file.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "witnesses/witness.hpp"

/// Runs a scene on an engine of others, and writes the table that `boxstream simulate --states` writes of ours, with
/// the energy of all bodies as one more column.
int main(int argc, char** argv) {
  using namespace boxstream;
  std::string name, file, states = "-", pyramid = "along";
  double accuracy = 1e-10;
  witnesses::OdeSettings ode;
  CLI::App app("Run a scene on an engine of others");
  app.add_option("engine", name, "simbody or ode")->required()->check(CLI::IsMember({"simbody", "ode"}));
  app.add_option("scene", file, "Scene file")->required();
  app.add_option("--states", states, "Write states here");
  app.add_option("--accuracy", accuracy, "Of Simbody's integrator")->check(CLI::Range(1e-13, 1e-2));
  app.add_option("--substeps", ode.substeps, "Of ODE in a step of the scene")->check(CLI::Range(1, 100000));
  app.add_option("--erp", ode.erp, "Share of the depth of a contact that ODE mends in a substep");
  app.add_option("--cfm", ode.cfm, "Softness of ODE's contacts");
  app.add_option("--pyramid", pyramid, "Friction of ODE is bounded along the way, or along fixed axes")
      ->check(CLI::IsMember({"along", "fixed"}));
  CLI11_PARSE(app, argc, argv);
  try {
    if (!(name == "simbody" ? witnesses::simbody_is_built() : witnesses::ode_is_built())) {
      fmt::print(stderr, "{} is not built in\n", name);
      return 3;
    }
    const scenes::Scene scene = scenes::load_scene(file);
    const auto steps = static_cast<std::size_t>(scene.time.steps);
    ode.along = pyramid == "along";
    std::vector<witnesses::Frame> frames;
    try {
      frames = name == "simbody" ? witnesses::run_simbody(scene, steps, accuracy) : run_ode(scene, steps, ode);
    } catch (const witnesses::Unknown& reason) {
      fmt::print(stderr, "{}: no witness by {}: {}\n", file, name, reason.what());
      return 2;
    }
    std::string text = "step,seconds,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz,energy\n";
    std::size_t step = 0;
    for (const witnesses::Frame& frame : frames) {
      for (const auto& [body, p, q, v, w] : frame.bodies)
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", step,
                       static_cast<double>(step) * scene.time.dt, body, p[0], p[1], p[2], q[0], q[1], q[2], q[3], v[0],
                       v[1], v[2], w[0], w[1], w[2], frame.energy);
      ++step;
    }
    files::write_file(states, text);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
