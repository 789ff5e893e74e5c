// SPDX-License-Identifier: MIT
//
// The bytes of an index, all numbers little-endian:
//
//   0  "boxindex"
//   8  uint32  version, 1
//  12  uint32  bytes of a coordinate, 4 or 8
//  16  uint64  boxes
//  24  uint64  valid boxes
//  32  uint64  checksum of all other bytes
//  40          valid boxes in the order of the tree: min x, y, z, max x, y, z
//      uint32  the index of each of them, then those of invalid boxes, ascending
//
// Nodes are not stored but rebuilt in a pass over the boxes, so damaged bytes cannot make an inconsistent tree.

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

#include "box_index/impl.hpp"

namespace boxstream {

namespace {

constexpr char magic[] = "boxindex";
constexpr std::uint32_t version = 1;
constexpr std::size_t checksum_at = 32, header = 40;

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error("boxstream: " + why);
}

template <class T>
T turned_if_big(T x) {
  if constexpr (std::endian::native == std::endian::little) return x;
  unsigned char bytes[sizeof(T)], turned[sizeof(T)];
  std::memcpy(bytes, &x, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) turned[i] = bytes[sizeof(T) - 1 - i];
  std::memcpy(&x, turned, sizeof(T));
  return x;
}

/// For unsigned integers: others might not be copied as they are.
template <class T>
T number_at(const std::uint8_t* bytes) {
  T x;
  std::memcpy(&x, bytes, sizeof(T));
  return turned_if_big(x);
}

template <class T>
void put(std::uint8_t* bytes, T x) {
  x = turned_if_big(x);
  std::memcpy(bytes, &x, sizeof(T));
}

/// Each step is one to one in the word and in the sum so far: a change within one word always shows.
class Checksum {
 public:
  void add(const std::uint8_t* bytes, std::size_t count) {
    for (; count >= 8; bytes += 8, count -= 8) add(number_at<std::uint64_t>(bytes));
    std::uint8_t rest[8] = {};
    if (count == 0) return;
    std::memcpy(rest, bytes, count);
    add(number_at<std::uint64_t>(rest));
  }
  std::uint64_t sum() const { return sum_; }

 private:
  void add(std::uint64_t word) {
    sum_ = (sum_ ^ word) * 0x9e3779b97f4a7c15;
    sum_ ^= sum_ >> 32;
  }

  std::uint64_t sum_ = 0;
};

std::uint64_t checksum_of(Span<const std::uint8_t> bytes) {
  Checksum checksum;
  checksum.add(bytes.data(), checksum_at);
  checksum.add(bytes.data() + header, bytes.size() - header);
  return checksum.sum();
}

template <class S>
using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

template <class S>
constexpr std::size_t box_bytes = 6 * sizeof(S);

template <class S>
BasicAabb<S> box_at(const std::uint8_t* bytes) {
  BasicAabb<S> box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.min[d] = std::bit_cast<S>(number_at<Bits<S>>(bytes + d * sizeof(S)));
    box.max[d] = std::bit_cast<S>(number_at<Bits<S>>(bytes + (3 + d) * sizeof(S)));
  }
  return box;
}

template <class S>
void put(std::uint8_t* bytes, const BasicAabb<S>& box) {
  for (std::size_t d = 0; d < 3; ++d) {
    put(bytes + d * sizeof(S), std::bit_cast<Bits<S>>(box.min[d]));
    put(bytes + (3 + d) * sizeof(S), std::bit_cast<Bits<S>>(box.max[d]));
  }
}

struct Counts {
  std::size_t boxes, valid;
};

