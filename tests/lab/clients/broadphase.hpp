// SPDX-License-Identifier: MIT
#pragma once

// The two lines that change in a program with Bullet.
#ifdef SWAPPED
#include <boxstream/bullet.hpp>
using Broadphase = boxstream::bullet::Broadphase;
#else
using Broadphase = btDbvtBroadphase;
#endif
