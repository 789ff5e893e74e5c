// SPDX-License-Identifier: MIT
#include "try_report.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>

namespace boxstream::preload {
namespace {

constexpr const char* engine_names[] = {"Bullet", "FCL"};
constexpr const char* thing_names[][2] = {{"btDbvtBroadphase", "btDbvtBroadphases"}, {"manager", "managers"}};

struct Sum {
  std::string library, not_replaced, first_difference;
  std::uint64_t calls[static_cast<int>(Kind::count)] = {};
  std::uint64_t nanoseconds = 0, pairs = 0, most_pairs = 0, sweeps = 0;
  std::uint64_t batches = 0, queries = 0, checked_pairs = 0, differing_batches = 0, differing_queries = 0, grazing = 0;

  std::uint64_t of(Kind kind) const { return calls[static_cast<int>(kind)]; }
};

Sum sum_of(const RunReport& run, int engine) {
  Sum sum;
  for (const Tally* tally : run.tallies) {
    const EngineTally& of = tally->engines[engine];
    if (!of.library[0]) continue;
    sum.library = of.library;
    if (of.not_replaced[0]) sum.not_replaced = of.not_replaced;
    if (of.first_difference[0] && sum.first_difference.empty()) sum.first_difference = of.first_difference;
    for (int kind = 0; kind < static_cast<int>(Kind::count); ++kind) sum.calls[kind] += of.calls[kind];
    sum.nanoseconds += of.nanoseconds;
    sum.pairs += of.pairs;
    sum.most_pairs += of.most_pairs;
    sum.sweeps += of.sweeps;
    sum.batches += of.checked_batches;
    sum.queries += of.checked_queries;
    sum.checked_pairs += of.checked_pairs;
    sum.differing_batches += of.differing_batches;
    sum.differing_queries += of.differing_queries;
    sum.grazing += of.grazing_rays;
  }
  return sum;
}

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// 1234567 as "1 234 567".
std::string count(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, " ");
  return digits;
}

std::string counted(std::uint64_t number, const char* one, const char* many) {
  return count(number) + " " + (number == 1 ? one : many);
}

void say(const std::string& text) {
  std::fprintf(stderr, "boxstream: %s\n", text.c_str());
}

void print_engine(int engine, const Sum& sum) {
  std::string line = file_name(sum.library) + ": ";
  if (!sum.not_replaced.empty()) return say(line + "not replaced: " + sum.not_replaced);
  line += counted(sum.of(Kind::made), thing_names[engine][0], thing_names[engine][1]) + " replaced; ";
  line += counted(sum.of(Kind::change), "change", "changes") + ", ";
  line += counted(sum.of(Kind::batch), "batch", "batches") + ", ";
  line += counted(sum.of(Kind::query), "query", "queries");
  char time[64];
  std::snprintf(time, sizeof time, "; %.3f s in them", static_cast<double>(sum.nanoseconds) * 1e-9);
  line += time;
  line += engine == static_cast<int>(Engine::bullet)
              ? "; pairs: " + count(sum.pairs) + " at the end, " + count(sum.most_pairs) + " at most"
              : "; " + counted(sum.pairs, "pair", "pairs") + " called back";
  say(line);
  if (sum.sweeps > 0) {
    say(counted(sum.sweeps, "btAxisSweep3", "btAxisSweep3") +
        " made and not replaced: programs compile a part of that class themselves");
  }
}

bool print_check(const Sum& sum) {
  const std::uint64_t differing = sum.differing_batches + sum.differing_queries;
  if (sum.batches + sum.queries == 0) {
    say("check: nothing was compared");
    return false;
  }
  std::string line = "check: " + counted(sum.batches, "batch", "batches") + " and " +
                     counted(sum.queries, "query", "queries") + " compared, " +
                     counted(sum.checked_pairs, "pair", "pairs") + ": ";
  line += differing == 0
              ? "no difference"
              : count(differing) + (differing == 1 ? " differs" : " differ") + "; the first: " + sum.first_difference;
  if (sum.grazing > 0) line += " (" + counted(sum.grazing, "ray", "rays") + " within rounding of a box)";
  say(line);
  return differing > 0;
}

/// The lines of a text of each process, each once.
template <std::size_t size>
std::set<std::string> lines_of(const RunReport& run, const char (Tally::*text)[size]) {
  std::set<std::string> all;
  for (const Tally* tally : run.tallies) {
    std::istringstream lines(tally->*text);
    for (std::string line; std::getline(lines, line);) all.insert(line);
  }
  return all;
}

void print_unreached(const RunReport& run, bool is_anything_replaced) {
  const auto lines = lines_of(run, &Tally::unreached);
  for (const std::string& line : lines) say(line);
  if (is_anything_replaced || !lines.empty()) return;
  say("no process of this program called a broad-phase of Bullet or FCL");
  std::string idle;
  for (const std::string& file : lines_of(run, &Tally::idle)) idle += (idle.empty() ? "" : ", ") + file_name(file);
  if (!idle.empty()) {
    say("loaded, and not called where that is seen: " + idle +
        " (what was loaded with RTLD_DEEPBIND and closed again is not seen)");
  }
}

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", value);
  return text;
}

void print_row(const std::string& name, double own, double ours) {
  std::fprintf(stderr, "  %-44s %12s %12s %8.2f\n", name.c_str(), seconds(own).c_str(), seconds(ours).c_str(),
               ours > 0 ? own / ours : 0.0);
}

}  // namespace

std::vector<const Tally*> read_tallies(const std::string& folder) {
  std::vector<const Tally*> tallies;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const int file = open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) continue;
    struct stat status {};
    if (fstat(file, &status) == 0 && status.st_size == static_cast<off_t>(sizeof(Tally))) {
      void* const at = mmap(nullptr, sizeof(Tally), PROT_READ, MAP_SHARED, file, 0);
      if (at != MAP_FAILED && static_cast<const Tally*>(at)->magic == Tally::magic_number) {
        tallies.push_back(static_cast<const Tally*>(at));
      }
    }
    close(file);
  }
  return tallies;
}

bool print_report(const RunReport& run, bool is_check) {
  bool differs = false;
  bool found = false;
  for (int engine = 0; engine < static_cast<int>(Engine::count); ++engine) {
    const Sum sum = sum_of(run, engine);
    if (sum.library.empty()) continue;
    found = true;
    print_engine(engine, sum);
    if (is_check && sum.not_replaced.empty()) differs |= print_check(sum);
  }
  print_unreached(run, found);
  return differs;
}

void print_comparison(const RunReport& own, const RunReport& ours) {
  std::fprintf(stderr, "  %-44s %12s %12s %8s\n", "", "engine's own", "boxstream", "ratio");
  print_row("the whole program", own.seconds, ours.seconds);
  for (int engine = 0; engine < static_cast<int>(Engine::count); ++engine) {
    const Sum a = sum_of(own, engine);
    const Sum b = sum_of(ours, engine);
    if (a.library.empty() || b.library.empty()) continue;
    print_row(std::string("calls of ") + engine_names[engine] + "'s broad-phases and callbacks",
              static_cast<double>(a.nanoseconds) * 1e-9, static_cast<double>(b.nanoseconds) * 1e-9);
  }
}

}  // namespace boxstream::preload
