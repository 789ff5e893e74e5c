// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/pair.hpp>
#include <cstdint>
#include <vector>

#include "pictures/viewer/model.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

struct Pose {
  Point position{};
  Rotation rotation = no_rotation;
};

/// What one object is doing.
enum class Mood : std::uint8_t { fixed, kinematic, moving, sleeping, soft, sensor, character, gone, wheel };

/// A point where two objects touch; the normal points from `objects.b` to `objects.a`.
struct Contact {
  Pair objects;
  Point place{}, normal{};
};

/// A world between two steps. Poses and nodes are those that the last step left; boxes and pairs are those of its
/// broad-phase, which ran before the objects were moved. Objects are those that the model keeps, by their places among
/// them; wheels of vehicles follow, without boxes.
struct Snapshot {
  struct Box {
    Point min{}, max{};
  };

  std::vector<Pose> poses;            ///< of each object
  std::vector<Point> nodes;           ///< of all soft bodies, one after the other
  std::vector<Mood> moods;            ///< of each object; gone: taken out of the world
  std::vector<std::int32_t> islands;  ///< of each object: the first kept one of those that it may push; -1: none
  std::vector<Box> boxes;             ///< of each object, in the broad-phase; those that are gone have min > max
  std::vector<Pair> pairs;            ///< sorted; of objects that are both kept
  std::vector<Contact> contacts;      ///< those that `read_contacts` found, by their objects

  /// Reads `simulation` and changes nothing in it. Of the two signs that a rotation has, takes the one nearer to what
  /// was read before, so that rotations can be interpolated from snapshot to snapshot. Throws std::runtime_error if the
  /// world does not have the objects of `model`.
  void read(const scenes::Simulation& simulation, const Model& model);

  /// Contact points of the last step whose surfaces meet or overlap: those of its narrow phase, before objects were
  /// moved. Of objects that are both kept.
  void read_contacts(const scenes::Simulation& simulation, const Model& model);
};

/// The bounds of what moves, without the outermost 1 % on each side; of everything that is bounded if nothing moves.
/// A few bodies that flew off would make all others small in a picture.
Snapshot::Box crowd_of(const Snapshot& snapshot);

/// From where a page looks at the crowd when it opens.
inline constexpr Point first_direction{0.62F, 0.5F, 0.85F};

/// Where its camera is then. How far exactly depends on the window.
Point first_eye(const Snapshot::Box& crowd);

}  // namespace boxstream::view
