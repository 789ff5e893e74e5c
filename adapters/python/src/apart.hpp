// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace boxstream::python {

/// From so many boxes on, what finds no pairs for a while is run apart.
inline constexpr std::size_t least_apart = 200'000;

/// The same of what handles no signals where it finds pairs: eight million of them may take a quarter of a second.
inline constexpr std::size_t least_apart_silent = 4'000;

/// Runs `work` on a thread of its own, without the interpreter's lock, and returns when it has ended; throws what it
/// throws. Signals are handled meanwhile.
///
/// An exception of a signal handler is thrown at once, while the work runs on; `*left`, if given, is set to true, and
/// the work may end early then. So the work must own all that it uses. A later call frees what it owned. Needs the
/// interpreter's lock.
void run_apart(std::function<void()> work, std::atomic<bool>* left = nullptr);

/// Frees what abandoned work owned, if it has ended by now.
void let_go();

}  // namespace boxstream::python
