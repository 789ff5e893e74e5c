// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "formats/scene_model/actors.hpp"
#include "formats/scene_model/bodies.hpp"
#include "formats/scene_model/checks.hpp"
#include "formats/scene_model/expect.hpp"
#include "formats/scene_model/fields.hpp"
#include "formats/scene_model/generators.hpp"
#include "formats/scene_model/joints.hpp"
#include "formats/scene_model/queries.hpp"
#include "formats/scene_model/settings.hpp"
#include "formats/scene_model/shapes.hpp"
#include "formats/scene_model/soft_bodies.hpp"
#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// A scene as its file states it: plain data, checked, names resolved to indices, nothing of an engine in it.
/// Units are SI; y is up. Docs of each field: demos/scenes/README.md.
struct Scene {
  std::string file;                    // where it came from, for messages
  std::vector<std::string> old_words;  // of its file, each with what it is called now: `"rain" is "respawn" now`
  Meta meta;
  Time time;
  WorldSettings world;
  Solver solver;
  BroadphaseSettings broadphase;
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Generator> generators;
  std::vector<Joint> joints;
  std::vector<Sensor> sensors;
  std::vector<Character> characters;
  std::vector<SoftBody> soft_bodies;
  std::vector<Vehicle> vehicles;
  std::vector<Field> fields;
  std::vector<Query> queries;
  std::vector<std::array<std::size_t, 2>> exclusions;  // pairs of bodies that pass through each other
  EffectWishes effects;
  std::vector<Check> checks;
  Outputs outputs;
  Expect expect;
};

/// The same scene with about `factor` (> 0) times as many generated bodies: counts scale with `factor`, rooms and
/// lattices with its cube root, walls, grounds, groups of pyramids and cloths with its square root, so that densities
/// stay. Single bodies, chains and sensors stay as they are, and grids that say so; `expect` is dropped because it
/// speaks of the full size. Where the world is self-similar, places, speeds and gravity scale like rooms.
///
/// Throws std::invalid_argument: the factor is not positive, or there would be more than `most_scaled_bodies`.
Scene scaled(const Scene& scene, double factor);

}  // namespace boxstream::scenes
