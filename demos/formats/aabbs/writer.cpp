// SPDX-License-Identifier: MIT
#include "formats/aabbs/writer.hpp"

#include <bit>

namespace boxstream::aabbs {
namespace {

void put(std::vector<char>& out, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(word >> shift & 0xff));
}

void put(std::vector<char>& out, const float (&corner)[3]) {
  for (const float x : corner) put(out, std::bit_cast<std::uint32_t>(x));
  put(out, std::uint32_t{0});
}

void put(std::vector<char>& out, const Aabb& box) {
  put(out, box.min);
  put(out, box.max);
}

void put(std::vector<char>& out, std::string text) {
  text.resize(text_size - 1);
  out.insert(out.end(), text.begin(), text.end());
  out.push_back(0);
}

}  // namespace

Writer::Writer(std::ostream& out, Header header) : out_(out), header_(std::move(header)) {
  const auto is_count = [](std::uint32_t n) { return n >= 1 && n <= most; };
  if (!is_count(header_.objects) || !is_count(header_.steps) || !is_valid(header_.world))
    throw std::invalid_argument("a file of boxes needs objects, steps and a world");
  put(bytes_, header_.scene);
  put(bytes_, header_.type);
  put(bytes_, header_.objects);
  put(bytes_, header_.steps);
  put(bytes_, std::uint32_t{0});
  put(bytes_, std::uint32_t{0});
  put(bytes_, header_.world);
  out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
}

void Writer::frame(Span<const Aabb> boxes) {
  if (boxes.size() != header_.objects || frames_ > header_.steps)
    throw std::invalid_argument("a frame has a box for each object, and there are no more frames than announced");
  bytes_.clear();
  for (const Aabb& box : boxes) put(bytes_, box);
  out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  ++frames_;
}

void Writer::finish() {
  if (frames_ != std::uint64_t{header_.steps} + 1) throw std::logic_error("frames are missing");
  out_.flush();
  if (!out_) throw std::runtime_error("the boxes could not be written");
}

}  // namespace boxstream::aabbs
