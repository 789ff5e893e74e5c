// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

/// The public core in one include.
#include <boxstream/aabb.hpp>
#include <boxstream/box_index.hpp>
#include <boxstream/box_span.hpp>
#include <boxstream/decomposition.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/near.hpp>
#include <boxstream/object_set.hpp>
#include <boxstream/out_of_core.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/plane.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>
#include <boxstream/splice.hpp>
#include <boxstream/stats.hpp>
#include <boxstream/version.hpp>
#include <boxstream/world.hpp>
