// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <fcl/geometry/shape/sphere.h>

#include <boxstream/fcl.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace boxstream::fcl_test {

template <class S>
using Manager = boxstream::fcl::CollisionManager<S>;
template <class S>
using Base = ::fcl::BroadPhaseCollisionManager<S>;
template <class S>
using Object = ::fcl::CollisionObject<S>;
template <class S>
using FclBox = ::fcl::AABB<S>;

template <class S>
constexpr S inf = std::numeric_limits<S>::infinity();
template <class S>
constexpr S nan = std::numeric_limits<S>::quiet_NaN();
template <class S>
constexpr S largest = std::numeric_limits<S>::max();

template <class S>
FclBox<S> make_box(S x0, S y0, S z0, S x1, S y1, S z1) {
  FclBox<S> box;
  box.min_ = ::fcl::Vector3<S>(x0, y0, z0);
  box.max_ = ::fcl::Vector3<S>(x1, y1, z1);
  return box;
}

template <class S>
FclBox<S> cube(S x, S y, S z, S half = S(0.5)) {
  return make_box<S>(x - half, y - half, z - half, x + half, y + half, z + half);
}

/// An object whose box is what we write, as Tesseract's objects do it (clause C1).
template <class S>
class BoxObject : public Object<S> {
 public:
  explicit BoxObject(const FclBox<S>& box, int name = -1) : Object<S>(sphere()), name_(name) { set(box); }

  void set(const FclBox<S>& box) { this->aabb = box; }
  int name() const { return name_; }

 private:
  static const std::shared_ptr<::fcl::CollisionGeometry<S>>& sphere() {
    static const std::shared_ptr<::fcl::CollisionGeometry<S>> one = std::make_shared<::fcl::Sphere<S>>(S(1));
    return one;
  }

  int name_;
};

/// Objects named 0, 1, 2 ... and pointers to them.
template <class S>
class Scene {
 public:
  Scene() = default;
  explicit Scene(const std::vector<FclBox<S>>& boxes) {
    for (const FclBox<S>& box : boxes) add(box);
  }

  BoxObject<S>& add(const FclBox<S>& box) {
    objects_.push_back(std::make_unique<BoxObject<S>>(box, static_cast<int>(objects_.size())));
    pointers_.push_back(objects_.back().get());
    return *objects_.back();
  }

  BoxObject<S>& operator[](std::size_t i) { return *objects_[i]; }
  std::size_t size() const { return objects_.size(); }
  const std::vector<Object<S>*>& pointers() const { return pointers_; }
  void free_all() { objects_.clear(); }

 private:
  std::vector<std::unique_ptr<BoxObject<S>>> objects_;
  std::vector<Object<S>*> pointers_;
};

template <class S>
int name_of(const Object<S>* object) {
  return static_cast<const BoxObject<S>*>(object)->name();
}

/// The names in the calls of a query, in order.
using Calls = std::vector<std::pair<int, int>>;

/// Some order, so that calls can be compared that come in any.
inline Calls in_any_order(Calls calls) {
  std::sort(calls.begin(), calls.end());
  return calls;
}

inline Calls sorted(Calls calls) {
  for (auto& call : calls)
    if (call.second < call.first) std::swap(call.first, call.second);
  std::sort(calls.begin(), calls.end());
  return calls;
}

template <class S>
bool record(Object<S>* a, Object<S>* b, void* calls) {
  static_cast<Calls*>(calls)->push_back({name_of(a), name_of(b)});
  return false;
}

template <class S>
bool record_distance(Object<S>* a, Object<S>* b, void* calls, S&) {
  return record(a, b, calls);
}

template <class S>
Calls collide(const Base<S>& manager) {
  Calls calls;
  manager.collide(&calls, record<S>);
  return calls;
}
/// These two in no order: see interface_test.cpp for that of registration.
template <class S>
Calls collide(const Base<S>& manager, Object<S>& object) {
  Calls calls;
  manager.collide(&object, &calls, record<S>);
  return in_any_order(calls);
}
template <class S>
Calls collide(const Base<S>& manager, Base<S>& other) {
  Calls calls;
  manager.collide(&other, &calls, record<S>);
  return in_any_order(calls);
}

template <class S>
bool is_inside_out(const FclBox<S>& box) {
  return (box.min_.array() > box.max_.array()).any();
}

/// What FCL says about two boxes, except that a box that is inside out touches nothing.
template <class S>
bool touch(const FclBox<S>& a, const FclBox<S>& b) {
  return !is_inside_out(a) && !is_inside_out(b) && a.overlap(b);
}

