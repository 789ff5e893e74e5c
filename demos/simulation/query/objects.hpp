// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/narrowphase/collision_object.h>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"
#include "simulation/query/object_motion.hpp"

namespace boxstream::query {

/// A torus about y.
scenes::MeshShape ring_mesh(double radius, double tube, int around, int across);

/// A profile in the shape of an L, `thickness` thick, whose legs have `length`, drawn out along z to `width`.
scenes::MeshShape bracket_mesh(double length, double width, double thickness);

using Manager = ::fcl::BroadPhaseCollisionManager<double>;

/// What some managers need: where objects are expected, how large they are on average, how much farther apart
/// than touching they still pair.
struct Extent {
  ::fcl::AABB<double> all;
  double mean_side = 1;
  std::size_t objects = 1;
  double margin = 0;
};

/// One of manager_names(): boxstream; boxstream_tight, which makes its own boxes; FCL's own: tree, tree_array, ssap,
/// sap, interval, hash, naive.
std::unique_ptr<Manager> make_manager(const std::string& name, const Extent& extent);

/// False for managers whose update of a list of objects does not end.
bool updates_lists(const std::string& name);

/// An object whose box reaches farther than its shape, as some planners have it: they write into the box that FCL
/// keeps.
class WideObject final : public ::fcl::CollisionObject<double> {
 public:
  WideObject(const std::shared_ptr<::fcl::CollisionGeometry<double>>& geometry, std::size_t index, double margin)
      : CollisionObject(geometry), index_(index), half_margin_(margin / 2) {
    setUserData(this);
  }

  void move(const Pose& pose);
  std::size_t index() const { return index_; }
  static const WideObject& of(const ::fcl::CollisionObject<double>* object) {
    return *static_cast<const WideObject*>(object->getUserData());
  }

 private:
  std::size_t index_;
  double half_margin_;
};

/// FCL's objects for those on a motion, shared by all managers.
class Objects {
 public:
  Objects(const QueryScene& scene, const ObjectMotion& motion);

  /// Takes over the poses of what moves.
  void follow(const ObjectMotion& motion);

  using Pointers = std::vector<::fcl::CollisionObject<double>*>;
  const Pointers& all_of(std::size_t group) const { return all_[group]; }
  const Pointers& moving_of(std::size_t group) const { return moving_[group]; }
  Extent extent_of(std::size_t group) const;

 private:
  std::vector<double> margins_;     // of the groups
  std::deque<WideObject> objects_;  // they stay where they are
  std::vector<Pointers> all_, moving_;
  std::vector<Pose> to_fcl_;  // from the frame of an FCL shape to that of ours
};

}  // namespace boxstream::query
