// SPDX-License-Identifier: MIT
#pragma once

#include "formats/record/op.hpp"

namespace boxstream::record_test {

/// Whether both are the same, to the last bit of each coordinate.
bool same(const record::Op& a, const record::Op& b);

}  // namespace boxstream::record_test
