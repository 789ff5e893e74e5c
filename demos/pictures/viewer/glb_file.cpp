// SPDX-License-Identifier: MIT
#include "pictures/viewer/glb_file.hpp"

#include <algorithm>
#include <bit>
#include <ostream>
#include <stdexcept>

namespace boxstream::view {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes of a .glb file are written as they are in memory");

constexpr int type_u16 = 5123;
constexpr int type_u32 = 5125;
constexpr int type_float = 5126;
constexpr const char* type_names[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};

template <class Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  while (bytes.size() % 4 != 0) bytes += '\0';
}

void put_u32(std::ostream& out, std::uint64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  out.write(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

GlbFile::View& GlbFile::view_for(Use use) {
  return views_[static_cast<std::size_t>(use)];
}

std::size_t GlbFile::add_floats(const std::vector<float>& floats, std::size_t components, Use use, bool limits) {
  View& view = view_for(use);
  Json accessor{{"bufferView", static_cast<std::size_t>(use)},
                {"byteOffset", view.bytes.size()},
                {"componentType", type_float},
                {"count", floats.size() / components},
                {"type", type_names[components]}};
  if (limits) {
    std::vector<float> least(floats.begin(), floats.begin() + static_cast<std::ptrdiff_t>(components));
    std::vector<float> largest = least;
    for (std::size_t i = 0; i < floats.size(); ++i) {
      least[i % components] = std::min(least[i % components], floats[i]);
      largest[i % components] = std::max(largest[i % components], floats[i]);
    }
    accessor["min"] = least;
    accessor["max"] = largest;
  }
  append(view.bytes, floats);
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

std::size_t GlbFile::add_indices(const std::vector<std::uint32_t>& indices) {
  View& view = view_for(Use::indices);
  // 65535 itself would mean a new strip.
  const bool narrow = std::all_of(indices.begin(), indices.end(), [](std::uint32_t i) { return i < 65535; });
  accessors_.push_back({{"bufferView", static_cast<std::size_t>(Use::indices)},
                        {"byteOffset", view.bytes.size()},
                        {"componentType", narrow ? type_u16 : type_u32},
                        {"count", indices.size()},
                        {"type", "SCALAR"}});
  if (narrow)
    append(view.bytes, std::vector<std::uint16_t>(indices.begin(), indices.end()));
  else
    append(view.bytes, indices);
  return accessors_.size() - 1;
}

void GlbFile::write(std::ostream& out, Json document) const {
  // A view of no bytes is not allowed, so empty ones are left out and the others move up.
  Json views = Json::array();
  std::vector<std::size_t> place(views_.size());
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    place[i] = views.size();
    if (views_[i].bytes.empty()) continue;
    Json view{{"buffer", 0}, {"byteOffset", size}, {"byteLength", views_[i].bytes.size()}};
    if (i == static_cast<std::size_t>(Use::vertices)) view["byteStride"] = 12;
    if (views_[i].target != 0) view["target"] = views_[i].target;
    views.push_back(std::move(view));
    size += views_[i].bytes.size();
  }
  if (!accessors_.empty()) {
    document["buffers"] = Json::array({{{"byteLength", size}}});
    document["bufferViews"] = std::move(views);
    document["accessors"] = accessors_;
    for (Json& accessor : document["accessors"])
      accessor["bufferView"] = place[accessor["bufferView"].get<std::size_t>()];
  }
  document["asset"]["version"] = "2.0";
  std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  while (json.size() % 4 != 0) json += ' ';

  const std::uint64_t binary_chunk = size == 0 ? 0 : 8 + size;
  const std::uint64_t whole = 12 + 8 + json.size() + binary_chunk;
  if (whole > UINT32_MAX) throw std::length_error("a .glb file cannot have more than 4 GiB: record fewer steps");
  put_u32(out, 0x46546C67);  // "glTF"
  put_u32(out, 2);
  put_u32(out, whole);
  put_u32(out, json.size());
  put_u32(out, 0x4E4F534A);  // "JSON"
  out << json;
  if (size == 0) return;
  put_u32(out, size);
  put_u32(out, 0x004E4942);  // "BIN"
  for (const View& view : views_) out.write(view.bytes.data(), static_cast<std::streamsize>(view.bytes.size()));
}

}  // namespace boxstream::view
