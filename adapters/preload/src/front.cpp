// SPDX-License-Identifier: MIT
// The library that is preloaded. It exports Bullet's and FCL's functions under their own names, so that calls to them
// come here, and passes each to the replacement of the engine that the process has loaded. It needs neither engine, so
// one library serves all programs, and programs that call no engine notice nothing of it.
#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "backend.hpp"
#include "loaded_engine.hpp"
#include "own_tally.hpp"

namespace boxstream::preload {
namespace {

struct Site {
  const char* name;
  Engine engine;
  std::uint8_t manager;
  std::uint8_t member;
  Kind kind;
};

enum : unsigned {
#define X(manager, member, kind, name) site_##manager##_##member,
  BOXSTREAM_PRELOAD_BULLET(X) BOXSTREAM_PRELOAD_FCL(X) BOXSTREAM_PRELOAD_SWEEPS(X)
#undef X
};

constexpr Site sites[] = {
#define X(manager, member, kind, name) \
  {name, Engine::bullet, 0, static_cast<std::uint8_t>(BulletMember::member), Kind::kind},
    BOXSTREAM_PRELOAD_BULLET(X)
#undef X
#define X(manager, member, kind, name)                                                                              \
  {name, Engine::fcl, static_cast<std::uint8_t>(FclManager::manager), static_cast<std::uint8_t>(FclMember::member), \
   Kind::kind},
        BOXSTREAM_PRELOAD_FCL(X)
#undef X
#define X(manager, member, kind, name) {name, Engine::bullet, 0, 0, Kind::other},
            BOXSTREAM_PRELOAD_SWEEPS(X)
#undef X
};
constexpr unsigned site_count = sizeof sites / sizeof *sites;

struct Route {
  LoadedEngine engine;
  Backend backend{};
  EngineTally* tally = nullptr;
  Function own[site_count] = {};
};

Route routes[static_cast<int>(Engine::count)];
pthread_once_t opened_once[] = {PTHREAD_ONCE_INIT, PTHREAD_ONCE_INIT};
thread_local bool runs_own = false;
thread_local unsigned depth = 0;

[[noreturn]] void give_up(const char* what, const char* name) {
  std::fprintf(stderr, "boxstream: %s %s\n", what, name);
  std::abort();
}

Route& route_of(Engine engine) {
  return routes[static_cast<int>(engine)];
}

Word own(unsigned site, const Words& words) {
  const Function function = route_of(sites[site].engine).own[site];
  if (!function) give_up("the engine's library does not have", sites[site].name);
  const bool before = runs_own;
  runs_own = true;
  const Word result = call(function, words);
  runs_own = before;
  return result;
}

Mode mode() {
  const char* text = std::getenv("BOXSTREAM_TRY_MODE");
  if (text && std::strcmp(text, "check") == 0) return Mode::check;
  if (text && std::strcmp(text, "measure") == 0) return Mode::measure;
  return Mode::replace;
}

void open_route(Engine engine) {
  Route& route = route_of(engine);
  route.tally = &own_tally().engines[static_cast<int>(engine)];
  route.engine = find_loaded(engine);
  if (!route.engine.handle)
    give_up("a broad-phase is called, and there is no library of", engine == Engine::fcl ? "FCL" : "Bullet");
  std::snprintf(route.tally->library, sizeof route.tally->library, "%s", route.engine.file);
  for (unsigned site = 0; site < site_count; ++site) {
    if (sites[site].engine == engine) {
      route.own[site] = reinterpret_cast<Function>(dlsym(route.engine.handle, sites[site].name));
    }
  }
  if (!route.engine.replacement) {
    std::snprintf(route.tally->not_replaced, sizeof route.tally->not_replaced, "%s", route.engine.why_not);
    return;
  }
  char file[4096];
  beside_this_library(route.engine.replacement, file, sizeof file);
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  const auto make = library ? reinterpret_cast<BackendMaker>(dlsym(library, backend_maker)) : nullptr;
  if (!make) {
    std::snprintf(route.tally->not_replaced, sizeof route.tally->not_replaced, "%s", dlerror());
    return;
  }
  route.backend = make({mode(), route.tally, own});
}

Route& opened(Engine engine) {
  pthread_once(
      &opened_once[static_cast<int>(engine)],
      engine == Engine::bullet ? [] { open_route(Engine::bullet); } : [] { open_route(Engine::fcl); });
  return route_of(engine);
}

std::uint64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000u + static_cast<std::uint64_t>(time.tv_nsec);
}

// Of changes, which may be many and short, one in sixteen is timed.
constexpr unsigned timed_changes = 16;

Word dispatch(unsigned site, const Words& words) {
  const Site& row = sites[site];
  if (runs_own) return own(site, words);
  Route& route = opened(row.engine);
  const std::uint64_t number = route.tally->calls[static_cast<int>(row.kind)].fetch_add(1, std::memory_order_relaxed);
  if (!route.backend.call) return own(site, words);
  const unsigned weight = row.kind == Kind::change ? (number % timed_changes == 0 ? timed_changes : 0) : 1;
  const bool is_timed = depth == 0 && weight > 0;
  const std::uint64_t begin = is_timed ? now() : 0;
  ++depth;
  const Word result = route.backend.call(site, row.manager, row.member, words);
  --depth;
  if (is_timed) route.tally->nanoseconds.fetch_add(weight * (now() - begin), std::memory_order_relaxed);
  return result;
}

Word pass_sweep(unsigned site, const Words& words) {
  Route& route = opened(Engine::bullet);
  route.tally->sweeps.fetch_add(1, std::memory_order_relaxed);
  return own(site, words);
}

}  // namespace

#define BOXSTREAM_HOOK(manager, member, name, way)                                          \
  extern "C" __attribute__((visibility("default")))                                         \
  Word manager##_##member(Word, Word, Word, Word, Word, Word, Word, Word) __asm__(name);    \
  Word manager##_##member(Word a, Word b, Word c, Word d, Word e, Word f, Word g, Word h) { \
    return way(site_##manager##_##member, {{a, b, c, d, e, f, g, h}});                      \
  }
#define X(manager, member, kind, name) BOXSTREAM_HOOK(manager, member, name, dispatch)
BOXSTREAM_PRELOAD_BULLET(X)
BOXSTREAM_PRELOAD_FCL(X)
#undef X
#define X(manager, member, kind, name) BOXSTREAM_HOOK(manager, member, name, pass_sweep)
BOXSTREAM_PRELOAD_SWEEPS(X)
#undef X

}  // namespace boxstream::preload
