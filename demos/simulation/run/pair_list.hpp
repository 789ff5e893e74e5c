// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>

class btBroadphaseInterface;

namespace boxstream::scenes {

/// The pairs that a broad-phase holds, as indices of objects (the user index of each proxy's client), lower first,
/// sorted.
void list_pairs(const btBroadphaseInterface& broadphase, std::vector<Pair>& out);

/// How many elements of sorted `list` are not in sorted `other`.
std::uint64_t count_missing(const std::vector<Pair>& list, const std::vector<Pair>& other);

}  // namespace boxstream::scenes
