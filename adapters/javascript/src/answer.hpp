// SPDX-License-Identifier: MIT
// How functions of this module answer JavaScript: by a status, and by arrays and numbers that it reads before it calls
// again. There are no threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <utility>
#include <vector>

// Seen by JavaScript, by this name.
#define BOXSTREAM_EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace boxstream::javascript {

enum Status : std::int32_t { ok = 0, no_memory = 1, failed = 2 };

/// The layout is that which module.js reads.
struct Answer {
  struct Part {
    const void* data = nullptr;
    std::uint32_t elements = 0;
  };
  Part parts[3];
  const char* error = "";
  double numbers[6] = {};
};

extern Answer answer;

/// Keeps `memory` until `forget`.
void keep(std::size_t part, std::shared_ptr<void> memory);
void forget();

/// Part `part` of the answer has these elements, which are returned to be filled.
template <class T>
std::vector<T>& give(std::size_t part, std::vector<T>&& values) {
  const auto owner = std::make_shared<std::vector<T>>(std::move(values));
  answer.parts[part] = {owner->data(), static_cast<std::uint32_t>(owner->size())};
  keep(part, owner);
  // cppcheck-suppress returnReference // it is kept
  return *owner;
}

Status fail(const std::exception& error);

/// No exception passes into JavaScript.
template <class Work>
Status guarded(Work work) {
  try {
    work();
    return ok;
  } catch (const std::bad_alloc&) {
    return no_memory;
  } catch (const std::exception& error) {
    return fail(error);
  }
}

}  // namespace boxstream::javascript
