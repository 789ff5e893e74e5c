// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "simulation/query/contestant.hpp"

namespace boxstream::query {

/// The first thing in which two answers to one query differ, in words; empty if they are the same. Counts of callbacks
/// and times may differ.
std::string difference(const Query& query, const ObjectMotion& motion, const std::string& name_x, const Answer& x,
                       const std::string& name_y, const Answer& y);

}  // namespace boxstream::query
