// SPDX-License-Identifier: MIT
#include "box_index.hpp"
#include "detector.hpp"
#include "executor.hpp"
#include "world.hpp"

namespace {

void fill(pybind11::module_& module) {
  using namespace boxstream::python;
  // Their texts begin with a signature that can be read.
  pybind11::options options;
  options.disable_function_signatures();
  add_executor(module);
  add_stats(module);
  add_detector(module);
  add_world(module);
  add_box_index(module);
  module.def("simd_target", &boxstream::simd_target, R"(simd_target()

The name of the SIMD target that searches use here: 'AVX3', 'AVX2', 'SSE4', 'NEON' and so on.)");
  module.attr("__version__") = BOXSTREAM_PYTHON_VERSION;
}

}  // namespace

// What PYBIND11_MODULE makes, except where pybind11 would wait for ever.
extern "C" PYBIND11_EXPORT PyObject* PyInit__core() {
  if (PyInterpreterState_Get() != PyInterpreterState_Main()) {
    PyErr_SetString(PyExc_ImportError, "boxstream: cannot be imported by a subinterpreter");
    return nullptr;
  }
  PYBIND11_ENSURE_INTERNALS_READY
  static pybind11::module_::module_def definition;
  auto module = pybind11::module_::create_extension_module("_core", nullptr, &definition);
  try {
    fill(module);
    return module.ptr();
  }
  PYBIND11_CATCH_INIT_EXCEPTIONS
}
