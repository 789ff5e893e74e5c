// SPDX-License-Identifier: MIT
#include "own_tally.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "loaded_engine.hpp"
#include "unreached.hpp"

namespace boxstream::preload {
namespace {

Tally unshared;
Tally* tally = &unshared;
pthread_once_t tally_once = PTHREAD_ONCE_INIT;

void open_tally() {
  const char* const folder = std::getenv("BOXSTREAM_TRY_TALLIES");
  if (!folder) return;
  // A process that goes on as another program keeps its number, so numbers alone do not tell them apart.
  int file = -1;
  for (int i = 0; file < 0 && i < 1000; ++i) {
    char path[4096];
    std::snprintf(path, sizeof path, "%s/%ld-%d", folder, static_cast<long>(getpid()), i);
    file = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0 && errno != EEXIST) return;
  }
  if (file < 0) return;
  if (ftruncate(file, sizeof(Tally)) == 0) {
    void* const at = mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (at != MAP_FAILED) tally = static_cast<Tally*>(at);
  }
  close(file);
  tally->magic = Tally::magic_number;
  tally->process = static_cast<std::uint64_t>(getpid());
  const ssize_t length = readlink("/proc/self/exe", tally->program, sizeof tally->program - 1);
  tally->program[length > 0 ? length : 0] = 0;
}

// At the end of a process: what of it was not reached, if that can be seen.
struct AtExit {
  ~AtExit() {
    if (!std::getenv("BOXSTREAM_TRY_TALLIES")) return;
    Tally& own = own_tally();
    find_unreached(own.unreached, sizeof own.unreached);
    for (int engine = 0; engine < static_cast<int>(Engine::count); ++engine) {
      if (own.engines[engine].library[0]) continue;
      const LoadedEngine loaded = find_loaded(static_cast<Engine>(engine));
      const std::size_t used = std::strlen(own.idle);
      if (loaded.file[0]) std::snprintf(own.idle + used, sizeof own.idle - used, "%s\n", loaded.file);
    }
  }
} at_exit;

}  // namespace

Tally& own_tally() {
  pthread_once(&tally_once, open_tally);
  return *tally;
}

}  // namespace boxstream::preload
