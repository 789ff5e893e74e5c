// SPDX-License-Identifier: MIT
#include "papers/volumes/builders.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/objects.hpp"
#include "papers/volumes/splits.hpp"
#include "papers/volumes/tree.hpp"

namespace boxstream::papers::volumes {
namespace {

class Growing {
 public:
  Growing(const Atoms& atoms, std::size_t leaf_size) : atoms_(atoms), leaf_size_(leaf_size) {}

  void insert(std::uint32_t object) {
    if (draft_.empty()) {
      add_leaf(object);
      return;
    }
    std::uint32_t node = 0;
    while (true) {
      const Aabb64 before = boxes_[node];
      boxes_[node] = merged(before, atoms_.boxes[object]);
      ++counts_[node];
      if (draft_[node].children.empty()) {
        put_into_leaf(node, object, before);
        return;
      }
      const std::uint32_t a = draft_[node].children[0], b = draft_[node].children[1];
      const double growth_a = growth(a, object), growth_b = growth(b, object);
      node = growth_a < growth_b || (growth_a == growth_b && counts_[a] <= counts_[b]) ? a : b;
    }
  }

  Tree tree() const { return draft_.empty() ? Tree{} : laid_out(draft_, 0); }

 private:
  double growth(std::uint32_t node, std::uint32_t object) const {
    return area(merged(boxes_[node], atoms_.boxes[object])) - area(boxes_[node]);
  }

  std::uint32_t add_leaf(std::uint32_t object) {
    draft_.push_back({{}, {object}});
    boxes_.push_back(atoms_.boxes[object]);
    counts_.push_back(1);
    return static_cast<std::uint32_t>(draft_.size() - 1);
  }

  void put_into_leaf(std::uint32_t leaf, std::uint32_t object, const Aabb64& before) {
    if (draft_[leaf].objects.size() < leaf_size_) {
      draft_[leaf].objects.push_back(object);
      return;
    }
    const std::uint32_t fresh = add_leaf(object);
    const auto old = static_cast<std::uint32_t>(draft_.size());
    DraftNode moved{{}, std::move(draft_[leaf].objects)};
    boxes_.push_back(before);
    counts_.push_back(static_cast<std::uint32_t>(moved.objects.size()));
    draft_.push_back(std::move(moved));
    draft_[leaf] = {{old, fresh}, {}};
  }

  const Atoms& atoms_;
  std::size_t leaf_size_;
  std::vector<DraftNode> draft_;
  std::vector<Aabb64> boxes_;
  std::vector<std::uint32_t> counts_;  ///< objects beneath
};

/// Insertion, section 5.1.2. Step 2 takes objects in a random order, the same each time: in a sorted one, trees become
/// lists. Step 5 takes the child whose surface area grows least, and of equals the one with fewer objects. Where the
/// printed loop ends, at a leaf, the object goes into it; a full leaf becomes a node with two leaves, the old one and
/// one for the new object. O(n log n) unless the objects' sizes defeat that; O(n^2) at worst.
Tree build_by_insertion(const Atoms& atoms, std::size_t leaf_size) {
  std::vector<std::uint32_t> objects(atoms.boxes.size());
  std::iota(objects.begin(), objects.end(), 0u);
  std::mt19937_64 random(1);
  for (std::size_t i = objects.size(); i > 1; --i) std::swap(objects[i - 1], objects[random() % i]);
  Growing growing(atoms, leaf_size);
  for (const std::uint32_t object : objects) growing.insert(object);
  return growing.tree();
}

}  // namespace

Span<const Builder> builders() {
  static constexpr Builder all[] = {Builder::tiling,       Builder::insertion, Builder::median,
                                    Builder::surface_area, Builder::volume,    Builder::principal_axis};
  return all;
}

std::string_view name(Builder builder) {
  switch (builder) {
    case Builder::tiling:
      return "tiling";
    case Builder::insertion:
      return "insertion";
    case Builder::median:
      return "median";
    case Builder::surface_area:
      return "surface area";
    case Builder::volume:
      return "volume";
    case Builder::principal_axis:
      return "principal axis";
  }
  throw std::invalid_argument("no such builder");
}

Tree build(Builder builder, const Objects& objects, std::size_t leaf_size) {
  if (leaf_size < 1) throw std::invalid_argument("a leaf must have room for one object");
  const Atoms atoms(objects);
  switch (builder) {
    case Builder::tiling:
      return build_by_tiling(atoms, leaf_size, 4);
    case Builder::insertion:
      return build_by_insertion(atoms, leaf_size);
    case Builder::median:
      return build_top_down(atoms, leaf_size, split_at_median);
    case Builder::surface_area:
      return build_top_down(atoms, leaf_size, split_by_surface_area);
    case Builder::volume:
      return build_top_down(atoms, leaf_size, split_by_volume);
    case Builder::principal_axis:
      return build_top_down(atoms, leaf_size, split_across_principal_axis);
  }
  throw std::invalid_argument("no such builder");
}

Tree build_top_down(const Atoms& atoms, std::size_t leaf_size, Split split) {
  Tree tree;
  if (atoms.boxes.empty()) return tree;
  tree.order.resize(atoms.boxes.size());
  std::iota(tree.order.begin(), tree.order.end(), 0u);
  tree.nodes.push_back({0, 0, 0, 0, 0, static_cast<std::uint32_t>(tree.order.size())});
  // Level by level: parts of all objects are as deep as the heuristics make them, which can be too deep for a
  // recursion.
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const std::uint32_t first = tree.nodes[i].first_object, count = tree.nodes[i].objects;
    if (count <= leaf_size) continue;
    const auto low = static_cast<std::uint32_t>(split(atoms, Span<std::uint32_t>(&tree.order[first], count)));
    const std::uint32_t depth = tree.nodes[i].depth + 1;
    tree.nodes[i].first_child = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[i].children = 2;
    tree.nodes.push_back({i, depth, 0, 0, first, low});
    tree.nodes.push_back({i, depth, 0, 0, first + low, count - low});
  }
  return tree;
}

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
