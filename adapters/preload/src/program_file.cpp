// SPDX-License-Identifier: MIT
#include "program_file.hpp"

#include <elf.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace boxstream::preload {
namespace {

bool is_program(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(file.c_str(), X_OK) == 0;
}

/// Programs of another kind than ELF, such as scripts, are loaded by one that is.
bool is_static(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  ElfW(Ehdr) header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!stream || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment{};
    stream.seekg(static_cast<std::streamoff>(header.e_phoff + i * header.e_phentsize));
    stream.read(reinterpret_cast<char*>(&segment), sizeof segment);
    if (!stream) return false;
    if (segment.p_type == PT_INTERP) return false;
  }
  return true;
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
  struct stat status {};
  if (stat(file.c_str(), &status) == 0 && (status.st_mode & (S_ISUID | S_ISGID)) && geteuid() != 0) {
    return "runs with the rights of another user, and the system preloads nothing into such programs";
  }
  if (is_static(file)) return "is linked statically, so nothing can be preloaded into it";
  return "";
}

}  // namespace boxstream::preload
