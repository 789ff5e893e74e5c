// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/record/op.hpp"

namespace boxstream::record {

// Streams as text. Numbers are the shortest that give the same bits in the precision of the stream.

std::string text_of(const Aabb64& box, Scalar scalar);
/// One line without its end. Batches and box queries are not numbered.
std::string text_of(const Op& op, Scalar scalar);
/// One line without its end; control characters are replaced.
std::string text_of(const Header& header);

}  // namespace boxstream::record
