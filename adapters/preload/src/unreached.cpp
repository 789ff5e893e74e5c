// SPDX-License-Identifier: MIT
#include "unreached.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <utility>

#include "loaded_engine.hpp"
#include "members.hpp"

namespace boxstream::preload {
namespace {

// The names of types that every object has within it that was compiled from an engine's broad-phases, even if it is
// stripped; those of templates up to what differs.
struct Compiled {
  const char* name;
  const char* what;
};
constexpr Compiled compiled[] = {
    {"16btDbvtBroadphase", "btDbvtBroadphase"},
    {"N3fcl31DynamicAABBTreeCollisionManagerI", "a dynamic tree of FCL"},
    {"N3fcl37DynamicAABBTreeCollisionManager_ArrayI", "a dynamic tree of FCL"},
    {"N3fcl28IntervalTreeCollisionManagerI", "an interval tree of FCL"},
    {"N3fcl21NaiveCollisionManagerI", "a naive manager of FCL"},
    {"N3fcl20SSaPCollisionManagerI", "a sweep-and-prune manager of FCL"},
    {"N3fcl19SaPCollisionManagerI", "a sweep-and-prune manager of FCL"},
    {"N3fcl30SpatialHashingCollisionManagerI", "a spatial hash of FCL"},
};

// The functions by which a program makes a broad-phase of an engine's library.
struct Maker {
  const char* name;       ///< or what it begins with
  const char* not_taken;  ///< what it makes, if that is not replaced
};
constexpr Maker makers[] = {
#define X(manager, member, kind, name) {Kind::kind == Kind::made ? name : nullptr, nullptr},
    BOXSTREAM_PRELOAD_BULLET(X) BOXSTREAM_PRELOAD_FCL(X)
#undef X
        {"_ZN18btSimpleBroadphaseC", "btSimpleBroadphase"},
    {"_ZN3fcl30SpatialHashingCollisionManagerIdNS_6detail15SimpleHashTableINS_4AABBIdEEPNS_15CollisionObjectIdEENS1_"
     "11SpatialHashIdEEEEEC",
     "fcl::SpatialHashingCollisionManager"},
};

class Lines {
 public:
  Lines(char* text, std::size_t size) : text_(text), size_(size) {}

  __attribute__((format(printf, 2, 3))) void add(const char* format, ...) {
    char line[1024];
    va_list values;
    va_start(values, format);
    const int length = std::vsnprintf(line, sizeof line - 1, format, values);
    va_end(values);
    if (length < 0) return;
    std::strcat(line, "\n");
    const std::size_t used = std::strlen(text_);
    if (!std::strstr(text_, line) && used + std::strlen(line) < size_) std::strcpy(text_ + used, line);
  }

 private:
  char* text_;
  std::size_t size_;
};

const char* name_of(const dl_phdr_info& object) {
  return object.dlpi_name[0] ? object.dlpi_name : "the program itself";
}

void look_for_copies(const dl_phdr_info& object, Lines& lines) {
  // Constants have segments of their own, unless the linker put them beside code; that takes time to look through.
  bool has_constants = false;
  const auto is_read_only = [](const ElfW(Phdr) & segment) {
    return segment.p_type == PT_LOAD && (segment.p_flags & PF_R) && !(segment.p_flags & PF_W);
  };
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    has_constants = has_constants || (is_read_only(object.dlpi_phdr[i]) && !(object.dlpi_phdr[i].p_flags & PF_X));
  }
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const auto& segment = object.dlpi_phdr[i];
    if (!is_read_only(segment) || (has_constants && (segment.p_flags & PF_X))) continue;
    const auto* const begin = reinterpret_cast<const char*>(object.dlpi_addr + segment.p_vaddr);
    const auto* const end = begin + segment.p_filesz;
    // With a zero before it, this is the name of a type, not part of a symbol's.
    for (const auto& [start, length] : {std::pair("\0N3fcl", 6), std::pair("\00016btDbvtBroadphase", 19)}) {
      const auto* at = begin;
      while ((at = static_cast<const char*>(
                  memmem(at, static_cast<std::size_t>(end - at), start, static_cast<std::size_t>(length))))) {
        ++at;
        for (const Compiled& row : compiled) {
          const std::size_t size = std::strlen(row.name);
          if (static_cast<std::size_t>(end - at) > size && std::memcmp(at, row.name, size) == 0) {
            lines.add("%s has %s compiled into it, which cannot be replaced from outside", name_of(object), row.what);
          }
        }
      }
    }
  }
}

