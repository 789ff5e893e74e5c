// SPDX-License-Identifier: MIT
#include "formats/record/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace boxstream::record {

Reader::Reader(Span<const std::uint8_t> bytes, CutOff cut_off) : bytes_(bytes), cut_off_(cut_off) {
  const std::size_t there = std::min(bytes.size(), magic.size());
  if (!std::equal(bytes.begin(), bytes.begin() + there, magic.begin())) fail("no boxstream recording");
  for (std::size_t i = 0; i < magic.size(); ++i) byte();
  begin_ = at_;
  if (const int given = byte(); given != version)
    fail(fmt::format("version {} of the format; this program reads {}", given, version));
  begin_ = at_;
  const int scalar = byte();
  if (scalar != 4 && scalar != 8) fail(fmt::format("{} bytes to a coordinate; expected 4 or 8", scalar));
  header_.scalar = static_cast<Scalar>(scalar);
  begin_ = at_;
  header_.bounds = box();
  for (int d = 0; d < 3; ++d) {
    const double low = header_.bounds.min[d], high = header_.bounds.max[d];
    if (!(low >= -Header::max_bound && high <= Header::max_bound && high - low >= Header::min_side))
      fail(fmt::format("bounds from {} to {} on the {} axis", low, high, "xyz"[d]));
  }
  begin_ = at_;
  const std::uint64_t length = unsigned_number();
  if (length > Header::max_about) fail(fmt::format("a text of {} bytes; at most {}", length, Header::max_about));
  for (std::uint64_t i = 0; i < length; ++i) header_.about.push_back(static_cast<char>(byte()));
  begin_ = at_;
}

std::optional<Op> Reader::next() {
  if (!error_.empty()) throw RecordError(error_);
  if (ended_) return std::nullopt;
  begin_ = at_;
  try {
    const std::uint8_t code = byte();
    if (code != static_cast<std::uint8_t>(Code::end)) return parse(code);
    if (at_ != bytes_.size()) fail(fmt::format("{} bytes after the end mark", bytes_.size() - at_));
  } catch (const RecordError& error) {
    if (cut_ && cut_off_ == CutOff::is_end) {
      ended_ = true;
      return std::nullopt;
    }
    // What was read of the op may have changed what later ones mean.
    error_ = error.what();
    throw;
  }
  ended_ = true;
  return std::nullopt;
}

void Reader::fail(const std::string& reason) const {
  throw RecordError(fmt::format("offset {}: {}", begin_, reason));
}

Op Reader::parse(std::uint8_t code) {
  if ((code & ~move_mask) == static_cast<std::uint8_t>(Code::move)) return parse_move(code & move_mask);
  switch (static_cast<Code>(code)) {
    case Code::create:
      return parse_create();
    case Code::destroy: {
      const std::uint32_t id = name();
      proxies_.by_id[id].alive = false;
      return Destroy{id};
    }
    case Code::refilter: {
      Refilter op{};
      op.id = name();
      op.group = signed_number();
      op.mask = signed_number();
      return op;
    }
    case Code::box_query:
      return BoxQuery{box()};
    case Code::ray_query:
      return parse_ray(false);
    case Code::thick_ray_query:
      return parse_ray(true);
    case Code::batch: {
      Batch op;
      op.pairs.count = unsigned_number();
      op.pairs.hash = fixed(8);
      return op;
    }
    case Code::reset_pool:
      return ResetPool{};
    default:
      fail(fmt::format("unknown op 0x{:02x}", code));
  }
}

Create Reader::parse_create() {
  if (proxies_.by_id.size() > std::numeric_limits<std::uint32_t>::max()) fail("more than 2^32 proxies");
  Create op{};
  op.id = static_cast<std::uint32_t>(proxies_.by_id.size());
  op.shape = signed_number();
  op.group = signed_number();
  op.mask = signed_number();
  op.box = box();
  proxies_.by_id.push_back({true, coordinates_of(op.box)});
  proxies_.last_named = op.id;
  return op;
}

Move Reader::parse_move(std::uint8_t changed) {
  const std::uint32_t id = name();
  Coordinates& last = proxies_.by_id[id].box;
  for (std::size_t i = 0; i < last.size(); ++i)
    if (changed >> i & 1) last[i] = scalar();
  return {id, box_of(last)};
}

RayQuery Reader::parse_ray(bool thick) {
  RayQuery op{};
  vector(op.from);
  vector(op.to);
  vector(op.inverse_direction);
  op.length = scalar();
  if (thick) {
    vector(op.extent_min);
    vector(op.extent_max);
  }
  return op;
}

std::uint8_t Reader::byte() {
  if (at_ == bytes_.size()) {
    cut_ = true;
    fail(begin_ == at_ ? "cut off: nothing follows" : fmt::format("cut off: the file ends at {}", at_));
  }
  return bytes_[at_++];
}

std::uint64_t Reader::fixed(int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value |= std::uint64_t{byte()} << 8 * i;
  return value;
}

std::uint64_t Reader::unsigned_number() {
  std::uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const std::uint8_t next = byte();
    const std::uint64_t bits = next & 0x7f;
    if (shift == 63 && next > 1) fail("a number of more than 64 bits");
    // One encoding of each number, so that streams can be compared as bytes.
    if (shift > 0 && next == 0) fail("a number that is longer than it must be");
    value |= bits << shift;
    if (next < 0x80) return value;
  }
}

std::int32_t Reader::signed_number() {
  const std::uint64_t folded = unsigned_number();
  if (folded > std::numeric_limits<std::uint32_t>::max()) fail("a number of more than 32 bits");
  const auto half = static_cast<std::int32_t>(folded >> 1);
  return (folded & 1) != 0 ? -half - 1 : half;
}

std::uint32_t Reader::name() {
  const std::uint64_t folded = unsigned_number();
  const std::uint64_t half = folded >> 1;
  // Wraps around where the distance is absurd, and then names no live proxy.
  const std::uint64_t id = (folded & 1) != 0 ? proxies_.last_named - half - 1 : proxies_.last_named + half;
  if (id >= proxies_.by_id.size())
    fail(fmt::format("names a proxy that was not created; there were {}", proxies_.by_id.size()));
  if (!proxies_.by_id[id].alive) fail(fmt::format("names proxy {}, which is destroyed", id));
  return proxies_.last_named = static_cast<std::uint32_t>(id);
}

double Reader::scalar() {
  if (header_.scalar == Scalar::float32) return std::bit_cast<float>(static_cast<std::uint32_t>(fixed(4)));
  return std::bit_cast<double>(fixed(8));
}

void Reader::vector(double (&values)[3]) {
  for (double& value : values) value = scalar();
}

Aabb64 Reader::box() {
  Aabb64 box{};
  vector(box.min);
  vector(box.max);
  return box;
}

}  // namespace boxstream::record
