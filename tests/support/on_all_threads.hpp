// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace boxstream::tests {

constexpr int thread_count = 8;

/// Runs `task(thread)` on all threads at once: none starts before all are there.
template <class Task>
void on_all_threads(Task task) {
  std::atomic<int> waiting{thread_count};
  std::vector<std::thread> threads;
  for (int t = 0; t < thread_count; ++t)
    threads.emplace_back([&waiting, &task, t] {
      --waiting;
      while (waiting.load() > 0) std::this_thread::yield();
      task(t);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace boxstream::tests
