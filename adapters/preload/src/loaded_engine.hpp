// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "tally.hpp"

namespace boxstream::preload {

/// A library of an engine that the process has loaded.
struct LoadedEngine {
  void* handle = nullptr;  ///< as dlsym takes it; null: none is loaded
  char file[256] = {};
  const char* replacement = nullptr;  ///< file name of what replaces its broad-phases; null: nothing does
  char why_not[256] = {};
};

LoadedEngine find_loaded(Engine engine);

/// The path of a file beside the preloaded library.
void beside_this_library(const char* name, char* path, std::size_t size);

bool is_library_of_engine(const char* path);

}  // namespace boxstream::preload
