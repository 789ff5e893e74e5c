// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/geometry/shape/sphere.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "peers/peer.hpp"

namespace boxstream::bench {

/// An object with a given box. An application would have FCL compute it from a shape and a transform: leaving that out
/// favours FCL.
template <class S>
class FclObject : public ::fcl::CollisionObject<S> {
 public:
  FclObject(const std::shared_ptr<::fcl::CollisionGeometry<S>>& geometry, std::uint32_t index, const Aabb& box)
      : ::fcl::CollisionObject<S>(geometry) {
    this->setUserData(reinterpret_cast<void*>(std::uintptr_t{index}));
    set(box);
  }

  void set(const Aabb& box) {
    for (int d = 0; d < 3; ++d) {
      this->aabb.min_[d] = static_cast<S>(box.min[d]);
      this->aabb.max_[d] = static_cast<S>(box.max[d]);
    }
  }
};

/// The index that an object was made with.
template <class S>
std::uint32_t fcl_index(const ::fcl::CollisionObject<S>* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
}

/// One of FCL's managers over scalar S; see FclManagerKind.
template <class S>
class FclPeer final : public Peer {
 public:
  using Manager = ::fcl::BroadPhaseCollisionManager<S>;
  using Make = std::unique_ptr<Manager> (*)(Span<const Aabb> boxes);

  FclPeer(Make make, bool candidates, bool partial_update)
      : make_(make), candidates_(candidates), partial_update_(partial_update) {}

  void prepare(Span<const Aabb> boxes) override {
    const auto geometry = std::make_shared<::fcl::Sphere<S>>(S{1});
    objects_.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      objects_.emplace_back(geometry, static_cast<std::uint32_t>(i), boxes[i]);
    for (FclObject<S>& object : objects_) pointers_.push_back(&object);
  }

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    managers_.push_back(make_(boxes));
    managers_.back()->registerObjects(pointers_);
    managers_.back()->setup();
    collect(pairs);
  }

  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs) override {
    for (const std::uint32_t i : moved) objects_[i].set(boxes[i]);
    if (moved.size() == boxes.size() || !partial_update_) {
      managers_.back()->update();
    } else {
      moved_.clear();
      for (const std::uint32_t i : moved) moved_.push_back(&objects_[i]);
      managers_.back()->update(moved_);
    }
    collect(pairs);
  }

  void release() override {
    managers_.clear();
    pointers_.clear();
    objects_.clear();
    objects_.shrink_to_fit();
  }

 private:
  static bool on_pair(::fcl::CollisionObject<S>* x, ::fcl::CollisionObject<S>* y, void* data) {
    const std::uint32_t a = fcl_index(x), b = fcl_index(y);
    static_cast<std::vector<Pair>*>(data)->push_back(a < b ? Pair{a, b} : Pair{b, a});
    return false;
  }

  static bool on_candidate(::fcl::CollisionObject<S>* x, ::fcl::CollisionObject<S>* y, void* data) {
    return x->getAABB().overlap(y->getAABB()) && on_pair(x, y, data);
  }

  void collect(std::vector<Pair>& pairs) {
    pairs.clear();
    managers_.back()->collide(&pairs, candidates_ ? on_candidate : on_pair);
  }

  Make make_;
  bool candidates_, partial_update_;
  std::vector<FclObject<S>> objects_;
  std::vector<::fcl::CollisionObject<S>*> pointers_, moved_;
  std::vector<std::unique_ptr<Manager>> managers_;
};

/// FCL's default tree over float, which Debian's library does not hold: its headers, compiled here.
std::unique_ptr<Peer> make_fcl_float_tree();

}  // namespace boxstream::bench
