// SPDX-License-Identifier: MIT
#include "formats/record/writer.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace boxstream::record {

Writer::Writer(std::ostream& out, const Header& header) : out_(out), scalar_(header.scalar) {
  for (const std::uint8_t each : magic) byte(each);
  byte(version);
  byte(static_cast<std::uint8_t>(header.scalar));
  box(header.bounds);
  const std::string about = header.about.substr(0, Header::max_about);
  unsigned_number(about.size());
  buffer_ += about;
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
}

void Writer::write(const Op& op) {
  if (finished_) return;
  buffer_.clear();
  std::visit([this](const auto& each) { put(each); }, op);
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  if (std::holds_alternative<Batch>(op)) out_.flush();
}

void Writer::finish() {
  if (finished_) return;
  finished_ = true;
  out_.put(static_cast<char>(Code::end));
  out_.flush();
}

void Writer::put(const Create& op) {
  assert(op.id == proxies_.by_id.size());
  proxies_.by_id.push_back({true, coordinates_of(op.box)});
  proxies_.last_named = op.id;
  code(Code::create);
  signed_number(op.shape);
  signed_number(op.group);
  signed_number(op.mask);
  box(op.box);
}

void Writer::put(const Move& op) {
  assert(proxies_.is_alive(op.id));
  Coordinates& last = proxies_.by_id[op.id].box;
  const Coordinates now = coordinates_of(op.box);
  std::uint8_t changed = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (std::bit_cast<std::uint64_t>(last[i]) != std::bit_cast<std::uint64_t>(now[i]))
      changed |= static_cast<std::uint8_t>(1 << i);
  if (changed == 0) return;
  byte(static_cast<std::uint8_t>(Code::move) | changed);
  name(op.id);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (changed >> i & 1) scalar(now[i]);
  last = now;
}

void Writer::put(const Destroy& op) {
  assert(proxies_.is_alive(op.id));
  proxies_.by_id[op.id].alive = false;
  code(Code::destroy);
  name(op.id);
}

void Writer::put(const Refilter& op) {
  assert(proxies_.is_alive(op.id));
  code(Code::refilter);
  name(op.id);
  signed_number(op.group);
  signed_number(op.mask);
}

void Writer::put(const BoxQuery& op) {
  code(Code::box_query);
  box(op.box);
}

void Writer::put(const RayQuery& op) {
  const auto is_zero = [](double x) { return std::bit_cast<std::uint64_t>(x) == 0; };
  const bool thin =
      std::all_of(op.extent_min, op.extent_min + 3, is_zero) && std::all_of(op.extent_max, op.extent_max + 3, is_zero);
  code(thin ? Code::ray_query : Code::thick_ray_query);
  vector(op.from);
  vector(op.to);
  vector(op.inverse_direction);
  scalar(op.length);
  if (thin) return;
  vector(op.extent_min);
  vector(op.extent_max);
}

void Writer::put(const Batch& op) {
  code(Code::batch);
  unsigned_number(op.pairs.count);
  fixed(op.pairs.hash, 8);
}

void Writer::put(const ResetPool&) {
  code(Code::reset_pool);
}

void Writer::fixed(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) byte(static_cast<std::uint8_t>(value >> 8 * i));
}

void Writer::unsigned_number(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) byte(static_cast<std::uint8_t>(value | 0x80));
  byte(static_cast<std::uint8_t>(value));
}

void Writer::signed_number(std::int64_t value) {
  // 0, -1, 1, -2, 2 ... become 0, 1, 2, 3, 4 ...
  unsigned_number(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
}

void Writer::name(std::uint32_t id) {
  signed_number(std::int64_t{id} - std::int64_t{proxies_.last_named});
  proxies_.last_named = id;
}

void Writer::scalar(double value) {
  if (scalar_ == Scalar::float32)
    fixed(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  else
    fixed(std::bit_cast<std::uint64_t>(value), 8);
}

void Writer::vector(const double (&values)[3]) {
  for (const double value : values) scalar(value);
}

void Writer::box(const Aabb64& box) {
  vector(box.min);
  vector(box.max);
}

}  // namespace boxstream::record
