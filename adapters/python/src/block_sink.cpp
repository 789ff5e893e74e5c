// SPDX-License-Identifier: MIT
#include "block_sink.hpp"

#include <string>

namespace boxstream::python {

namespace {

enum class Answer { go_on, stop, raised };

/// Takes `block` over.
Answer ask(PyObject* callback, PyObject* block) {
  PyObject* const answer = PyObject_CallFunctionObjArgs(callback, block, nullptr);
  Py_DECREF(block);
  if (answer == nullptr) return Answer::raised;
  const bool stops = answer == Py_False;
  Py_DECREF(answer);
  return PyErr_CheckSignals() != 0 ? Answer::raised : stops ? Answer::stop : Answer::go_on;
}

}  // namespace

Blocks::Blocks(py::handle callable, py::handle block, Indices type)
    : callback(callable), size(count_of(block, "block", 1)), indices(type) {
  if (PyCallable_Check(callable.ptr()) == 0)
    throw py::type_error("callback: expected a callable, got an object of type " + type_of(callable));
}

bool BlockSink::pass_on() {
  passed_ += held_.size();
  const Unlocked::Locked locked(unlocked_);
  PyObject* const block = index_array(std::exchange(held_, {}), blocks_.indices, 2).release().ptr();
  const Answer answer = in_python([&] { return ask(blocks_.callback.ptr(), block); });
  if (answer == Answer::raised) throw Raised();
  return answer == Answer::go_on;
}

}  // namespace boxstream::python
