// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>

#include "search/buckets.hpp"
#include "search/load.hpp"
#include "search/pair_buffer.hpp"
#include "search/record.hpp"

namespace boxstream::detail {

/// The keys of a block of boxes, as a structure of arrays. A lane without a valid box meets no box.
struct BoxColumns {
  alignas(64) std::int32_t lo[3][load_block];
  alignas(64) std::int32_t hi[3][load_block];
};

/// The cells of a grid that a block of boxes touches, from first to last on each axis.
struct CellColumns {
  std::uint8_t first[3][load_block];
  std::uint8_t last[3][load_block];
};

/// Reads `count` <= load_block boxes. Returns which are valid, box i as bit i.
std::uint64_t load_columns(const Aabb* boxes, std::size_t count, BoxColumns& out);

/// The same of `count` records, of which those with their bit in `valid` are.
void load_columns(const Record* records, std::size_t count, std::uint64_t valid, BoxColumns& out);

/// In which buckets boxes begin and end; of at most 256 on each axis. Lanes without a box are not to be used.
void locate_cells(const BoxColumns& boxes, const Buckets (&axes)[3], CellColumns& out);

/// One block of few boxes, and which of its lanes are valid.
struct FewBoxes {
  BoxColumns columns;
  std::uint64_t valid;
};

/// Emits the pairs of each of the few, in their order, with each box of a block, in theirs. Boxes of the few have their
/// lanes as indices, those of the block begin at `first_id`. False when the buffer's owner wants to stop.
bool compare_few(const FewBoxes& few, const BoxColumns& block, std::uint32_t first_id, bool few_first,
                 PairBuffer& pairs);

}  // namespace boxstream::detail
