// SPDX-License-Identifier: MIT
#include "formats/aabbs/frame_boxes.hpp"

#include <algorithm>

#include "formats/aabbs/format.hpp"

namespace boxstream::aabbs {

FrameBoxes::FrameBoxes(std::istream& in, const Header& header, std::uint64_t frame)
    : in_(in), objects_(header.objects), frame_(frame) {}

void FrameBoxes::rewind() {
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(header_size + frame_ * objects_ * box_size));
  next_ = 0;
  ++passes_;
}

Span<const Aabb> FrameBoxes::read() {
  constexpr std::uint64_t at_once = 32768;
  const auto count = static_cast<std::size_t>(std::min(at_once, objects_ - next_));
  bytes_.resize(count * box_size);
  if (!in_.read(reinterpret_cast<char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size())))
    throw AabbsError("the file has become shorter while it was read");
  boxes_.clear();
  for (std::size_t i = 0; i < count; ++i) boxes_.push_back(box(bytes_.data() + i * box_size));
  next_ += count;
  return boxes_;
}

std::uint64_t frames_in(std::istream& in, const Header& header) {
  in.clear();
  const auto here = in.tellg();
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  if (here == std::istream::pos_type(-1) || end == std::istream::pos_type(-1)) return 0;
  in.seekg(here);
  return (static_cast<std::uint64_t>(end) - header_size) / (std::uint64_t{header.objects} * box_size);
}

}  // namespace boxstream::aabbs
