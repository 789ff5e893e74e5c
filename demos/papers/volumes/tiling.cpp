// SPDX-License-Identifier: MIT
#include "papers/volumes/tiling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "papers/volumes/axis_box.hpp"

namespace boxstream::papers::volumes {

namespace {

/// Brings `numbers` into an order in which each `tile_size` of them are a tile.
void tile(const std::vector<Point>& centres, Span<std::uint32_t> numbers, std::size_t tile_size) {
  const std::size_t tiles = (numbers.size() + tile_size - 1) / tile_size;
  const auto slices = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(tiles))));
  const auto sort = [&](Span<std::uint32_t> part, int axis) {
    std::sort(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
      return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
  };
  const auto each = [](Span<std::uint32_t> all, std::size_t width, const auto& visit) {
    for (std::size_t first = 0; first < all.size(); first += width)
      visit(all.subspan(first, std::min(width, all.size() - first)));
  };
  sort(numbers, 0);
  each(numbers, tile_size * slices * slices, [&](Span<std::uint32_t> slice) {
    sort(slice, 1);
    each(slice, tile_size * slices, [&](Span<std::uint32_t> column) { sort(column, 2); });
  });
}

}  // namespace

Tree build_by_tiling(const Atoms& atoms, std::size_t leaf_size, std::size_t arity) {
  if (atoms.boxes.empty()) return {};
  // Of the level that is being tiled: centres, boxes, and numbers in the draft (of the lowest level: objects).
  std::vector<Point> centres = atoms.centres;
  std::vector<Aabb64> boxes = atoms.boxes;
  std::vector<std::uint32_t> numbers(boxes.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::vector<DraftNode> draft;
  bool lowest = true;
  do {
    const std::size_t tile_size = lowest ? leaf_size : arity;
    std::vector<std::uint32_t> places(numbers.size());
    std::iota(places.begin(), places.end(), 0u);
    tile(centres, places, tile_size);
    std::vector<Point> upper_centres;
    std::vector<Aabb64> upper_boxes;
    std::vector<std::uint32_t> upper_numbers;
    for (std::size_t first = 0; first < places.size(); first += tile_size) {
      DraftNode node;
      Aabb64 box = boxes[places[first]];
      for (std::size_t i = first; i < std::min(first + tile_size, places.size()); ++i) {
        (lowest ? node.objects : node.children).push_back(numbers[places[i]]);
        box = merged(box, boxes[places[i]]);
      }
      upper_numbers.push_back(static_cast<std::uint32_t>(draft.size()));
      upper_boxes.push_back(box);
      upper_centres.push_back(AxisBox{box}.centre());
      draft.push_back(std::move(node));
    }
    centres = std::move(upper_centres);
    boxes = std::move(upper_boxes);
    numbers = std::move(upper_numbers);
    lowest = false;
  } while (numbers.size() > 1);
  return laid_out(draft, numbers[0]);
}

}  // namespace boxstream::papers::volumes
