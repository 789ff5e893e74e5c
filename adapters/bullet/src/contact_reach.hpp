// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

#include "client.hpp"
#include "proxy.hpp"

extern btScalar gContactBreakingThreshold;  // what btCollisionWorld adds to boxes; and of a shape's size, see below
extern btScalar gDbvtMargin;                // what btDbvtBroadphase adds to boxes that moved

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// How far contacts of a proxy may reach beyond its box.
///
/// The manifold of two objects takes points that are up to a fiftieth of the smaller shape apart (of its angular motion
/// disc), while btCollisionWorld makes boxes larger by a fixed 0.02. For shapes wider than about two units this is
/// less, and a contact would begin only when the shapes nearly touch. btDbvtBroadphase covers most of the difference by
/// the margin that it adds to boxes. So does this: by what is missing, and up to that margin. Each of the two boxes of
/// a pair then covers its half.
///
/// The size comes from the shape if the client is the collision object of the proxy, which it says itself; else from
/// the box.
class ContactReach {
 public:
  /// Without `reads_clients` sizes come from boxes alone. All boxes are larger by `margin` anyway.
  ContactReach(bool reads_clients, btScalar margin) : reads_clients_(reads_clients), margin_(margin) {}

  /// Brings `proxy.margin` up to date with a box that is about to be set. Sizes are taken where the shape is another
  /// one, and now and then, for shapes may be scaled: to do so in each move would cost as much as the move.
  void update(Proxy& proxy, const btVector3& lo, const btVector3& hi) const {
    const void* const shape = reads_clients_ ? shape_of(proxy) : nullptr;
    if (shape == proxy.sized_shape && proxy.moves_until_sized != 0)
      --proxy.moves_until_sized;
    else
      measure(proxy, shape, lo, hi);
  }

  /// False if the shape is not the one that the size is of, `sized`.
  bool is_current(const Proxy& proxy, const void* sized) const { return !reads_clients_ || shape_of(proxy) == sized; }

 private:
  /// Null if the client is not, or not yet, the object that has this proxy.
  static const void* shape_of(const Proxy& proxy) {
    const btCollisionObject* const object = as_object(proxy.m_clientObject);
    return object != nullptr && object->getBroadphaseHandle() == &proxy ? object->getCollisionShape() : nullptr;
  }
  void measure(Proxy& proxy, const void* shape, const btVector3& lo, const btVector3& hi) const;

  static constexpr std::uint8_t moves_between_sizes = 60;

  bool reads_clients_;
  btScalar margin_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
