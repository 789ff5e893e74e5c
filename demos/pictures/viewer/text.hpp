// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::view {

/// Raw deflate (RFC 1951), which browsers take apart themselves: DecompressionStream("deflate-raw").
/// Throws std::bad_alloc.
std::string deflated(std::string_view bytes);

std::string base64(std::string_view bytes);

}  // namespace boxstream::view
