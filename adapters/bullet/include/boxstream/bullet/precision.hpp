// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <LinearMath/btScalar.h>

#if BT_BULLET_VERSION < 288
#error "boxstream needs Bullet 2.88 or newer"
#endif
// Set by boxstream's targets and .pc files.
#ifdef BOXSTREAM_BULLET_FLOAT64
// clang-format off
#if !BOXSTREAM_BULLET_FLOAT64 && defined(BT_USE_DOUBLE_PRECISION)
#error "boxstream::bullet is for Bullet in single precision, and BT_USE_DOUBLE_PRECISION is defined: link boxstream::bullet_float64"
#elif BOXSTREAM_BULLET_FLOAT64 && !defined(BT_USE_DOUBLE_PRECISION)
#error "boxstream::bullet_float64 is for Bullet in double precision, and BT_USE_DOUBLE_PRECISION is not defined: link boxstream::bullet"
#endif
// clang-format on
#endif

// The precision is part of every symbol's name, so that the wrong one of the two libraries fails to link. Internal
// names carry it too, for both builds may meet in one program image.
#ifdef BT_USE_DOUBLE_PRECISION
#define BOXSTREAM_BULLET_PRECISION float64
#else
#define BOXSTREAM_BULLET_PRECISION float32
#endif
