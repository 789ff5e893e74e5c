// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "thread_pool.hpp"

namespace boxstream::python {

using threads::ThreadPool;

void add_executor(pybind11::module_& module);

}  // namespace boxstream::python
