// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/oracle.hpp"

namespace boxstream::fuzz {

/// The brute force of tests/library/core, in a file of its own: it is compiled without what makes fuzzers slow.
tests::Pairs truth(const tests::Boxes<float>& boxes, const tests::Filters& filters);
tests::Pairs truth(const tests::Boxes<double>& boxes, const tests::Filters& filters);
tests::Pairs truth(const tests::Boxes<float>& a, const tests::Boxes<float>& b, const tests::Filters& filters_a,
                   const tests::Filters& filters_b);
tests::Pairs truth(const tests::Boxes<double>& a, const tests::Boxes<double>& b, const tests::Filters& filters_a,
                   const tests::Filters& filters_b);

/// As in tests/library/core: how the pairs differ, or nothing.
std::string difference(const tests::Pairs& found, const tests::Pairs& expected, const tests::Boxes<float>& a,
                       const tests::Boxes<float>& b);
std::string difference(const tests::Pairs& found, const tests::Pairs& expected, const tests::Boxes<double>& a,
                       const tests::Boxes<double>& b);

}  // namespace boxstream::fuzz
