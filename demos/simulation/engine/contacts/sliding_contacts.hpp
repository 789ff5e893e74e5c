// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <utility>

class btCollisionConfiguration;
class btCollisionDispatcher;
struct btCollisionAlgorithmCreateFunc;

namespace boxstream::scenes {

/// Bodies that slide or roll on each other keep all points at which they touch. Bullet adds those that it finds, which
/// are those that are in the other body, to the ones of the step before, and then drops what has moved aside by a
/// fiftieth of the size of a body. Of a cube that moves so far in a step half of its corners are left, and it rocks; a
/// slower one loses a corner that is a rounding error above the ground for some steps.
///
/// Here points that have moved aside are all found anew, from the faces that look at each other. Where nothing slides,
/// nor where there is no friction, Bullet goes on as if this were not there. Must outlive all pairs of the dispatcher.
class SlidingContacts {
 public:
  SlidingContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration);
  ~SlidingContacts();
  SlidingContacts(const SlidingContacts&) = delete;
  SlidingContacts& operator=(const SlidingContacts&) = delete;

  /// Of two types of shapes; null: it is Bullet's.
  btCollisionAlgorithmCreateFunc* of(int a, int b) const;

 private:
  std::map<std::pair<int, int>, std::unique_ptr<btCollisionAlgorithmCreateFunc>> created_;
};

}  // namespace boxstream::scenes
