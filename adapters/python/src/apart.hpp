// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace boxstream::python {

/// From so many boxes on, what finds no pairs for a while is run apart.
inline constexpr std::size_t least_apart = 200'000;

/// Runs `work` on a thread of its own, without the interpreter's lock, and returns when it has ended; throws what it
/// throws. Signals are handled meanwhile. If their handlers raise, that passes through at once: the work, which
/// `left`, if it is given, tells that nobody waits, goes on, and what it holds is let go by a later call. So it holds
/// all that it uses. For a thread that has the interpreter's lock.
void run_apart(std::function<void()> work, std::atomic<bool>* left = nullptr);

/// Lets go what work that has ended by now held, if its caller did not wait for it.
void let_go();

}  // namespace boxstream::python
