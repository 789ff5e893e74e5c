// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::detail {

/// Makes rows of neighbours of pairs: these are kept as they come, and counted; then each goes to its row, and rows are
/// sorted. Boxes of a cell come with many pairs one after the other, so their counts and the ends of their rows stay in
/// the caches, whatever their indices.
class NeighbourRows {
 public:
  /// Pairs that are kept in one piece of memory.
  static constexpr std::size_t piece = 16384;

  /// `offsets` and `indices` are filled for `boxes` boxes; each pair is in the row of its second box, too, if `both`.
  NeighbourRows(Neighbours& out, std::size_t boxes, bool both, std::vector<std::unique_ptr<Pair[]>>& pieces)
      : out_(out), both_(both), pieces_(pieces) {
    out_.offsets.assign(boxes + 1, 0);
  }

  void add(Span<const Pair> pairs) {
    for (std::size_t from = 0; from < pairs.size();) {
      if (in_piece_ == piece && size_ != 0) in_piece_ = 0, ++full_;
      if (full_ == pieces_.size()) pieces_.push_back(std::unique_ptr<Pair[]>(new Pair[piece]));
      const std::size_t count = std::min(piece - in_piece_, pairs.size() - from);
      std::copy_n(pairs.data() + from, count, pieces_[full_].get() + in_piece_);
      in_piece_ += count;
      size_ += count;
      from += count;
    }
    std::uint64_t* const ends = out_.offsets.data() + 1;
    for (const Pair pair : pairs) ++ends[pair.a];
    if (both_)
      for (const Pair pair : pairs) ++ends[pair.b];
  }

  /// After the last pair: all is there but the order of each row.
  void fill();

 private:
  Neighbours& out_;
  bool both_;
  std::vector<std::unique_ptr<Pair[]>>& pieces_;  // of `piece` pairs
  std::size_t full_ = 0, in_piece_ = 0, size_ = 0;
};

/// Sorts the rows [first, last), of different numbers each.
void sort_rows(Neighbours& rows, std::size_t first, std::size_t last);

}  // namespace boxstream::detail
