// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <ostream>
#include <vector>

namespace boxstream::bullet_test {

/// Broad-phases to run a scenario on; the natives witness what Bullet itself does.
enum class Kind { subject, dbvt, dbvt_deferred, axis16, axis32, simple };

std::ostream& operator<<(std::ostream& out, Kind kind);

/// Where things are: AxisSweep must be told, and it and Simple how many there may be.
struct Room {
  btVector3 middle{0, 0, 0};
  btScalar reach = 200;
  int most = 12000;
};

/// The broad-phase under test is boxstream's. Configuring with BOXSTREAM_BULLET_TESTS_SUBJECT set to one of the natives
/// puts that one in its place, to see that the tests notice its known violations of the contract.
std::unique_ptr<btBroadphaseInterface> make_broadphase(Kind kind, btOverlappingPairCache* cache = nullptr,
                                                       const Room& room = {});

/// Throws if an invariant of boxstream's is broken; natives are not asked.
void validate(const btBroadphaseInterface& broadphase);

inline const std::vector<Kind> all_kinds{Kind::subject, Kind::dbvt,   Kind::dbvt_deferred,
                                         Kind::axis16,  Kind::axis32, Kind::simple};

}  // namespace boxstream::bullet_test
