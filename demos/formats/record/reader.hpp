// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "formats/record/format.hpp"
#include "formats/record/op.hpp"
#include "formats/record/pair_limit.hpp"

namespace boxstream::record {

/// How to take a stream that ends before its end mark: as broken, or as left by a crash, to be read as far as it goes.
enum class CutOff { is_error, is_end };

/// Reads a stream of calls, from any bytes whatever: it gives well-formed ops (ids of live proxies, creations in order)
/// or throws RecordError with the offset of the op that is wrong. Takes memory in proportion to what it has read, never
/// to what the bytes claim.
///
/// Says nothing of whether the calls make sense: boxes may be NaN or inverted, a batch may claim any number of pairs.
class Reader {
 public:
  /// Borrows `bytes`. Reads the header; throws RecordError.
  explicit Reader(Span<const std::uint8_t> bytes, CutOff cut_off = CutOff::is_error);

  const Header& header() const { return header_; }
  /// The next op; nothing after the last one. Throws RecordError, and again at each later call.
  std::optional<Op> next();
  /// Where the op that `next` gave last begins.
  std::size_t offset() const { return begin_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  Op parse(std::uint8_t code);
  Create parse_create();
  Move parse_move(std::uint8_t changed);
  RayQuery parse_ray(bool thick);

  std::uint8_t byte();
  std::uint64_t fixed(int bytes);
  std::uint64_t unsigned_number();
  std::int32_t signed_number();
  std::uint32_t name();
  double scalar();
  void vector(double (&values)[3]);
  Aabb64 box();

  Span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;
  CutOff cut_off_;
  bool cut_ = false;
  bool ended_ = false;
  std::string error_;
  Header header_;
  Proxies proxies_;
};

}  // namespace boxstream::record
