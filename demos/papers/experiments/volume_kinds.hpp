// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/dop.hpp"
#include "papers/volumes/oriented_box.hpp"
#include "papers/volumes/sphere.hpp"

namespace boxstream::papers {

/// Calls `run.template operator()<V>()` for each kind of bounding volume.
template <class Run>
void for_each_volume(const Run& run) {
  run.template operator()<volumes::AxisBox>();
  run.template operator()<volumes::Sphere>();
  run.template operator()<volumes::OrientedBox>();
  run.template operator()<volumes::Dop<14>>();
  run.template operator()<volumes::Dop<18>>();
  run.template operator()<volumes::Dop<26>>();
}

}  // namespace boxstream::papers