/// Brute force over boxes as they were when last read.
template <class S>
struct Oracle {
  struct Entry {
    BoxObject<S>* object;
    FclBox<S> box;
  };
  std::vector<Entry> entries;  // in order of registration
  typename Manager<S>::BoxSource source = nullptr;
  S reach = 0;  // half of the margin

  /// The box of an object as the manager is to read it now.
  FclBox<S> read(const Object<S>& object) const {
    FclBox<S> box = source != nullptr ? source(object) : object.getAABB();
    if (!(reach > 0) || is_inside_out(box)) return box;
    for (int d = 0; d < 3; ++d) {
      box.min_[d] = std::nextafter(box.min_[d] - reach, -inf<S>);
      box.max_[d] = std::nextafter(box.max_[d] + reach, inf<S>);
    }
    return box;
  }
  auto find(const Object<S>* object) {
    return std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.object == object; });
  }
  auto find(const Object<S>* object) const { return const_cast<Oracle*>(this)->find(object); }
  void put(BoxObject<S>& object) {
    const auto found = find(&object);
    if (found == entries.end())
      entries.push_back({&object, read(object)});
    else
      found->box = read(object);
  }
  void erase(BoxObject<S>& object) {
    const auto found = find(&object);
    if (found != entries.end()) entries.erase(found);
  }
  void look(BoxObject<S>& object) {
    const auto found = find(&object);
    if (found != entries.end()) found->box = read(object);
  }
  void look() {
    for (Entry& entry : entries) entry.box = read(*entry.object);
  }

  Calls collide() const {
    Calls calls;
    for (std::size_t i = 0; i < entries.size(); ++i)
      for (std::size_t j = i + 1; j < entries.size(); ++j)
        if (touch(entries[i].box, entries[j].box))
          calls.push_back({entries[i].object->name(), entries[j].object->name()});
    return calls;
  }
  Calls collide(const BoxObject<S>& object) const {
    Calls calls;
    const FclBox<S> box = read(object);
    for (const Entry& entry : entries)
      if (entry.object != &object && touch(entry.box, box)) calls.push_back({entry.object->name(), object.name()});
    return in_any_order(calls);
  }
  Calls collide(const Oracle& other) const {
    Calls calls;
    for (const Entry& a : entries)
      for (const Entry& b : other.entries)
        if (a.object != b.object && touch(a.box, b.box)) calls.push_back({a.object->name(), b.object->name()});
    return in_any_order(calls);
  }
};

/// Names the first difference.
inline ::testing::AssertionResult same_calls(const char*, const char*, const Calls& is, const Calls& ought) {
  const auto text = [](const Calls& calls, std::size_t i) {
    return i < calls.size() ? "(" + std::to_string(calls[i].first) + ", " + std::to_string(calls[i].second) + ")"
                            : "none";
  };
  for (std::size_t i = 0; i < std::max(is.size(), ought.size()); ++i)
    if (i >= is.size() || i >= ought.size() || is[i] != ought[i])
      return ::testing::AssertionFailure() << "call " << i << " is " << text(is, i) << ", not " << text(ought, i)
                                           << "; " << is.size() << " calls, not " << ought.size();
  return ::testing::AssertionSuccess();
}
#define ASSERT_CALLS(is, ought) ASSERT_PRED_FORMAT2(::boxstream::fcl_test::same_calls, is, ought)
#define EXPECT_CALLS(is, ought) EXPECT_PRED_FORMAT2(::boxstream::fcl_test::same_calls, is, ought)

/// Cubes of side 1, `pairs` of them touching each one on average.
template <class S>
std::vector<FclBox<S>> random_cubes(std::size_t count, double pairs, std::mt19937& random) {
  const double side = std::cbrt(8.0 * static_cast<double>(count) / pairs);
  std::uniform_real_distribution<double> at(0, side);
  std::vector<FclBox<S>> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<S>(at(random)), y = static_cast<S>(at(random)), z = static_cast<S>(at(random));
    boxes.push_back(cube<S>(x, y, z));
  }
  return boxes;
}

/// Coordinates on a coarse grid, so that boxes share faces, edges, corners and everything.
template <class S>
FclBox<S> random_grid_box(std::mt19937& random, int cells, int longest) {
  std::uniform_int_distribution<int> at(0, cells), length(0, longest);
  FclBox<S> box;
  for (int d = 0; d < 3; ++d) {
    box.min_[d] = static_cast<S>(at(random));
    box.max_[d] = box.min_[d] + static_cast<S>(length(random));
  }
  return box;
}

using Scalars = ::testing::Types<float, double>;

}  // namespace boxstream::fcl_test
