// SPDX-License-Identifier: MIT
// A program, and a library, that makes the broad-phases of Bullet that its words name.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btSimpleBroadphase.h>
#include <btBulletCollisionCommon.h>

#include <cstring>

extern "C" int make(const char* kind) {
  if (std::strcmp(kind, "tree") == 0) btDbvtBroadphase().calculateOverlappingPairs(nullptr);
  if (std::strcmp(kind, "simple") == 0) btSimpleBroadphase().calculateOverlappingPairs(nullptr);
  if (std::strcmp(kind, "sweep") == 0)
    btAxisSweep3(btVector3(0, 0, 0), btVector3(9, 9, 9)).calculateOverlappingPairs(nullptr);
  return 0;
}

int main(int count, char** words) {
  for (int i = 1; i < count; ++i) make(words[i]);
}
