// SPDX-License-Identifier: MIT
// Loads unreached_bullet.cpp as a library, with RTLD_DEEPBIND if a second word is given, and runs it.
#include <dlfcn.h>

int main(int count, char** words) {
  void* const library = dlopen(words[1], RTLD_LAZY | (count > 2 ? RTLD_DEEPBIND : 0));
  return reinterpret_cast<int (*)(const char*)>(dlsym(library, "make"))("tree");
}
