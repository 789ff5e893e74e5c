// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/accuracy/accuracy_result.hpp"

namespace boxstream::tool {

/// A row for each setting, a column for each knob, each measure (worst, p95, mean, last) and the times.
std::string accuracy_csv(const AccuracyResult& result);

}  // namespace boxstream::tool
