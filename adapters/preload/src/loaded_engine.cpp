// SPDX-License-Identifier: MIT
#include "loaded_engine.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdio>
#include <cstring>

namespace boxstream::preload {
namespace {

// The libraries that the replacements were compiled for: another version of an engine may have other layouts.
struct Known {
  Engine engine;
  const char* library;
  const char* replacement;
};
constexpr Known known[] = {
#ifdef BOXSTREAM_PRELOAD_BULLET_LIBRARY
    {Engine::bullet, BOXSTREAM_PRELOAD_BULLET_LIBRARY, "libboxstream-preload-bullet.so"},
#endif
#ifdef BOXSTREAM_PRELOAD_BULLET_FLOAT64_LIBRARY
    {Engine::bullet, BOXSTREAM_PRELOAD_BULLET_FLOAT64_LIBRARY, "libboxstream-preload-bullet-float64.so"},
#endif
#ifdef BOXSTREAM_PRELOAD_FCL_LIBRARY
    {Engine::fcl, BOXSTREAM_PRELOAD_FCL_LIBRARY, "libboxstream-preload-fcl.so"},
#endif
    {Engine::count, "", nullptr},
};

const char* base_name(const char* path) {
  const char* const slash = std::strrchr(path, '/');
  return slash ? slash + 1 : path;
}

bool is_library_of(Engine engine, const char* path) {
  const char* const name = base_name(path);
  return engine == Engine::bullet ? std::strncmp(name, "libBulletCollision", 18) == 0
                                  : std::strncmp(name, "libfcl.", 7) == 0;
}

struct Search {
  Engine engine;
  LoadedEngine found;
};

int look(dl_phdr_info* info, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  if (!is_library_of(search.engine, info->dlpi_name)) return 0;
  std::snprintf(search.found.file, sizeof search.found.file, "%s", info->dlpi_name);
  return 1;
}

/// The name that a loaded library has for those that link it.
void soname_of(void* handle, char* name, std::size_t size) {
  const link_map* map = nullptr;
  name[0] = 0;
  if (dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0) return;
  const char* strings = nullptr;
  ElfW(Xword) offset = 0;
  for (const ElfW(Dyn)* entry = map->l_ld; entry->d_tag != DT_NULL; ++entry) {
    if (entry->d_tag == DT_STRTAB) strings = reinterpret_cast<const char*>(entry->d_un.d_ptr);
    if (entry->d_tag == DT_SONAME) offset = entry->d_un.d_val;
  }
  if (strings && offset) std::snprintf(name, size, "%s", strings + offset);
}

}  // namespace

LoadedEngine find_loaded(Engine engine) {
  Search search{engine, {}};
  dl_iterate_phdr(look, &search);
  LoadedEngine& found = search.found;
  if (!found.file[0]) return found;
  found.handle = dlopen(found.file, RTLD_LAZY | RTLD_NOLOAD);
  if (!found.handle) return found;
  char name[128];
  soname_of(found.handle, name, sizeof name);
  for (const Known& row : known) {
    if (row.engine == engine && std::strcmp(row.library, name) == 0) found.replacement = row.replacement;
  }
  if (!found.replacement) {
    std::snprintf(found.why_not, sizeof found.why_not, "boxstream was built with another version of this library");
  }
  return found;
}

void beside_this_library(const char* name, char* path, std::size_t size) {
  Dl_info self{};
  dladdr(reinterpret_cast<void*>(&beside_this_library), &self);
  const char* const slash = std::strrchr(self.dli_fname, '/');
  const int length = slash ? static_cast<int>(slash - self.dli_fname + 1) : 0;
  std::snprintf(path, size, "%.*s%s", length, self.dli_fname, name);
}

bool is_library_of_engine(const char* path) {
  return is_library_of(Engine::bullet, path) || is_library_of(Engine::fcl, path);
}

}  // namespace boxstream::preload
