// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include <boxstream/span.hpp>

#include "papers/hybrid/box.hpp"
#include "papers/hybrid/hybrid_search.hpp"
#include "papers/hybrid/problem.hpp"

/// The procedures of "Fast software for box intersections" (A. Zomorodian, H. Edelsbrunner, 2002) by name, on copies of
/// the boxes. Boxes are half-open; those that only touch do not intersect.
namespace boxstream::papers {

enum class Procedure { all_pairs, one_way_scan, two_way_scan, modified_two_way_scan, stream3, stream2_scan, hybrid };

Span<const Procedure> procedures();
/// As the paper spells it.
std::string_view name(Procedure procedure);

/// The complete case: every pair within one set, once. At most 2^31 - 1 boxes.
void run(Procedure procedure, Span<const Box> boxes, const HybridOptions& options, Found found);
/// The bipartite case: every pair of a box of `a` with a box of `b`, once.
void run(Procedure procedure, Span<const Box> a, Span<const Box> b, const HybridOptions& options, Found found);

}  // namespace boxstream::papers
