// SPDX-License-Identifier: MIT
#include "answer.hpp"

#include <cstdlib>
#include <string>

#include <boxstream/detector.hpp>

namespace boxstream::javascript {

Answer answer;

namespace {
std::shared_ptr<void> kept[3];
std::string text;
}  // namespace

void keep(std::size_t part, std::shared_ptr<void> memory) {
  kept[part] = std::move(memory);
}

void forget() {
  for (auto& memory : kept) memory.reset();
}

Status fail(const std::exception& error) {
  text = error.what();
  answer.error = text.c_str();
  return failed;
}

}  // namespace boxstream::javascript

using namespace boxstream::javascript;

BOXSTREAM_EXPORT(answer) Answer* boxstream_answer() {
  return &answer;
}

/// Gives the memory of an answer back.
BOXSTREAM_EXPORT(forget) void boxstream_forget() {
  forget();
}

/// 0 if there is none.
BOXSTREAM_EXPORT(allocate) void* boxstream_allocate(std::size_t bytes) {
  return std::malloc(bytes);
}

BOXSTREAM_EXPORT(release) void boxstream_release(void* memory) {
  std::free(memory);
}

BOXSTREAM_EXPORT(simdTarget) const char* boxstream_javascript_simd_target() {
  return boxstream::simd_target();
}
