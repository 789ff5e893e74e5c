// SPDX-License-Identifier: MIT
// Included before every source: what the library uses of C++20 and Emscripten 3.1.6's standard library does not have.
#pragma once

#include <memory>
#include <version>

#if _LIBCPP_VERSION < 14000
namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class Array>
unique_ptr<Array> make_unique_for_overwrite(size_t size) {
  return unique_ptr<Array>(new remove_extent_t<Array>[size]);
}

}  // namespace std
#endif
