// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include <boxstream/executor.hpp>

#include "status.hpp"

namespace boxstream::c {

/// An executor of functions that C gave.
class CExecutor final : public Executor {
 public:
  explicit CExecutor(const boxstream_executor& functions) : functions_(functions) {}

  unsigned concurrency() const override {
    const unsigned tasks = functions_.concurrency(functions_.user);
    return tasks > 0 ? tasks : 1;
  }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    functions_.parallel_for(
        functions_.user, count,
        [](void* context, std::size_t i) { (*static_cast<FunctionRef<void(std::size_t)>*>(context))(i); }, &task);
  }

  std::uint32_t start_nanoseconds() override {
    return functions_.start_nanoseconds != nullptr ? functions_.start_nanoseconds(functions_.user)
                                                   : Executor::start_nanoseconds();
  }

 private:
  boxstream_executor functions_;
};

/// Null for null.
inline std::unique_ptr<Executor> make_executor(const boxstream_executor* functions) {
  if (functions == nullptr) return nullptr;
  if (functions->size < sizeof(boxstream_executor) || functions->concurrency == nullptr ||
      functions->parallel_for == nullptr)
    throw std::invalid_argument("an executor needs its size, concurrency and parallel_for");
  return std::make_unique<CExecutor>(*functions);
}

}  // namespace boxstream::c