const void* base_of(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) != 0 ? info.dli_fbase : nullptr;
}

/// What an object's dynamic section points to.
struct Dynamic {
  const char* strings = nullptr;
  const ElfW(Sym) * symbols = nullptr;
  struct Table {
    const ElfW(Rela) * rows = nullptr;
    std::size_t size = 0;
  } relocations, jumps;

  explicit Dynamic(const dl_phdr_info& object) {
    const ElfW(Dyn)* entry = nullptr;
    for (int i = 0; i < object.dlpi_phnum; ++i) {
      if (object.dlpi_phdr[i].p_type == PT_DYNAMIC) {
        entry = reinterpret_cast<const ElfW(Dyn)*>(object.dlpi_addr + object.dlpi_phdr[i].p_vaddr);
      }
    }
    // The loader writes addresses here, except into the one object that the kernel gives.
    const auto at = [&](ElfW(Addr) address) {
      return address < object.dlpi_addr ? object.dlpi_addr + address : address;
    };
    for (; entry && entry->d_tag != DT_NULL; ++entry) {
      const ElfW(Addr) address = at(entry->d_un.d_ptr);
      if (entry->d_tag == DT_STRTAB) strings = reinterpret_cast<const char*>(address);
      if (entry->d_tag == DT_SYMTAB) symbols = reinterpret_cast<const ElfW(Sym)*>(address);
      if (entry->d_tag == DT_RELA) relocations.rows = reinterpret_cast<const ElfW(Rela)*>(address);
      if (entry->d_tag == DT_RELASZ) relocations.size = entry->d_un.d_val / sizeof(ElfW(Rela));
      if (entry->d_tag == DT_JMPREL) jumps.rows = reinterpret_cast<const ElfW(Rela)*>(address);
      if (entry->d_tag == DT_PLTRELSZ) jumps.size = entry->d_un.d_val / sizeof(ElfW(Rela));
      if (entry->d_tag == DT_PLTREL && entry->d_un.d_val != DT_RELA) jumps.size = 0;
    }
    if (!strings || !symbols) relocations.size = jumps.size = 0;
  }
};

/// Where the calls of an object come out. Those that are bound when they are first made point into the object before.
void look_for_calls(const dl_phdr_info& object, Lines& lines) {
  const void* const ours = base_of(reinterpret_cast<void*>(&base_of));
  const Dynamic dynamic(object);
  for (const auto& [rows, count] : {dynamic.relocations, dynamic.jumps}) {
    for (std::size_t i = 0; rows && i < count; ++i) {
      const auto symbol = __ELF_NATIVE_CLASS == 64 ? rows[i].r_info >> 32 : rows[i].r_info >> 8;
      if (symbol == 0) continue;
      const char* const name = dynamic.strings + dynamic.symbols[symbol].st_name;
      if (std::strncmp(name, "_ZN", 3) != 0) continue;
      for (const Maker& maker : makers) {
        if (!maker.name || std::strncmp(name, maker.name, std::strlen(maker.name)) != 0) continue;
        const void* const called = *reinterpret_cast<void* const*>(object.dlpi_addr + rows[i].r_offset);
        Dl_info info{};
        if (dladdr(called, &info) == 0 || info.dli_fbase == ours || !is_library_of_engine(info.dli_fname)) continue;
        if (maker.not_taken) {
          lines.add("%s can make %s of %s, which is not replaced", name_of(object), maker.not_taken, info.dli_fname);
        } else {
          lines.add("%s binds its calls of %s past what is preloaded, as RTLD_DEEPBIND has it: not replaced",
                    name_of(object), info.dli_fname);
        }
      }
    }
  }
}

int look_through(dl_phdr_info* object, std::size_t, void* data) {
  if (is_library_of_engine(object->dlpi_name)) return 0;
  Dl_info self{};
  if (dladdr(reinterpret_cast<void*>(&look_through), &self) != 0 && std::strcmp(self.dli_fname, object->dlpi_name) == 0)
    return 0;
  if (std::strstr(object->dlpi_name, "/libboxstream-preload-")) return 0;
  auto& lines = *static_cast<Lines*>(data);
  look_for_copies(*object, lines);
  look_for_calls(*object, lines);
  return 0;
}

}  // namespace

void find_unreached(char* text, std::size_t size) {
  Lines lines(text, size);
  dl_iterate_phdr(look_through, &lines);
}

}  // namespace boxstream::preload
