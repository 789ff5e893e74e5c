// SPDX-License-Identifier: MIT
#include "fcl_scene.hpp"

#include <algorithm>

#include "batches/batches.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t enough_objects = 1000;
constexpr float side_when_apart = 0.1F;
constexpr float side_of_others = 5;

Aabb scaled_in_place(const Aabb& box, float factor) {
  Aabb scaled{};
  for (int d = 0; d < 3; ++d) {
    const float centre = box.min[d] / 2 + box.max[d] / 2;
    const float half = (box.max[d] - box.min[d]) / 2 * factor;
    scaled.min[d] = centre - half;
    scaled.max[d] = centre + half;
  }
  return scaled;
}

std::vector<Aabb> boxes_of(const std::string& batch, std::size_t n, std::uint64_t seed, float factor) {
  std::vector<Aabb> boxes = scaled_to_unit_sides(batches::make(batch, n, seed));
  for (Aabb& box : boxes) box = scaled_in_place(box, factor);
  return boxes;
}

}  // namespace

std::size_t FclScene::casts_of(std::size_t n) {
  return std::max<std::size_t>(1, enough_objects / n);
}

FclScene::FclScene(const std::string& batch, std::size_t n, std::uint64_t seed, Motion motion, std::size_t one_in,
                   bool apart)
    : one_in_(one_in) {
  const auto geometry = std::make_shared<::fcl::Sphere<double>>(1.0);
  const std::size_t count = casts_of(n);
  const float side = apart ? side_when_apart : 1;
  casts_.reserve(count);
  for (std::size_t c = 0; c < count; ++c) {
    const std::uint64_t own_seed = seed + 1000 * c;
    const std::vector<Aabb> boxes = boxes_of(batch, n, own_seed, side);
    casts_.push_back({{}, {}, {}, {}, {}, {}, MovingBoxes(boxes, motion, own_seed)});
    FclCast& cast = casts_.back();
    std::uint32_t index = 0;
    const auto fill = [&](std::vector<FclObject<double>>& objects, const std::vector<Aabb>& from, std::size_t size) {
      objects.reserve(size);
      for (std::size_t i = 0; i < size; ++i) objects.emplace_back(geometry, index++, from[i % from.size()]);
    };
    fill(cast.objects, boxes, n);
    // Of another seed, so that they are near the objects and not one with them.
    fill(cast.others, boxes_of(batch, n, own_seed + 1, side * side_of_others), others);
    fill(cast.queries, boxes_of(batch, n, own_seed + 2, side), queries);
    for (FclObject<double>& object : cast.objects) cast.pointers.push_back(&object);
    for (FclObject<double>& object : cast.others) cast.other_pointers.push_back(&object);
    for (std::size_t i = 0; i < n; i += one_in) cast.moved.push_back(&cast.objects[i]);
  }
}

void FclScene::next_frame() {
  for (FclCast& cast : casts_) {
    cast.moving.next_frame();
    for (std::size_t i = 0; i < cast.objects.size(); i += one_in_) cast.objects[i].set(cast.moving.boxes()[i]);
  }
}

}  // namespace boxstream::bench
