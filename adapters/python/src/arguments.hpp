// SPDX-License-Identifier: MIT
// Arguments that are not arrays. As for arrays, what does not fit is one exception with what was expected and given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include <boxstream/detector.hpp>

#include "executor.hpp"

namespace boxstream::python {

namespace py = pybind11;

/// str(object), for messages.
std::string text_of(py::handle object);

/// The name of its type, for messages.
std::string type_of(py::handle object);

/// Whether it is one number, or nothing that could be several: to be read by `number_of`.
bool is_one_number(py::handle given);

/// Any number that Python takes for a float.
double number_of(py::handle given, const char* name);

/// An integer that is not below `least`.
std::size_t count_of(py::handle given, const char* name, std::size_t least);

/// An Executor, or null for None.
std::shared_ptr<ThreadPool> executor_of(py::handle given);

/// 'planned' or 'hybrid', and the cutoff of the latter: an integer of 32 bits, 0 for samples.
Method method_of(py::handle given);
std::uint32_t cutoff_of(py::handle given);

/// 1, 2 or 3.
int dimensions_of(py::handle given);

/// True or False.
bool flag_of(py::handle given, const char* name);

/// The argument `copy`: None, as needed, or True or False.
bool may_copy(py::handle given);

/// What happens to boxes and balls with a NaN, or with min > max.
enum class Invalid { warn, skip, raise };

/// 'warn', 'skip' or 'raise'.
Invalid invalid_policy(py::handle given);

}  // namespace boxstream::python
