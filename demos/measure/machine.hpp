// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace boxstream::measure {

/// Model name of the processor, or "unknown CPU".
std::string cpu_name();
/// Name and version of the compiler of this program.
std::string compiler_name();
/// Of boxstream, as "1.2.3".
std::string library_version();

/// Where and how the numbers of a run were made.
struct Machine {
  std::string cpu;
  unsigned hardware_threads;
  std::string compiler;
  std::string flags;
  std::string peer_flags;  ///< of peers compiled with other flags; else as `flags`
  std::string simd;
  std::string date;  ///< UTC, ISO 8601
  double load;       ///< average number of runnable threads over the last minute; 0 is an idle machine
  std::string version;
  std::string commit;  ///< of the sources, from the environment's BOXSTREAM_COMMIT; may be empty
};

Machine describe_machine();

/// The block "machine" of files of results.
nlohmann::ordered_json to_json(const Machine& machine);

/// How busy others keep the machine while this process measures. Processors share caches, memory and often a core: work
/// that others do beside a pinned thread makes it slower, and no clock of that thread shows it.
class OtherLoad {
 public:
  /// Since this object was made: processors kept busy by other processes, 0 to all of them. NaN where the system does
  /// not tell.
  double processors() const;

 private:
  /// Seconds, of all processors together.
  struct Spent {
    double elapsed, busy, own;
  };
  static Spent now();

  Spent start_ = now();
};

}  // namespace boxstream::measure
