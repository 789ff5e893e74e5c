// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/accuracy/accuracy_result.hpp"

namespace boxstream::tool {

/// For reading; ends in a newline.
std::string accuracy_table(const AccuracyResult& result);

}  // namespace boxstream::tool
