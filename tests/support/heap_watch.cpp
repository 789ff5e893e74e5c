// SPDX-License-Identifier: MIT
#include "heap_watch.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace boxstream::tests::heap_watch {

namespace {

std::atomic<std::uint64_t> count{0};
std::atomic<std::int64_t> live{0}, bytes{0}, peak{0};
std::atomic<bool> failing{false};
std::atomic<bool> failed{false};
std::atomic<std::int64_t> trials{0};
std::atomic<std::int64_t> first_failure{never}, second_failure{never}, all_from{never};

bool refuses() {
  if (!failing.load()) return false;
  const std::int64_t number = trials++;
  if (number != first_failure && number != second_failure && !(all_from != never && number >= all_from)) return false;
  failed = true;
  return true;
}

void fail(std::int64_t first, std::int64_t second, std::int64_t all) {
  failed = false;
  trials = 0;
  first_failure = first;
  second_failure = second;
  all_from = all;
  failing = true;
}

void* record(void* block) {
  if (block == nullptr) return nullptr;
  ++count;
  ++live;
  const std::int64_t now = bytes += static_cast<std::int64_t>(malloc_usable_size(block));
  std::int64_t most = peak.load();
  while (most < now && !peak.compare_exchange_weak(most, now)) {
  }
  return block;
}

void* allocate(std::size_t size) noexcept {
  if (refuses()) return nullptr;
  return record(std::malloc(std::max<std::size_t>(size, 1)));
}

void* allocate(std::size_t size, std::align_val_t alignment) noexcept {
  if (refuses()) return nullptr;
  const auto step = static_cast<std::size_t>(alignment);
  return record(std::aligned_alloc(step, (std::max<std::size_t>(size, 1) + step - 1) / step * step));
}

void release(void* block) {
  if (block == nullptr) return;
  --live;
  bytes -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

void* or_throw(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

std::uint64_t allocations() {
  return count;
}
std::int64_t live_allocations() {
  return live;
}
std::int64_t live_bytes() {
  return bytes;
}
std::int64_t peak_bytes() {
  return peak;
}
void reset_peak() {
  peak = bytes.load();
}

void fail_after(std::int64_t allowed) {
  fail(never, never, allowed);
}

void fail_at(std::int64_t first, std::int64_t then) {
  fail(first, then == never ? never : first + 1 + then, never);
}

bool stop_failing() {
  failing = false;
  first_failure = second_failure = all_from = never;
  return failed;
}

std::int64_t tried() {
  return trials;
}

Failures::Failures(bool come) : came_(failing.exchange(come)) {}
Failures::~Failures() {
  failing = came_;
}

}  // namespace boxstream::tests::heap_watch

namespace watch = boxstream::tests::heap_watch;

void* operator new(std::size_t n) {
  return watch::or_throw(watch::allocate(n));
}
void* operator new[](std::size_t n) {
  return watch::or_throw(watch::allocate(n));
}
void* operator new(std::size_t n, std::align_val_t a) {
  return watch::or_throw(watch::allocate(n, a));
}
void* operator new[](std::size_t n, std::align_val_t a) {
  return watch::or_throw(watch::allocate(n, a));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept {
  return watch::allocate(n);
}
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept {
  return watch::allocate(n);
}
void* operator new(std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
  return watch::allocate(n, a);
}
void* operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept {
  return watch::allocate(n, a);
}
void operator delete(void* p) noexcept {
  watch::release(p);
}
void operator delete[](void* p) noexcept {
  watch::release(p);
}
void operator delete(void* p, std::size_t) noexcept {
  watch::release(p);
}
void operator delete[](void* p, std::size_t) noexcept {
  watch::release(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  watch::release(p);
}
void operator delete[](void* p, std::align_val_t) noexcept {
  watch::release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  watch::release(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
  watch::release(p);
}
