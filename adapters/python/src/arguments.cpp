// SPDX-License-Identifier: MIT
#include "arguments.hpp"

namespace boxstream::python {

namespace {

[[noreturn]] void refuse_type(const std::string& name, const std::string& expected, py::handle given) {
  throw py::type_error(name + ": expected " + expected + ", got an object of type " + type_of(given));
}

}  // namespace

std::string text_of(py::handle object) {
  return py::str(object);
}

std::string type_of(py::handle object) {
  return text_of(py::type::handle_of(object).attr("__name__"));
}

bool is_one_number(py::handle given) {
  if (PySequence_Check(given.ptr()) == 0 || py::isinstance<py::str>(given)) return true;
  return py::hasattr(given, "ndim") && given.attr("ndim").cast<int>() == 0;
}

double number_of(py::handle given, const char* name) {
  const double value = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() == nullptr) return value;
  if (PyErr_ExceptionMatches(PyExc_OverflowError) != 0) {
    PyErr_Clear();
    throw py::value_error(std::string(name) + ": expected a number that float64 has, got one that is too large");
  }
  // What else the object's own code raises, such as KeyboardInterrupt, is not about its type.
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  refuse_type(name, "a number", given);
}

std::size_t count_of(py::handle given, const char* name, std::size_t least) {
  if (PyIndex_Check(given.ptr()) == 0) refuse_type(name, "an integer", given);
  const Py_ssize_t value = PyNumber_AsSsize_t(given.ptr(), nullptr);  // the nearest that there is
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (value < 0 || static_cast<std::size_t>(value) < least)
    throw py::value_error(std::string(name) + ": expected an integer of at least " + std::to_string(least) + ", got " +
                          text_of(given));
  return static_cast<std::size_t>(value);
}

std::shared_ptr<ThreadPool> executor_of(py::handle given) {
  if (given.is_none()) return nullptr;
  if (!py::isinstance<ThreadPool>(given)) refuse_type("executor", "an Executor or None", given);
  return given.cast<std::shared_ptr<ThreadPool>>();
}

Method method_of(py::handle given) {
  const std::string text = text_of(given);
  if (text == "planned") return Method::planned;
  if (text == "hybrid") return Method::hybrid;
  throw py::value_error("method: expected 'planned' or 'hybrid', got " + std::string(py::repr(given)));
}

std::uint32_t cutoff_of(py::handle given) {
  const std::size_t cutoff = count_of(given, "cutoff", 0);
  if (cutoff > UINT32_MAX)
    throw py::value_error("cutoff: expected an integer below 2^32, got " + std::to_string(cutoff));
  return static_cast<std::uint32_t>(cutoff);
}

Invalid invalid_policy(py::handle given) {
  const std::string text = text_of(given);
  if (text == "warn") return Invalid::warn;
  if (text == "skip") return Invalid::skip;
  if (text == "raise") return Invalid::raise;
  throw py::value_error("invalid: expected 'warn', 'skip' or 'raise', got " + std::string(py::repr(given)));
}

int dimensions_of(py::handle given) {
  const std::size_t dimensions = count_of(given, "dimensions", 1);
  if (dimensions > 3) throw py::value_error("dimensions: expected 1, 2 or 3, got " + text_of(given));
  return static_cast<int>(dimensions);
}

bool flag_of(py::handle given, const char* name) {
  if (py::isinstance<py::bool_>(given)) return given.cast<bool>();
  const bool is_numpys = py::hasattr(given, "dtype") && text_of(given.attr("dtype")) == "bool";
  if (is_numpys && is_one_number(given)) return given.attr("item")().cast<bool>();
  throw py::type_error(std::string(name) + ": expected True or False, got " + std::string(py::repr(given)));
}

bool may_copy(py::handle given) {
  return given.is_none() || flag_of(given, "copy");
}

}  // namespace boxstream::python
