// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>
#include <vector>

#include <mpi.h>

#include <boxstream/aabb.hpp>
#include <boxstream/mpi/batch.hpp>
#include <boxstream/mpi/detail/batch_search.hpp>
#include <boxstream/mpi/error.hpp>
#include <boxstream/mpi/world.hpp>
#include <boxstream/out_of_core.hpp>
#include <boxstream/span.hpp>

namespace boxstream::mpi {

/// Finds the pairs of boxes that the ranks of a communicator have, together.
///
/// @par Ranks
/// All ranks of `comm` call it, each with its own boxes and their ids: any of them on any rank, none on some. There is
/// an id for each box, which no other box in the world has. Options may differ.
///
/// @par Pairs
/// Every pair of boxes that overlap or touch, exactly once, on one rank; of ids, a < b. Which rank has it is a function
/// of all boxes with their ids and of the number of ranks, not of who gave them.
///
/// @par Order
/// On each rank, a function of the input of all ranks. The sink must not wait for other ranks. One that returns false
/// ends the search of its rank alone.
///
/// @par Method
/// Space is divided into one part for each rank, with about as many boxes in each, by a Decomposition. Each box is sent
/// once to each rank whose part it touches: most to one, an infinite one to all. Boxes that nothing separates, as when
/// all lie at one point, are searched by one rank.
///
/// @par Cost
/// With P ranks: about 512 P boxes are gathered on each rank as a sample. Then each rank sends at most P - 1 messages,
/// and at most P copies of a box. A dozen collectives in all; the others have a number or two for each rank.
///
/// @par Memory
/// What the rank searches, with its ids, and 39 to 58 bytes for each of these boxes. Before that, of a round, what is
/// sent and received, and 8 bytes for each box sent.
///
/// @par Errors
/// What is thrown on one rank, std::bad_alloc and what a sink throws included, is thrown as an Error on all.
///
/// @par Reasons
/// std::invalid_argument (number of ids), std::length_error (more than 2^32 - 2 boxes on a rank). A rank that dies is
/// MPI's affair, which ends the others. If errors of the communicator return, they are thrown as std::runtime_error on
/// that rank only.
///
/// @par Threads
/// All calls of MPI are made by the calling thread.
///
/// @par Machines
/// Of one kind, for boxes travel as bytes.
inline Stats stream_pairs(MPI_Comm comm, Span<const Aabb> boxes, Span<const std::uint64_t> ids, WidePairSink sink,
                          const Options& options = {}) {
  return detail::BatchSearch<float>(comm, boxes, ids, options).run(sink);
}
inline Stats stream_pairs(MPI_Comm comm, Span<const Aabb64> boxes, Span<const std::uint64_t> ids, WidePairSink sink,
                          const Options& options = {}) {
  return detail::BatchSearch<double>(comm, boxes, ids, options).run(sink);
}

/// The same pairs in the same order, in `out`, which is cleared first, and empty after an error.
inline Stats find_pairs(MPI_Comm comm, Span<const Aabb> boxes, Span<const std::uint64_t> ids,
                        std::vector<WidePair>& out, const Options& options = {}) {
  return detail::find_pairs(comm, boxes, ids, out, options);
}
inline Stats find_pairs(MPI_Comm comm, Span<const Aabb64> boxes, Span<const std::uint64_t> ids,
                        std::vector<WidePair>& out, const Options& options = {}) {
  return detail::find_pairs(comm, boxes, ids, out, options);
}

}  // namespace boxstream::mpi
