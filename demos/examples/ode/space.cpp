// SPDX-License-Identifier: MIT
#include "examples/ode/space.hpp"

#include <ode/objects.h>

#include <algorithm>
#include <cmath>

namespace boxstream::ode {

namespace {

using Box = BasicAabb<dReal>;

/// Inside out, so that it touches nothing, if the geom is disabled.
Box box_of(dGeomID geom) {
  if (!dGeomIsEnabled(geom)) return {{1, 1, 1}, {-1, -1, -1}};
  dReal sides[6];
  dGeomGetAABB(geom, sides);
  return {{sides[0], sides[2], sides[4]}, {sides[1], sides[3], sides[5]}};
}

/// Either object's bits may admit the pair; a filter of boxstream takes both.
bool may_collide(dGeomID a, dGeomID b) {
  if (a == b || (dGeomGetBody(a) != nullptr && dGeomGetBody(a) == dGeomGetBody(b))) return false;
  return (dGeomGetCategoryBits(a) & dGeomGetCollideBits(b)) != 0 ||
         (dGeomGetCategoryBits(b) & dGeomGetCollideBits(a)) != 0;
}

dReal distance_of(const Box& a, const Box& b) {
  dReal sum = 0;
  for (int d = 0; d < 3; ++d) {
    const dReal gap = std::max({dReal(0), a.min[d] - b.max[d], b.min[d] - a.max[d]});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

}  // namespace

void Space::add(dGeomID geom) {
  if (!contains(geom)) set_.add(geom, box_of(geom), Filter{}, false);
}

void Space::remove(dGeomID geom) {
  const Place place = set_.table().find(geom);
  if (place != Set::none) set_.remove(place);
}

void Space::update() {
  for (Place place = 0; place < set_.table().places(); ++place)
    if (const dGeomID geom = geom_at(set_, place)) set_.set_box(place, box_of(geom));
}

void Space::update(dGeomID geom) {
  const Place place = set_.table().find(geom);
  if (place != Set::none) set_.set_box(place, box_of(geom));
}

void Space::collide(void* data, dNearCallback* callback) const {
  set_.for_each_pair([&](Place a, Place b) {
    const dGeomID first = geom_at(set_, a), second = geom_at(set_, b);
    if (may_collide(first, second)) callback(data, first, second);
    return true;
  });
}

void Space::collide(dGeomID geom, void* data, dNearCallback* callback) const {
  set_.for_each_overlap(box_of(geom), Filter{}, Set::Order::any, [&](Place place) {
    const dGeomID mine = geom_at(set_, place);
    if (may_collide(mine, geom)) callback(data, mine, geom);
    return true;
  });
}

void Space::collide(const Space& other, void* data, dNearCallback* callback) const {
  set_.for_each_pair(other.set_, Set::Order::any, [&](Place a, Place b) {
    const dGeomID mine = geom_at(set_, a), theirs = geom_at(other.set_, b);
    if (may_collide(mine, theirs)) callback(data, mine, theirs);
    return true;
  });
}

dGeomID Space::nearest(dGeomID geom, dReal limit) const {
  const Box box = box_of(geom);
  dGeomID best = nullptr;
  set_.for_each_near(box, Filter{}, limit, [&](Place place) {
    const dGeomID mine = geom_at(set_, place);
    const dReal distance = distance_of(set_.table().box(place), box);
    if (!may_collide(mine, geom) || !(distance < limit)) return limit;
    best = mine;
    return limit = distance;
  });
  return best;
}

}  // namespace boxstream::ode
