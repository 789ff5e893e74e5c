// SPDX-License-Identifier: MIT
#pragma once

#include <ucontext.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <boxstream/executor.hpp>

namespace boxstream::tests {

/// Fibres of one thread that take turns: each runs until it yields. They end in any order, so that nothing of theirs is
/// first in, last out. Bodies must not throw.
class Fibres {
 public:
  void add(std::function<void()> body) { fibres_.push_back(std::make_unique<Fibre>(std::move(body))); }

  /// Returns when all have ended.
  void run() {
    active() = this;
    for (auto& fibre : fibres_) start(*fibre);
    for (bool any = true; any;) {
      any = false;
      for (auto& fibre : fibres_) {
        if (fibre->has_ended) continue;
        any = true;
        running_ = fibre.get();
        swapcontext(&home_, &fibre->context);
        running_ = nullptr;
      }
    }
    fibres_.clear();
    active() = nullptr;
  }

  /// Lets the others go on. Does nothing outside of them.
  void yield() {
    Fibre* const self = running_;
    if (self == nullptr) return;
    ++yields_;
    swapcontext(&self->context, &home_);
  }
  std::size_t yields() const { return yields_; }

 private:
  struct Fibre {
    explicit Fibre(std::function<void()> b) : body(std::move(b)), stack(std::size_t{1} << 20) {}
    std::function<void()> body;
    std::vector<char> stack;
    ucontext_t context;
    bool has_ended = false;
  };

  static Fibres*& active() {
    static Fibres* fibres = nullptr;
    return fibres;
  }

  void start(Fibre& fibre) {
    getcontext(&fibre.context);
    fibre.context.uc_stack.ss_sp = fibre.stack.data();
    fibre.context.uc_stack.ss_size = fibre.stack.size();
    fibre.context.uc_link = nullptr;
    makecontext(
        &fibre.context,
        [] {
          Fibres& all = *active();
          Fibre& self = *all.running_;
          self.body();
          self.has_ended = true;
          swapcontext(&self.context, &all.home_);
        },
        0);
  }

  std::vector<std::unique_ptr<Fibre>> fibres_;
  Fibre* running_ = nullptr;
  ucontext_t home_;
  std::size_t yields_ = 0;
};

/// Lets other fibres go on after each task.
class FibreExecutor final : public Executor {
 public:
  explicit FibreExecutor(Fibres& fibres) : fibres_(fibres) {}
  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) {
      task(i);
      fibres_.yield();
    }
  }

 private:
  Fibres& fibres_;
};

}  // namespace boxstream::tests
