// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>

#include "search/keys.hpp"
#include "search/record.hpp"
#include "search/slabs.hpp"

namespace boxstream::detail {

/// How many boxes are read at a time: as many as stay in the nearest cache, and have a bit each in a word.
constexpr std::size_t load_block = 64;

/// Makes records of `count` <= load_block boxes, ids from `first_id` on. Returns which are valid, box i as bit i.
std::uint64_t load_records(const Aabb* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<float>& keys,
                           Record* out);
std::uint64_t load_records(const Aabb64* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<double>& keys,
                           Record* out);

/// In which slab each of `count` <= load_block records begins and ends, large ones in slab `slabs.count`. Adds to how
/// many begin in each, and end in each.
void locate(const Record* records, std::size_t count, const Slabs& slabs, std::uint8_t* first_slab,
            std::uint8_t* last_slab, std::uint32_t* begin_counts, std::uint32_t* end_counts);

/// Copies records to where the cursors of their slabs are, but for those with `none` as first slab. How many slabs a
/// box touches is as good as random, so a copy for a second one is made whether there is one or not. All copies but the
/// first get `bit` set in `before`.
void copy_to_slabs(const Record* records, std::size_t count, const std::uint8_t* first_slab,
                   const std::uint8_t* last_slab, std::uint32_t bit, unsigned none, std::size_t* cursors, Record* out);

}  // namespace boxstream::detail
