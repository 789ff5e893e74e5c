// SPDX-License-Identifier: MIT
#pragma once

#include "oracle.hpp"

/// The truth for batches that have a hundred thousand boxes and no good axis: the sweep of fast_oracle.hpp, with the
/// sides in arrays and no branch for a comparison. Itself checked against that one.
namespace boxstream::tests {

/// Pairs within one set, sorted.
template <class S>
Pairs swift_sweep(const Boxes<S>& boxes);

}  // namespace boxstream::tests
