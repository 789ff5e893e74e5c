// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::tests {

/// Sanitizers make everything several times slower, and see in little what they would see in much: tests of results do
/// less under them, as the same tests do it whole without.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace boxstream::tests
