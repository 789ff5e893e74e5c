// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <ostream>
#include <vector>

namespace bullet_tests {

/// Broad-phases to run a scenario on; the natives witness what Bullet itself does.
enum class Kind { subject, dbvt, dbvt_deferred, axis16, axis32, simple };

std::ostream& operator<<(std::ostream& out, Kind kind);

/// The broad-phase under test is boxstream's. Configuring with BOXSTREAM_BULLET_TESTS_SUBJECT set to one of the natives
/// puts that one in its place, to see that the tests notice its known violations of the contract.
/// AxisSweep works in the world +-200 here.
std::unique_ptr<btBroadphaseInterface> make_broadphase(Kind kind, btOverlappingPairCache* cache = nullptr);

/// Throws if an invariant of boxstream's is broken; natives are not asked.
void validate(const btBroadphaseInterface& broadphase);

inline const std::vector<Kind> all_kinds{Kind::subject, Kind::dbvt,   Kind::dbvt_deferred,
                                         Kind::axis16,  Kind::axis32, Kind::simple};

}  // namespace bullet_tests
