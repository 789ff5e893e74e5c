// SPDX-License-Identifier: MIT
#include "detector.hpp"
#include "executor.hpp"
#include "world.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace boxstream::python;
  // Their texts begin with a signature that can be read.
  pybind11::options options;
  options.disable_function_signatures();
  add_executor(module);
  add_stats(module);
  add_detector(module);
  add_world(module);
  module.def("simd_target", &boxstream::simd_target, R"(simd_target()

The name of the SIMD target that searches use here: 'AVX3', 'AVX2', 'SSE4', 'NEON' and so on.)");
  module.attr("__version__") = BOXSTREAM_PYTHON_VERSION;
}
