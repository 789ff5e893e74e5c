// SPDX-License-Identifier: MIT
#pragma once

// Internal names carry the precision for the same reason as the public ones: both builds may meet in one program image.
#ifdef BT_USE_DOUBLE_PRECISION
#define BOXSTREAM_BULLET_PRECISION float64
#else
#define BOXSTREAM_BULLET_PRECISION float32
#endif
