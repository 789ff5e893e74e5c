// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
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

/// What the first version of the struct had, which stays enough where it grows.
constexpr std::size_t least_executor =
    offsetof(boxstream_executor, start_nanoseconds) + sizeof(boxstream_executor::start_nanoseconds);

/// As much of a struct as its user and the library know of; the rest is null.
inline boxstream_executor known_of(const boxstream_executor& given) {
  boxstream_executor known{};
  std::memcpy(&known, &given, std::min(given.size, sizeof known));
  return known;
}

/// Null for null.
inline std::unique_ptr<Executor> make_executor(const boxstream_executor* functions) {
  if (functions == nullptr) return nullptr;
  if (functions->size < least_executor || functions->concurrency == nullptr || functions->parallel_for == nullptr)
    throw std::invalid_argument("an executor needs its size, concurrency and parallel_for");
  return std::make_unique<CExecutor>(known_of(*functions));
}

}  // namespace boxstream::c
