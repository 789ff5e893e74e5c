// SPDX-License-Identifier: MIT
#include "boxstream/shared/print.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <string_view>

#include "base/words.hpp"

namespace boxstream::tool {
namespace {

/// Errors of the library begin with its name, which is that of the tool.
void write_remark(const char* begin, const std::string& text, const char* end) {
  const std::string name = "boxstream: ";
  const std::size_t from = text.compare(0, name.size(), name) == 0 ? name.size() : 0;
  std::fprintf(stderr, "%sboxstream:%s %s\n", begin, end, files::printable(text.substr(from)).c_str());
}

std::string duration(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 100 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

bool is_terminal(int descriptor) {
  const char* const kind = std::getenv("TERM");
  return isatty(descriptor) == 1 && kind && std::string_view(kind) != "dumb";
}

bool shows_colours(int descriptor) {
  const char* const unwanted = std::getenv("NO_COLOR");
  return is_terminal(descriptor) && (unwanted == nullptr || *unwanted == '\0');
}

void print_raw(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output: cannot be written");
}

void print(const std::string& text) {
  print_raw(files::printable_lines(text));
}

void print_help(const std::string& text) {
  const std::string lines = files::printable_lines(text);
  static const std::regex heading("(^|\n)([A-Z][a-z]+:)");
  print_raw(shows_colours(STDOUT_FILENO) ? std::regex_replace(lines, heading, "$1\x1b[1m$2\x1b[0m") : lines);
}

void remark(const std::string& text) noexcept try { write_remark("", text, ""); } catch (...) {
  std::fputs("boxstream: out of memory\n", stderr);
}

void complain(const std::string& text) noexcept try {
  if (!shows_colours(STDERR_FILENO)) return remark(text);
  write_remark("\x1b[1;31m", text, "\x1b[0m");
} catch (...) {
  std::fputs("boxstream: out of memory\n", stderr);
}

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

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ' ');
  return digits;
}

}  // namespace boxstream::tool
