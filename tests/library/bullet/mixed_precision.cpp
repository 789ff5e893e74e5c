// SPDX-License-Identifier: MIT
// A program compiled for one precision of Bullet and linked with the libraries of the other (clause A2): the linker
// says nothing, so boxstream must. Prints "survived" if it does not.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <boxstream/bullet.hpp>

#include <cstdio>

int main(int argc, char**) {
  btDbvtBroadphase* links_the_libraries = argc > 100 ? new btDbvtBroadphase : nullptr;
  boxstream::bullet::Broadphase broadphase;
  std::printf("survived %p\n", static_cast<void*>(links_the_libraries));
  return 0;
}
