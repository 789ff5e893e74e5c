// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/box_index.hpp>

#include "bvh/bvh.hpp"

namespace boxstream {

/// The slots of the tree are the indices of boxes. Invalid ones are not in it.
template <class S>
struct BasicBoxIndex<S>::Impl {
  detail::Bvh<S> bvh;
  std::size_t size = 0;
};

}  // namespace boxstream
