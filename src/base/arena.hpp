// SPDX-License-Identifier: MIT
#pragma once

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace boxstream::detail {

/// Scratch memory that follows the recursion: blocks are released in the reverse order of their allocation, by leaving
/// the scope of a Frame. Grows by chunks, and keeps one chunk of the peak size afterwards, so that the same work done
/// again allocates nothing.
class Arena {
 public:
  /// Everything allocated while a Frame lives is released with it.
  class Frame {
   public:
    explicit Frame(Arena& arena) : arena_(arena), chunk_(arena.chunk_), used_(arena.used_), total_(arena.total_) {}
    ~Frame() {
      assert(arena_.chunk_ >= chunk_ && arena_.total_ >= total_);
      arena_.chunk_ = chunk_;
      arena_.used_ = used_;
      arena_.total_ = total_;
    }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

   private:
    Arena& arena_;
    std::size_t chunk_, used_, total_;
  };

  /// Uninitialised room for `count` values of a trivial type, aligned for any SIMD load.
  template <class T>
  T* allocate(std::size_t count) {
    if (count > most_bytes / sizeof(T)) throw std::bad_array_new_length();  // the product would be a small number
    return static_cast<T*>(allocate_bytes(count * sizeof(T)));
  }

  /// While nothing is allocated: makes one chunk for work that is likely to take so many bytes at once, unless there
  /// are as many. What is not used of it is memory in name only.
  void expect(std::size_t bytes) {
    assert(total_ == 0);
    if (capacity() >= bytes) return;
    chunks_.clear();
    add_chunk(round_up(bytes + bytes / 4));
  }

  /// While nothing is allocated: makes one chunk of many, large enough for `peak` bytes at once and a quarter to
  /// spare for inputs that differ a bit.
  void settle(std::size_t peak) noexcept {
    assert(total_ == 0);
    if (chunks_.size() <= 1 && capacity() >= peak) return;
    chunks_.clear();
    try {
      add_chunk(round_up(peak + peak / 4));
    } catch (const std::bad_alloc&) {
      // Ignored: the next call allocates again and reports a failure itself.
    }
  }

  /// The most bytes that were ever in use at once.
  std::size_t peak() const { return peak_; }

  std::size_t capacity() const {
    std::size_t sum = 0;
    for (const Chunk& c : chunks_) sum += c.size;
    return sum;
  }

 private:
  static constexpr std::size_t alignment = 64;
  static constexpr std::size_t smallest_chunk = std::size_t{1} << 16;
  static constexpr std::size_t most_bytes = SIZE_MAX / 2;  // what no system gives in one piece

  struct Free {
    void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{alignment}); }
  };
  struct Chunk {
    std::unique_ptr<std::byte, Free> data;
    std::size_t size;
  };

  static std::size_t round_up(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

  /// Where the system gives them on request only: the open streams of a scatter need a page each.
  static void ask_for_huge_pages([[maybe_unused]] std::byte* data, [[maybe_unused]] std::size_t size) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    constexpr std::size_t page = 4096, huge_page = std::size_t{1} << 21;
    const auto begin = reinterpret_cast<std::uintptr_t>(data), first = (begin + page - 1) / page * page;
    if (size >= 2 * huge_page)
      madvise(reinterpret_cast<void*>(first), (begin + size - first) / page * page, MADV_HUGEPAGE);
#endif
  }

  void add_chunk(std::size_t size) {
    chunks_.reserve(chunks_.size() + 1);
    auto* data = static_cast<std::byte*>(::operator new (size, std::align_val_t{alignment}));
    chunks_.push_back({std::unique_ptr<std::byte, Free>(data), size});
    ask_for_huge_pages(data, size);
  }

  /// The next one has to have that many. All behind the one in use are empty: those that are too small would only take
  /// memory, the more the longer blocks grow.
  void go_to_chunk(std::size_t bytes) {
    const std::size_t next = chunk_ == chunks_.size() ? chunk_ : chunk_ + 1;
    const auto first = chunks_.begin() + static_cast<std::ptrdiff_t>(next);
    chunks_.erase(first, std::find_if(first, chunks_.end(), [&](const Chunk& chunk) { return chunk.size >= bytes; }));
    if (next == chunks_.size()) add_chunk(bytes > smallest_chunk ? bytes : smallest_chunk);
    chunk_ = next;
    used_ = 0;
  }

  void* allocate_bytes(std::size_t bytes) {
    bytes = round_up(bytes == 0 ? 1 : bytes);
    if (chunk_ == chunks_.size() || chunks_[chunk_].size - used_ < bytes) go_to_chunk(bytes);
    void* block = chunks_[chunk_].data.get() + used_;
    used_ += bytes;
    total_ += bytes;
    if (total_ > peak_) peak_ = total_;
    return block;
  }

  std::vector<Chunk> chunks_;
  std::size_t chunk_ = 0;  // the chunk in use
  std::size_t used_ = 0;   // bytes of it
  std::size_t total_ = 0;  // bytes in use in all chunks
  std::size_t peak_ = 0;
};

}  // namespace boxstream::detail
