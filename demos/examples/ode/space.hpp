// SPDX-License-Identifier: MIT
#pragma once

#include <ode/collision.h>
#include <ode/collision_space.h>

#include <cstddef>

#include <boxstream/executor.hpp>
#include <boxstream/object_set.hpp>

namespace boxstream::ode {

/// Stands in for a space of ODE. It is no dSpaceID, because ODE has no means to add a kind: geoms are added here
/// instead of there, and the functions are called by other names.
///
///     boxstream::ode::Space space;      // was: dSpaceID space = dHashSpaceCreate(nullptr);
///     space.add(geom);                  // dSpaceAdd(space, geom);
///     space.update();                   // (ODE's spaces see for themselves what has moved)
///     space.collide(data, &near);       // dSpaceCollide(space, data, &near);
///
/// Pairs are those of ODE's spaces: enabled geoms whose boxes touch, of which one's category bits meet the other's
/// collide bits, and that are not of one body. Boxes and whether a geom is enabled are read by `add` and `update`, all
/// else when it is asked. A space in a space, and rays, are not for it.
///
/// Const members may run on many threads, but for what ODE does in the callback.
class Space {
 public:
  explicit Space(Executor* executor = nullptr) : set_(executor) {}

  /// Adding one again, or removing one that is not there, does nothing.
  void add(dGeomID geom);
  void remove(dGeomID geom);
  bool contains(dGeomID geom) const { return set_.table().find(geom) != Set::none; }
  std::size_t size() const { return set_.table().size(); }

  void update();
  void update(dGeomID geom);

  void collide(void* data, dNearCallback* callback) const;
  /// With a geom that may be in the space, and then does not meet itself.
  void collide(dGeomID geom, void* data, dNearCallback* callback) const;
  /// With another space.
  void collide(const Space& other, void* data, dNearCallback* callback) const;

  /// Null, or the geom with the nearest box to that of `geom`, if that is nearer than `limit`, but for those with which
  /// it would not collide.
  dGeomID nearest(dGeomID geom, dReal limit) const;

 private:
  using Set = BasicObjectSet<dReal>;
  using Place = Set::Place;

  static dGeomID geom_at(const Set& set, Place place) { return static_cast<dGeomID>(set.table().object(place)); }

  Set set_;
};

}  // namespace boxstream::ode
