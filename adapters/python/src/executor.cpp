// SPDX-License-Identifier: MIT
#include "executor.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <thread>

#include "arguments.hpp"

namespace boxstream::python {

namespace {

std::shared_ptr<ThreadPool> make_pool(py::handle threads) {
  constexpr std::size_t most = 4096;
  const std::size_t count = threads.is_none() ? std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most)
                                              : count_of(threads, "threads", 1);
  if (count > most) throw py::value_error("threads: expected at most 4096, got " + text_of(threads));
  // The threads of a forked process's parent cannot be waited for.
  return {new ThreadPool(static_cast<unsigned>(count)), [](ThreadPool* pool) {
            if (!pool->is_forked()) delete pool;
          }};
}

}  // namespace

void add_executor(py::module_& module) {
  py::class_<ThreadPool, std::shared_ptr<ThreadPool>>(module, "Executor", R"(Executor(threads=None)

Threads for searches. Results do not depend on their number.

threads: int from 1 to 4096, the calling thread included; None: as many as this process may use.

One Executor may serve any number of Detectors and Worlds. Of searches that run at the same time, one gets its
threads; the others run on the thread that called them. In a child made by os.fork, where there are no other threads,
searches run on the calling thread, those too whose callback forked.)")
      .def(py::init(&make_pool), py::arg("threads") = py::none())
      .def_property_readonly("threads", &ThreadPool::concurrency,
                             "int: the number of threads, the calling one included; 1 in the child of a fork.")
      .def("__repr__", [](const ThreadPool& pool) {
        return "boxstream.Executor(threads=" + std::to_string(pool.concurrency()) + ")";
      });
}

}  // namespace boxstream::python
