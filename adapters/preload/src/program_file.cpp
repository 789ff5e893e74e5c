// SPDX-License-Identifier: MIT
#include "program_file.hpp"

#include <elf.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

namespace boxstream::preload {
namespace {

bool is_program(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(file.c_str(), X_OK) == 0;
}

/// Empty if it is no ELF: programs of another kind, such as scripts, are loaded by one that is.
std::optional<ElfW(Ehdr)> header_of(std::ifstream& stream) {
  ElfW(Ehdr) header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!stream || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return std::nullopt;
  return header;
}

bool is_static(std::ifstream& stream, const ElfW(Ehdr) & header) {
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment{};
    stream.seekg(static_cast<std::streamoff>(header.e_phoff + i * header.e_phentsize));
    stream.read(reinterpret_cast<char*>(&segment), sizeof segment);
    if (!stream) return false;
    if (segment.p_type == PT_INTERP) return false;
  }
  return true;
}

/// Whether the system starts it with rights that the caller does not have, and so trusts no variable of his.
bool has_other_rights(const std::string& file) {
  struct stat status {};
  struct statvfs mount {};
  if (stat(file.c_str(), &status) != 0 || (statvfs(file.c_str(), &mount) == 0 && (mount.f_flag & ST_NOSUID)))
    return false;
  if ((status.st_mode & S_ISUID) && status.st_uid != getuid()) return true;
  if ((status.st_mode & S_ISGID) && (status.st_mode & S_IXGRP) && status.st_gid != getgid()) return true;
  return geteuid() != 0 && getxattr(file.c_str(), "security.capability", nullptr, 0) > 0;
}

}  // namespace

std::string find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return is_program(name) ? name : "";
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = (folder.empty() ? "." : folder) + "/" + name;
    if (is_program(file)) return file;
  }
  return "";
}

std::string why_not_found(const std::string& name) {
  struct stat status {};
  if (name.empty() || stat(name.c_str(), &status) != 0) return "there is no program " + name;
  if (S_ISDIR(status.st_mode)) return name + " is a folder, not a program";
  if (name.find('/') == std::string::npos && access(name.c_str(), X_OK) == 0)
    return "there is no program " + name + " in PATH: is it ./" + name + "?";
  return name + " is a file that cannot be run: if it is a script, name what runs it, as in python3 " + name;
}

std::string why_not_preloaded(const std::string& file) {
  std::ifstream stream(file, std::ios::binary), self("/proc/self/exe", std::ios::binary);
  const auto header = header_of(stream), own = header_of(self);
  if (!header) return "";
  if (has_other_rights(file)) {
    return "runs with rights that you do not have, and the system preloads nothing into such programs";
  }
  if (own && (header->e_ident[EI_CLASS] != own->e_ident[EI_CLASS] || header->e_machine != own->e_machine)) {
    return "is for another processor, or of other word size, than this boxstream: it cannot be loaded into it";
  }
  if (is_static(stream, *header)) return "is linked statically, so nothing can be preloaded into it";
  return "";
}

}  // namespace boxstream::preload
