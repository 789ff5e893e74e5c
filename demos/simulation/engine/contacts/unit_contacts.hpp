// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

class btCollisionConfiguration;
class btCollisionDispatcher;
class btCollisionObject;
struct btCollisionAlgorithmCreateFunc;

namespace boxstream::scenes {

class SlidingContacts;

/// Finds contacts of bodies that are marked in units of their own size, and all points of a face at once. Bullet has
/// tolerances in metres, and finds one point in a step. Where neither of two bodies is marked, it goes on as if this
/// were not there. Must outlive all pairs of the dispatcher.
class UnitContacts {
 public:
  /// `others`: what is to find contacts where neither of two bodies is marked, if it is not Bullet.
  UnitContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration,
               const SlidingContacts* others);
  ~UnitContacts();
  UnitContacts(const UnitContacts&) = delete;
  UnitContacts& operator=(const UnitContacts&) = delete;

  static void mark(btCollisionObject& body);
  static bool is_marked(const btCollisionObject& body);

 private:
  std::vector<std::unique_ptr<btCollisionAlgorithmCreateFunc>> created_;
};

}  // namespace boxstream::scenes
