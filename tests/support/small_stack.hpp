// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <gtest/gtest.h>
#include <pthread.h>

#include "sanitized.hpp"

namespace boxstream::tests {

/// Runs `work` in a thread with a stack of 64 KiB. Under a sanitizer with a megabyte, as its own frames and the gaps
/// between variables take more than the code does.
inline void on_small_stack(std::function<void()> work) {
  constexpr std::size_t bytes = (sanitized ? 1024 : 64) * 1024;
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, bytes), 0);
  pthread_t thread;
  const auto start = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, start, &work), 0);
  ASSERT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

}  // namespace boxstream::tests
