// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "base/thresholds.hpp"

namespace boxstream::detail {

/// Pieces of memory for pairs that have to wait, shared by all workers and kept from call to call. The piece that was
/// given back last is handed out first: it is still in a cache.
class WaitingPairsRoom {
 public:
  struct Piece {
    static constexpr std::size_t capacity = thresholds.waiting_pairs;
    Piece* next;
    std::size_t size;
    Pair pairs[capacity];
  };

  /// Takes back all pieces; from now on at most `most_held` pairs, in whole pieces, may be held.
  void clear(std::size_t most_held) {
    free_ = nullptr;
    for (const auto& piece : pieces_) put_back(*piece);
    left_ = most_held / Piece::capacity + 1;
  }

  bool has_room() {
    const std::lock_guard lock(mutex_);
    return left_ != 0;
  }

  /// An empty piece; null when there is no room.
  Piece* take() {
    const std::lock_guard lock(mutex_);
    if (left_ == 0) return nullptr;
    if (free_ == nullptr) {
      pieces_.push_back(std::unique_ptr<Piece>(new Piece));
      put_back(*pieces_.back());
    }
    --left_;
    Piece* piece = free_;
    free_ = piece->next;
    piece->next = nullptr;
    piece->size = 0;
    return piece;
  }

  void release(Piece& piece) {
    const std::lock_guard lock(mutex_);
    put_back(piece);
    ++left_;
  }

  /// Gives all memory back; no piece is in use.
  void shrink_to_fit() noexcept {
    std::vector<std::unique_ptr<Piece>>().swap(pieces_);
    free_ = nullptr;
  }

  std::size_t capacity() const { return pieces_.size() * sizeof(Piece); }

 private:
  void put_back(Piece& piece) {
    piece.next = free_;
    free_ = &piece;
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Piece>> pieces_;
  Piece* free_ = nullptr;
  std::size_t left_ = 0;  // pieces that may still be taken
};

/// The pairs of one task, in their order, until its turn comes.
class WaitingPairs {
 public:
  /// False when there is no room for all of them; then some were added.
  bool append(Span<const Pair> pairs, WaitingPairsRoom& room) {
    const Pair* from = pairs.data();
    for (std::size_t left = pairs.size(); left != 0;) {
      if (last_ == nullptr || last_->size == WaitingPairsRoom::Piece::capacity) {
        WaitingPairsRoom::Piece* const piece = room.take();
        if (piece == nullptr) return false;
        (last_ == nullptr ? first_ : last_->next) = piece;
        last_ = piece;
      }
      const std::size_t count = std::min(left, WaitingPairsRoom::Piece::capacity - last_->size);
      std::copy_n(from, count, last_->pairs + last_->size);
      last_->size += count;
      size_ += count;
      from += count;
      left -= count;
    }
    return true;
  }

  /// Hands all pairs to `sink` and gives their memory back. Returns false when the sink does.
  template <class Sink>
  bool pass_on(Sink&& sink, WaitingPairsRoom& room) {
    while (first_ != nullptr) {
      WaitingPairsRoom::Piece& piece = *first_;
      if (!sink(Span<const Pair>(piece.pairs, piece.size))) return false;
      size_ -= piece.size;
      first_ = piece.next;
      if (first_ == nullptr) last_ = nullptr;
      room.release(piece);
    }
    return true;
  }

  std::uint64_t size() const { return size_; }

 private:
  WaitingPairsRoom::Piece* first_ = nullptr;
  WaitingPairsRoom::Piece* last_ = nullptr;
  std::uint64_t size_ = 0;
};

}  // namespace boxstream::detail
