// SPDX-License-Identifier: MIT
#include "pictures/viewer/paint.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::view {
namespace {

struct Paint {
  const char* name;
  float r, g, b;  // sRGB
  float opacity = 1;
};

constexpr Paint paints[paint_count] = {
    {"created 1", 0.13F, 0.36F, 0.56F}, {"created 2", 0.14F, 0.49F, 0.56F},     {"created 3", 0.16F, 0.61F, 0.56F},
    {"created 4", 0.93F, 0.77F, 0.42F}, {"created 5", 0.94F, 0.66F, 0.36F},     {"created 6", 0.94F, 0.55F, 0.30F},
    {"created 7", 0.86F, 0.30F, 0.26F}, {"floor", 0.78F, 0.79F, 0.80F},         {"scenery", 0.72F, 0.71F, 0.68F},
    {"kinematic", 0.30F, 0.33F, 0.38F}, {"sensor", 0.10F, 0.62F, 0.45F, 0.25F}, {"character", 0.84F, 0.15F, 0.24F}};
constexpr std::size_t created_count = 7;
enum Special : std::size_t { floor_paint = created_count, scenery, kinematic, sensor, character };

/// Materials are given in linear light.
double linear(float srgb) {
  return srgb <= 0.04045F ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace

std::size_t paint_of(scenes::Drawable::State state, bool is_plane, std::uint32_t object, std::size_t objects) {
  using State = scenes::Drawable::State;
  if (is_plane) return floor_paint;
  switch (state) {
    case State::fixed:
      return scenery;
    case State::kinematic:
    case State::wheel:
      return kinematic;
    case State::sensor:
      return sensor;
    case State::character:
      return character;
    case State::moving:
    case State::sleeping:
    case State::soft:
      break;
  }
  return std::min(created_count - 1, object * created_count / std::max<std::size_t>(objects, 1));
}

nlohmann::ordered_json material_json(std::size_t paint) {
  const Paint& p = paints[paint];
  nlohmann::ordered_json json{
      {"name", p.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {linear(p.r), linear(p.g), linear(p.b), static_cast<double>(p.opacity)}},
        {"metallicFactor", 0},
        {"roughnessFactor", 0.7}}},
      {"doubleSided", true}};
  if (p.opacity < 1) json["alphaMode"] = "BLEND";
  return json;
}

}  // namespace boxstream::view
