// SPDX-License-Identifier: MIT
#include "users/fcl_things.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace boxstream::bench {

namespace {

using Object = ::fcl::CollisionObject<double>;

const FclThing& thing(const Object* object) {
  return *static_cast<const FclThing*>(object);
}

FclAsked& asked_of(void* data) {
  return *static_cast<FclAsked*>(data);
}

bool are_neighbours(const Object* x, const Object* y) {
  const std::uint32_t a = thing(x).index(), b = thing(y).index();
  return a + 2 >= b && b + 2 >= a;
}

}  // namespace

FclThing::FclThing(std::uint32_t index, const FclVector& at, const FclVector& half, double reach)
    : CollisionObject(std::make_shared<::fcl::Sphere<double>>(half.minCoeff())),
      index_(index),
      home_(at),
      half_(half + FclVector::Constant(reach)),
      radius_(half.minCoeff()) {
  place(at);
}

FclThing::FclThing(std::uint32_t index)
    : CollisionObject(std::make_shared<::fcl::Halfspace<double>>(FclVector::UnitZ(), 0.0)),
      index_(index),
      home_(0, 0, 0),
      at_(0, 0, 0),
      half_(0, 0, 0),
      is_ground_(true) {
  computeAABB();
}

void FclThing::place(const FclVector& at) {
  at_ = at;
  if (is_ground_) return;
  aabb.min_ = at - half_;
  aabb.max_ = at + half_;
}

double distance_of(const FclThing& a, const FclThing& b) {
  if (a.is_ground_) return b.at_[2] - b.radius_;
  if (b.is_ground_) return a.at_[2] - a.radius_;
  return (a.at_ - b.at_).norm() - (a.radius_ + b.radius_);
}

void FclThings::sway(int frame, double reach) {
  for (FclThing& thing : all) {
    const double t = (0.5 + 0.37 * (thing.index() % 7)) * frame + thing.index();
    thing.place(thing.home() + reach * FclVector(std::sin(t), std::sin(t + 1), std::sin(1.3 * t + 2)));
  }
}

void FclAsked::note(const FclThing& a, const FclThing& b) {
  ++found.hits;
  if (!names_pairs) return;
  found.pairs.add(groups + std::min(a.index(), b.index()), groups + std::max(a.index(), b.index()));
}

void FclAsked::note_least() {
  found.distances = (found.distances + std::bit_cast<std::uint64_t>(least)) * 0x9e3779b97f4a7c15u;
  least = 1e300;
}

bool on_contact(Object* x, Object* y, void* data) {
  FclAsked& asked = asked_of(data);
  ++asked.found.calls;
  asked.note(thing(x), thing(y));
  return false;
}

bool on_first_contact(Object*, Object*, void* data) {
  FclAsked& asked = asked_of(data);
  ++asked.found.calls;
  ++asked.found.hits;
  return true;
}

bool on_contact_of_links(Object* x, Object* y, void* data) {
  return !are_neighbours(x, y) && on_contact(x, y, data);
}

bool on_distance(Object* x, Object* y, void* data, double& limit) {
  FclAsked& asked = asked_of(data);
  ++asked.found.calls;
  asked.least = std::min(asked.least, std::max(0.0, distance_of(thing(x), thing(y))));
  limit = asked.least;
  return limit <= 0;
}

bool on_distance_of_links(Object* x, Object* y, void* data, double& limit) {
  if (!are_neighbours(x, y)) return on_distance(x, y, data, limit);
  ++asked_of(data).found.calls;
  return false;
}

bool on_distance_without_limit(Object* x, Object* y, void* data, double&) {
  FclAsked& asked = asked_of(data);
  ++asked.found.calls;
  asked.least = std::min(asked.least, distance_of(thing(x), thing(y)));
  return false;
}

bool on_distance_up_to_constant(Object* x, Object* y, void* data, double& limit) {
  constexpr double wanted = 0.1;
  FclAsked& asked = asked_of(data);
  ++asked.found.calls;
  limit = wanted;
  if (distance_of(thing(x), thing(y)) < wanted) asked.note(thing(x), thing(y));
  return false;
}

}  // namespace boxstream::bench
