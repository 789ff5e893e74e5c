// SPDX-License-Identifier: MIT
#include "formats/aabbs/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "formats/aabbs/format.hpp"

namespace boxstream::aabbs {
namespace {

std::string text(Bytes at, const char* what) {
  const auto end = std::find(at, at + text_size, 0);
  if (end == at + text_size) throw AabbsError(fmt::format("the {} does not end within {} bytes", what, text_size));
  return {at, end};
}

std::uint32_t count(Bytes at, const char* what) {
  const std::uint32_t value = word(at);
  if (value == 0 || value > most)
    throw AabbsError(fmt::format("{} {}; expected at least 1", static_cast<std::int32_t>(value), what));
  return value;
}

Header parse(Bytes at) {
  Header header;
  header.scene = text(at, "name of the scene");
  header.type = text(at + text_size, "kind of objects");
  Bytes rest = at + 2 * text_size;
  header.objects = count(rest, "objects");
  header.steps = count(rest + 4, "steps");
  if (word(rest + 8) != 0 || word(rest + 12) != 0) throw AabbsError("the two words behind the counts are not 0");
  header.world = box(rest + 16);
  if (!is_valid(header.world)) throw AabbsError("the box of the world has a NaN or min > max");
  return header;
}

}  // namespace

Reader::Reader(std::istream& in) : in_(in) {
  std::array<unsigned char, header_size> bytes{};
  in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (in_.gcount() != static_cast<std::streamsize>(bytes.size()))
    throw AabbsError(fmt::format("{} bytes; the header alone takes {}", in_.gcount(), header_size));
  header_ = parse(bytes.data());
  check_size();
}

void Reader::check_size() {
  const auto here = in_.tellg();
  if (here == std::istream::pos_type(-1)) {
    in_.clear();
    return;
  }
  in_.seekg(0, std::ios::end);
  const auto end = in_.tellg();
  in_.seekg(here);
  // Each factor is below 2^31 and a box takes 2^5 bytes: the product needs more than 64 bits, a count of boxes does
  // not.
  const auto bytes = static_cast<std::uint64_t>(end - here);
  const std::uint64_t boxes = std::uint64_t{header_.objects} * header_.steps;
  if (bytes % box_size == 0 && (bytes / box_size == boxes || bytes / box_size == boxes + header_.objects)) return;
  throw AabbsError(fmt::format("{} bytes of boxes, but {} objects in 1 + {} frames would take {:.0f}", bytes,
                               header_.objects, header_.steps,
                               static_cast<double>(boxes + header_.objects) * static_cast<double>(box_size)));
}

bool Reader::next(std::vector<Aabb>& boxes) {
  constexpr std::size_t at_once = 4096;
  std::array<unsigned char, at_once * box_size> bytes;
  boxes.clear();
  const auto frames = std::uint64_t{header_.steps} + 1;
  if (frames_ == frames) {
    if (in_.peek() != std::istream::traits_type::eof())
      throw AabbsError(
          fmt::format("more bytes than the boxes of {} objects in 1 + {} frames", header_.objects, header_.steps));
    return false;
  }
  while (boxes.size() < header_.objects) {
    const std::size_t wanted = std::min<std::size_t>(at_once, header_.objects - boxes.size()) * box_size;
    in_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(wanted));
    const auto there = static_cast<std::size_t>(in_.gcount());
    if (there == 0 && boxes.empty() && frames_ == header_.steps) return false;
    if (there != wanted) throw AabbsError(fmt::format("cut off in frame {} of 1 + {}", frames_ + 1, header_.steps));
    for (std::size_t i = 0; i < wanted; i += box_size) boxes.push_back(box(bytes.data() + i));
  }
  ++frames_;
  return true;
}

}  // namespace boxstream::aabbs
