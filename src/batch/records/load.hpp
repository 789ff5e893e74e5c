// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>

#include "base/keys.hpp"
#include "batch/records/record.hpp"

namespace boxstream::detail {

/// How many boxes are read at a time: as many as stay in the nearest cache, and have a bit each in a word.
constexpr std::size_t load_block = 64;

/// Makes records of `count` <= load_block boxes, ids from `first_id` on. Returns which are valid, box i as bit i.
std::uint64_t load_records(const Aabb* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<float>& keys,
                           Record* out);
std::uint64_t load_records(const Aabb64* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<double>& keys,
                           Record* out);

}  // namespace boxstream::detail
