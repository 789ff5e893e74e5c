// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

#include <boxstream/executor.hpp>

#include "random.hpp"

namespace boxstream::tests {

/// Claims a number of threads, and that they start so soon, but runs everything on the calling one, first task first.
class InlineExecutor final : public Executor {
 public:
  explicit InlineExecutor(unsigned concurrency, std::uint32_t start_nanoseconds = 50000)
      : concurrency_(concurrency), start_nanoseconds_(start_nanoseconds) {}
  unsigned concurrency() const override { return concurrency_; }
  std::uint32_t start_nanoseconds() override { return start_nanoseconds_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    ++calls_;
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
  std::size_t calls() const { return calls_; }

 private:
  unsigned concurrency_;
  std::uint32_t start_nanoseconds_;
  std::size_t calls_ = 0;
};

/// Last task first.
class ReversedExecutor final : public Executor {
 public:
  explicit ReversedExecutor(unsigned concurrency) : concurrency_(concurrency) {}
  unsigned concurrency() const override { return concurrency_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = count; i > 0; --i) task(i - 1);
  }

 private:
  unsigned concurrency_;
};

/// Tasks in an order that is another one at each call.
class ShuffledExecutor final : public Executor {
 public:
  explicit ShuffledExecutor(unsigned concurrency) : concurrency_(concurrency) {}
  unsigned concurrency() const override { return concurrency_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    random_.shuffle(order);
    for (const std::size_t i : order) task(i);
  }

 private:
  unsigned concurrency_;
  Random random_{1};
};

/// Everything on a thread that is not the calling one, first task first.
class ElsewhereExecutor final : public Executor {
 public:
  explicit ElsewhereExecutor(unsigned concurrency) : concurrency_(concurrency) {}
  unsigned concurrency() const override { return concurrency_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::thread([&] {
      for (std::size_t i = 0; i < count; ++i) task(i);
    }).join();
  }

 private:
  unsigned concurrency_;
};

/// Starts that many threads at each call; they take tasks from a shared counter. With `late`, every other thread
/// sleeps before its first task, so that tasks are taken in an uneven way. It says that they start at once.
class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(unsigned threads, bool late = false) : threads_(threads), late_(late) {}
  unsigned concurrency() const override { return threads_; }
  std::uint32_t start_nanoseconds() override { return 0; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::atomic<std::size_t> next{0};
    const auto work = [&](unsigned thread) {
      if (late_ && thread % 2 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      for (std::size_t i = next++; i < count; i = next++) task(i);
    };
    std::vector<std::thread> threads;
    for (unsigned t = 1; t < threads_; ++t) threads.emplace_back(work, t);
    work(0);
    for (std::thread& thread : threads) thread.join();
  }

 private:
  unsigned threads_;
  bool late_;
};

}  // namespace boxstream::tests