/// Throws unless the bytes are as many as they say, and what was saved.
template <class S>
Counts checked_counts(Span<const std::uint8_t> bytes) {
  if (bytes.size() < header || std::memcmp(bytes.data(), magic, 8) != 0) refuse("these bytes are not of a BoxIndex");
  const auto found = number_at<std::uint32_t>(bytes.data() + 8);
  if (found != version)
    refuse("an index of version " + std::to_string(found) + "; only " + std::to_string(version) + " is read");
  if (number_at<std::uint64_t>(bytes.data() + checksum_at) != checksum_of(bytes))
    refuse("a damaged index, whose checksum is not that of its bytes");
  const auto coordinate = number_at<std::uint32_t>(bytes.data() + 12);
  if (coordinate != sizeof(S))
    refuse("an index whose coordinates have " + std::to_string(coordinate) + " bytes, not " +
           std::to_string(sizeof(S)));
  const auto boxes = number_at<std::uint64_t>(bytes.data() + 16), valid = number_at<std::uint64_t>(bytes.data() + 24);
  if (boxes >= UINT32_MAX || valid > boxes || bytes.size() - header != valid * box_bytes<S> + boxes * 4)
    refuse("a damaged index, which has not the bytes of its boxes");
  return {static_cast<std::size_t>(boxes), static_cast<std::size_t>(valid)};
}

}  // namespace

template <class S>
std::vector<std::uint8_t> BasicBoxIndex<S>::save() const {
  const detail::Bvh<S>& bvh = impl_->bvh;
  std::vector<bool> is_valid(impl_->size);
  std::size_t valid = 0;
  for (; valid < 8 * bvh.tree_blocks() && bvh.slot_at(valid) != detail::Bvh<S>::none; ++valid)
    is_valid[bvh.slot_at(valid)] = true;

  std::vector<std::uint8_t> bytes(header + valid * box_bytes<S> + impl_->size * 4);
  std::memcpy(bytes.data(), magic, 8);
  put(bytes.data() + 8, version);
  put(bytes.data() + 12, static_cast<std::uint32_t>(sizeof(S)));
  put(bytes.data() + 16, std::uint64_t{impl_->size});
  put(bytes.data() + 24, std::uint64_t{valid});
  std::uint8_t* at = bytes.data() + header;
  for (std::size_t i = 0; i < valid; ++i, at += box_bytes<S>) put(at, bvh.box_at(i));
  for (std::size_t i = 0; i < valid; ++i, at += 4) put(at, bvh.slot_at(i));
  for (std::uint32_t i = 0; i < impl_->size; ++i)
    if (!is_valid[i]) put(at, i), at += 4;
  put(bytes.data() + checksum_at, checksum_of(bytes));
  return bytes;
}

template <class S>
BasicBoxIndex<S> BasicBoxIndex<S>::load(Span<const std::uint8_t> bytes) {
  const Counts count = checked_counts<S>(bytes);
  const std::uint8_t* const boxes = bytes.data() + header;
  const std::uint8_t* const indices = boxes + count.valid * box_bytes<S>;
  // Bytes that were forged may have a right checksum, too.
  std::vector<bool> is_seen(count.boxes);
  for (std::size_t i = 0; i < count.boxes; ++i) {
    const auto index = number_at<std::uint32_t>(indices + 4 * i);
    if (index >= count.boxes || is_seen[index]) refuse("a damaged index, which has not each box once");
    is_seen[index] = true;
  }
  BasicBoxIndex loaded;
  loaded.impl_->size = count.boxes;
  loaded.impl_->bvh.build_in_order(
      count.valid, [&](std::size_t i) { return number_at<std::uint32_t>(indices + 4 * i); },
      [&](std::size_t i) { return box_at<S>(boxes + i * box_bytes<S>); });
  for (std::size_t i = 0; i < count.valid; ++i)
    if (!detail::has_valid_keys(box_at<S>(boxes + i * box_bytes<S>)))
      refuse("a damaged index, with a box that is invalid");
  return loaded;
}

template std::vector<std::uint8_t> BasicBoxIndex<float>::save() const;
template std::vector<std::uint8_t> BasicBoxIndex<double>::save() const;
template BasicBoxIndex<float> BasicBoxIndex<float>::load(Span<const std::uint8_t>);
template BasicBoxIndex<double> BasicBoxIndex<double>::load(Span<const std::uint8_t>);

}  // namespace boxstream
