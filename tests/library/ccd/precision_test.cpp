// SPDX-License-Identifier: MIT
// As a program would be that was compiled with the headers of a single-precision libccd and is linked with Debian's.
#define __CCD_CONFIG_H__
#define CCD_SINGLE
#include <ccd/ccd.h>
static_assert(sizeof(ccd_real_t) == sizeof(float));

#include <gtest/gtest.h>

#include "library_precision.hpp"

TEST(Precision, AnotherThanTheLibrarysIsNoticed) {
  EXPECT_FALSE(boxstream::ccd::library_has_our_reals());
}
