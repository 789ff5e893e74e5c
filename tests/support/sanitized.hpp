// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tests {

/// Sanitizers, and valgrind (BOXSTREAM_TESTS_DO_LESS), make everything several times slower, and see in little what
/// they would see in much: tests of results do less under them, as the same tests do it whole without.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(BOXSTREAM_TESTS_DO_LESS)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace boxstream::tests
