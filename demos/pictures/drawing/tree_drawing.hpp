// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "drawable.hpp"
#include "poster.hpp"

namespace boxstream::picture {

/// A rooted tree, leaves side by side, each node above the middle of what is below it.
struct TreeDrawing {
  struct Node {
    std::size_t parent;  ///< comes before the node; the root is its own
    Colour colour;
  };
  struct Key {
    Colour colour;
    std::string text;
  };
  std::string title;
  std::string small_print;
  std::vector<Key> keys;
  std::vector<Node> nodes;  ///< at least one; the root is the first
};

/// Throws std::runtime_error.
void write_tree(const TreeDrawing& tree, std::ostream& out, PictureFormat format);

}  // namespace boxstream::picture
