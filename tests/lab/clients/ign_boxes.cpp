// SPDX-License-Identifier: MIT
// Boxes fall on the Bullet plugin of ign-physics, which makes a btDbvtBroadphase of its own. ign_boxes PLUGIN STEPS:
// prints where each of them is in the end. It ends without the plugin's destructor: see docs/clients.md.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/sdf/ConstructLink.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>
#include <string>
#include <vector>

namespace {

namespace physics = ignition::physics;

using Features =
    physics::FeatureList<physics::ForwardStep, physics::LinkFrameSemantics, physics::sdf::ConstructSdfWorld,
                         physics::sdf::ConstructSdfModel, physics::sdf::ConstructSdfLink>;

void load(sdf::Root& root, const std::string& text) {
  for (const sdf::Error& error : root.LoadSdfString("<sdf version='1.6'>" + text + "</sdf>")) {
    std::fprintf(stderr, "SDF: %s\n", error.Message().c_str());
    std::exit(1);
  }
}

std::string shape(const std::string& size) {
  return "<collision name='shape'><geometry><box><size>" + size + "</size></box></geometry></collision>";
}

std::string box(int i) {
  return "<model name='box" + std::to_string(i) + "'><pose>" + std::to_string(0.11 * (i % 4) - 0.2) + " " +
         std::to_string(0.09 * (i % 3)) + " " + std::to_string(0.5 + 0.4 * i) + " 0.1 0.2 0." + std::to_string(i) +
         "</pose><link name='link'><inertial><mass>1</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz>"
         "</inertia></inertial>" +
         shape(std::to_string(0.3 + 0.01 * (i % 7)) + " 0.3 0.25") + "</link></model>";
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return std::fputs("ign_boxes PLUGIN STEPS\n", stderr), 2;
  ignition::plugin::Loader loader;
  loader.LoadLib(arguments[1]);
  const auto engine = physics::RequestEngine3d<Features>::From(loader.Instantiate("ignition::physics::bullet::Plugin"));
  if (!engine) return std::fputs("no engine in the plugin\n", stderr), 1;
  sdf::Root yard;
  load(yard,
       "<world name='yard'><model name='floor'><static>true</static><link name='link'><pose>0 0 -0.5 0 0 0</pose>" +
           shape("20 20 1") + "</link></model></world>");
  const auto world = engine->ConstructWorld(*yard.WorldByIndex(0));
  std::vector<physics::Link3dPtr<Features>> links;
  for (int i = 0; i < 30; ++i) {
    sdf::Root one;
    load(one, box(i));
    // A link that is constructed with its model is found by nothing that this plugin offers.
    sdf::Model empty;
    empty.SetName(one.Model()->Name());
    empty.SetRawPose(one.Model()->RawPose());
    links.push_back(world->ConstructModel(empty)->ConstructLink(*one.Model()->LinkByIndex(0)));
  }
  physics::ForwardStep::Input input;
  input.Get<std::chrono::steady_clock::duration>() =
      std::chrono::milliseconds(2);  // read without asking if it is there
  physics::ForwardStep::Output output;
  physics::ForwardStep::State state;
  for (int step = std::atoi(arguments[2]); step > 0; --step) world->Step(output, state, input);
  for (const auto& link : links) {
    const auto place = link->FrameDataRelativeToWorld().pose.translation();
    std::printf("%.17g %.17g %.17g\n", place.x(), place.y(), place.z());
  }
  std::fflush(stdout);
  std::_Exit(0);
}
