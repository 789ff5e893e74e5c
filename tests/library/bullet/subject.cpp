// SPDX-License-Identifier: MIT
#include "subject.hpp"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>
#ifndef BULLET_TESTS_SUBJECT
#include <boxstream/bullet.hpp>
#endif

namespace boxstream::bullet_test {
std::ostream& operator<<(std::ostream& out, Kind kind) {
  constexpr const char* names[] = {"subject", "dbvt", "dbvt_deferred", "axis16", "axis32", "simple"};
  return out << names[static_cast<int>(kind)];
}

std::unique_ptr<btBroadphaseInterface> make_broadphase(Kind kind, btOverlappingPairCache* cache, const Room& room) {
  const btVector3 reach(room.reach, room.reach, room.reach);
  switch (kind) {
    case Kind::subject: {
#ifdef BULLET_TESTS_SUBJECT
      return make_broadphase(Kind::BULLET_TESTS_SUBJECT, cache, room);
#else
      // Most scenarios are about which boxes pair; those about contacts are in first_contacts.cpp.
      boxstream::bullet::Options options;
      options.exact_boxes = true;
      return std::make_unique<boxstream::bullet::Broadphase>(cache, options);
#endif
    }
    case Kind::dbvt_deferred: {
      auto dbvt = std::make_unique<btDbvtBroadphase>(cache);
      dbvt->m_deferedcollide = true;
      return dbvt;
    }
    case Kind::axis16:
      return std::unique_ptr<btBroadphaseInterface>(
          new btAxisSweep3(room.middle - reach, room.middle + reach, static_cast<unsigned short>(room.most), cache));
    case Kind::axis32:
      return std::unique_ptr<btBroadphaseInterface>(
          new bt32BitAxisSweep3(room.middle - reach, room.middle + reach, static_cast<unsigned>(room.most), cache));
    case Kind::simple:
      return std::make_unique<btSimpleBroadphase>(room.most, cache);
    case Kind::dbvt:
      break;
  }
  return std::make_unique<btDbvtBroadphase>(cache);
}

void validate([[maybe_unused]] const btBroadphaseInterface& broadphase) {
#ifndef BULLET_TESTS_SUBJECT
  if (const auto* ours = dynamic_cast<const boxstream::bullet::Broadphase*>(&broadphase)) ours->validate();
#endif
}

}  // namespace boxstream::bullet_test
