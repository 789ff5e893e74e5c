// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>

#include "formats/record/format.hpp"
#include "formats/record/op.hpp"

namespace boxstream::record {

/// Writes a stream of calls. Ids must be those of a well-formed stream: `Create` in order, the others of live proxies;
/// coordinates must be exact in the stream's precision.
///
/// Errors of the stream stay in the stream: check it after `finish`. Nothing is written for a `Move` to the box that
/// the proxy has already, bit for bit. Flushes after each batch, so that a crash leaves whole batches.
class Writer {
 public:
  /// Borrows `out`, which must be binary. Cuts off what is too long in `header.about`.
  Writer(std::ostream& out, const Header& header);
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void write(const Op& op);
  /// Writes the end mark, without which a stream counts as cut off, and flushes. What is written later is ignored.
  void finish();

  Scalar scalar() const { return scalar_; }

 private:
  void put(const Create& op);
  void put(const Move& op);
  void put(const Destroy& op);
  void put(const Refilter& op);
  void put(const BoxQuery& op);
  void put(const RayQuery& op);
  void put(const Batch& op);
  void put(const ResetPool& op);

  void byte(std::uint8_t value) { buffer_.push_back(static_cast<char>(value)); }
  void code(Code value) { byte(static_cast<std::uint8_t>(value)); }
  void fixed(std::uint64_t value, int bytes);
  void unsigned_number(std::uint64_t value);
  void signed_number(std::int64_t value);
  void name(std::uint32_t id);
  void scalar(double value);
  void vector(const double (&values)[3]);
  void box(const Aabb64& box);

  std::ostream& out_;
  Scalar scalar_;
  bool finished_ = false;
  std::string buffer_;  // of one op
  Proxies proxies_;
};

}  // namespace boxstream::record
