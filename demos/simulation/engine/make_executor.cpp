// SPDX-License-Identifier: MIT
#include "simulation/engine/make_executor.hpp"

#ifdef BOXSTREAM_SCENES_HAVE_TBB
#include <boxstream/tbb.hpp>
#else
#include <stdexcept>
#endif

namespace boxstream::scenes {

std::unique_ptr<Executor> make_executor(int threads) {
#ifdef BOXSTREAM_SCENES_HAVE_TBB
  return std::make_unique<TbbExecutor>(threads);
#else
  throw std::runtime_error("a search on " + std::to_string(threads) + " threads takes a build with oneTBB");
#endif
}

}  // namespace boxstream::scenes
