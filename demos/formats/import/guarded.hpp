// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace boxstream::imports {

/// Limits of a reader, beyond which it is stopped.
struct Allowance {
  unsigned cpu_seconds = 10;
  unsigned wall_seconds = 60;
  std::size_t memory = std::size_t{2} << 30;  // bytes on top of what the caller has
};

/// Generous limits for a file of this size and kind.
Allowance allowance_for(const std::string& path);

/// What `work` returns, computed in a child process: libraries that read foreign files may crash, loop or allocate
/// without bound on broken ones, and that must not end this program. The child has the caller's
/// memory as it was, so `work` may use everything but cannot change anything; its standard streams lead nowhere.
///
/// Throws scenes::SceneError "FILE: reason" on one line when `work` throws, crashes or takes more than it may.
///
/// Does not keep `work` from reading other files; those it notes as read (files::note_read) are noted here too.
std::string guarded(const std::string& file, const std::function<std::string()>& work, const Allowance& allowance);

}  // namespace boxstream::imports
