// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/detector.hpp>

#include "core/oracle.hpp"

namespace boxstream::fuzz {

/// Brute force by the definition of the rules, for any numbers: of boxes of any coordinate type, all of which doubles
/// hold exactly. In a file of its own, which is compiled without what makes fuzzers slow.
tests::Pairs truth(const tests::Boxes<double>& boxes, const PairRules& rules);
tests::Pairs truth(const tests::Boxes<double>& a, const tests::Boxes<double>& b, const PairRules& rules);

}  // namespace boxstream::fuzz
