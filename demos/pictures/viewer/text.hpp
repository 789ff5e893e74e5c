// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::view {

/// Raw deflate (RFC 1951), which browsers take apart themselves: DecompressionStream("deflate-raw").
/// Throws std::bad_alloc.
std::string deflated(std::string_view bytes);

std::string base64(std::string_view bytes);

/// Bytes as text that HTML, UTF-8 and every older character set leave alone: each 13 bits, the lowest first, are two of
/// the 93 printable characters other than space and "<", first the remainder by 93, then the quotient. This takes 1.23
/// characters a byte, where base64 takes 1.33. At the end 6 bits or fewer are one character.
std::string as_text(std::string_view bytes);

}  // namespace boxstream::view
