// SPDX-License-Identifier: MIT
#include "papers/volumes/builders.hpp"

#include <stdexcept>

#include "papers/volumes/insertion.hpp"
#include "papers/volumes/splits.hpp"
#include "papers/volumes/tiling.hpp"
#include "papers/volumes/top_down.hpp"

namespace boxstream::papers::volumes {

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

}  // namespace boxstream::papers::volumes
