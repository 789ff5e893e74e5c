// SPDX-License-Identifier: MIT
#include "abi_check.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "fatal.hpp"

#if defined(__ELF__) && defined(__GNUC__)
#define BOXSTREAM_BULLET_WEAK_PROBES 1
// btCollisionShape::getContactBreakingThreshold(float or double) const, one of the few symbols that do name the scalar.
// Weak, so that a program links with whichever is there; only their addresses are used.
extern "C" {
__attribute__((weak)) void boxstream_bullet_probe_float() __asm__(
    "_ZNK16btCollisionShape27getContactBreakingThresholdEf");
__attribute__((weak)) void boxstream_bullet_probe_double() __asm__(
    "_ZNK16btCollisionShape27getContactBreakingThresholdEd");
}
#endif

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

bool plausible_distance(btScalar value) {
  constexpr btScalar tiny = btScalar(1e-15), huge = btScalar(5e4);
  return value == 0 || (value > tiny && value < huge);
}

namespace {

bool other_precision_is_linked() {
#ifdef BOXSTREAM_BULLET_WEAK_PROBES
  const bool has_float = boxstream_bullet_probe_float != nullptr;
  const bool has_double = boxstream_bullet_probe_double != nullptr;
  return sizeof(btScalar) == sizeof(float) ? has_double && !has_float : has_float && !has_double;
#else
  return false;
#endif
}

}  // namespace

void require_matching_precision() {
  // The values also tell when both precisions are loaded and the other one won; the symbols tell when a program has
  // assigned values that look sane either way.
  if (!other_precision_is_linked() && plausible_distance(gDbvtMargin) && plausible_distance(gContactBreakingThreshold))
    return;
  fatal(sizeof(btScalar) == sizeof(float)
            ? "built for single precision, but linked with Bullet libraries in double precision: use "
              "boxstream::bullet_float64 and compile with BT_USE_DOUBLE_PRECISION, or link the single precision "
              "libraries"
            : "built for double precision, but linked with Bullet libraries in single precision: use "
              "boxstream::bullet and compile without BT_USE_DOUBLE_PRECISION, or link the double precision libraries");
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
