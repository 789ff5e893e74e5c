// SPDX-License-Identifier: MIT
#include "boxstream/shared/status_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "base/printable.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/terminal.hpp"

namespace boxstream::tool {
namespace {

std::string duration(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 100 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

StatusLine::StatusLine() : terminal_(is_terminal(STDERR_FILENO)), begun_(Clock::now()), shown_(begun_) {}

StatusLine::~StatusLine() {
  clear();
}

void StatusLine::clear() {
  if (terminal_) std::fputs("\r\x1b[K", stderr);
}

void StatusLine::step(std::uint64_t done, std::uint64_t all, std::uint64_t bodies, std::uint64_t pairs) {
  const Clock::time_point now = Clock::now();
  const std::uint64_t tenths = done * 10 / all;
  const bool due = terminal_ ? now - shown_ >= std::chrono::milliseconds(100)
                             : tenths > tenths_ && now - begun_ >= std::chrono::seconds(2);
  if (!due) return;
  tenths_ = tenths;
  const double spent = std::chrono::duration<double>(now - begun_).count();
  const double left = spent / static_cast<double>(done) * static_cast<double>(all - done);
  const std::string text =
      fmt::format("step {}/{}   {} bodies   {} pairs   about {} left", done, all, bodies, pairs, duration(left));
  terminal_ ? say(text) : remark(text);
}

void StatusLine::run(std::size_t run, std::size_t all, double seconds_left, const std::string& what) {
  const Clock::time_point now = Clock::now();
  std::string text = fmt::format("run {} of {}: {}", run, all, what);
  if (!std::isnan(seconds_left)) text += fmt::format(", about {} left for one of each", duration(seconds_left));
  if (terminal_) return say(text);
  if (has_said_ && now - shown_ < std::chrono::seconds(10)) return;
  has_said_ = true;
  shown_ = now;
  remark(text);
}

void StatusLine::say(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\x1b[K{}", files::printable(text));
  std::fflush(stderr);
  shown_ = Clock::now();
}

}  // namespace boxstream::tool
