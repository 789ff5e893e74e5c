// SPDX-License-Identifier: MIT
// RapidCheck's own header, with assertions that count as such: see gtest/gtest.h beside it.
#pragma once
#pragma GCC system_header  // for #include_next

#include_next <rapidcheck.h>

#include <gtest/gtest.h>

#undef RC_ASSERT
#define RC_ASSERT(expression) \
  (::boxstream::tests::note_assertion(), RC_INTERNAL_CONDITIONAL_RESULT(Failure, expression, true, "RC_ASSERT", ))
