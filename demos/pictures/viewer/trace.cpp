// SPDX-License-Identifier: MIT
#include "pictures/viewer/trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace boxstream::view {
namespace {

using scenes::StepResult;

struct Phase {
  const char* name;
  double StepResult::*ms;
};
// In the order in which Bullet runs them.
constexpr Phase phases[] = {{"updateAabbs", &StepResult::update_aabbs_ms},
                            {"calculateOverlappingPairs", &StepResult::overlapping_pairs_ms},
                            {"dispatchAllCollisionPairs", &StepResult::dispatch_ms},
                            {"solveConstraints", &StepResult::solve_ms}};

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::int64_t nanoseconds(double ms) {
  return std::llround(ms * 1e6);
}

/// The unit of trace events.
std::string microseconds(std::int64_t ns) {
  return fmt::format("{}.{:03}", ns / 1000, ns % 1000);
}

class Events {
 public:
  explicit Events(std::ostream& out) : out_(out) {}

  void name_process(std::size_t process, const std::string& name) {
    put(R"({{"ph":"M","pid":{},"name":"process_name","args":{{"name":{}}}}})", process, quoted(name));
    put(R"({{"ph":"M","pid":{},"tid":1,"name":"thread_name","args":{{"name":"step"}}}})", process);
  }

  void step(std::size_t process, const StepResult& s) {
    // Whole nanoseconds, so that phases add up to their step and never reach out of it.
    std::int64_t sum = 0;
    for (const Phase& phase : phases) sum += nanoseconds(s.*phase.ms);
    const std::int64_t whole = std::max(sum, nanoseconds(s.step_ms));
    span(process, "step", now_, whole, fmt::format(R"({{"step":{},"state_hash":"{:016x}"}})", s.step, s.state_hash));
    std::int64_t at = now_;
    for (const Phase& phase : phases) {
      span(process, phase.name, at, nanoseconds(s.*phase.ms));
      at += nanoseconds(s.*phase.ms);
    }
    span(process, "rest", at, whole - sum);
    count(process, "pairs", s.pairs);
    count(process, "pairs begun", s.begun);
    count(process, "pairs ended", s.ended);
    count(process, "objects", s.bodies);
    now_ += whole;
    if (s.queries_ms > 0) {
      span(process, "queries", now_, nanoseconds(s.queries_ms),
           fmt::format(R"({{"ray_hits":{},"boxes":{},"contacts":{}}})", s.ray_hits, s.query_boxes, s.query_contacts));
      now_ += nanoseconds(s.queries_ms);
    }
  }

 private:
  void span(std::size_t process, const char* name, std::int64_t from, std::int64_t length,
            const std::string& arguments = "{}") {
    put(R"({{"ph":"X","pid":{},"tid":1,"name":"{}","ts":{},"dur":{},"args":{}}})", process, name, microseconds(from),
        microseconds(length), arguments);
  }
  void count(std::size_t process, const char* name, std::uint64_t value) {
    put(R"({{"ph":"C","pid":{},"name":"{}","ts":{},"args":{{"value":{}}}}})", process, name, microseconds(now_), value);
  }
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    out_ << (first_ ? "\n" : ",\n") << fmt::format(format, std::forward<Arguments>(arguments)...);
    first_ = false;
  }

  std::ostream& out_;
  std::int64_t now_ = 0;
  bool first_ = true;
};

}  // namespace

void write_trace(std::ostream& out, const scenes::Scene& scene, const std::vector<TracedWorld>& worlds,
                 const std::string& versions) {
  out << fmt::format(
      R"({{"displayTimeUnit":"ms","otherData":{{"scene":{},"about":{},"dt":{},"made_by":{},)"
      R"("times":"durations are measured; steps follow each other without gaps, phases in Bullet's order"}},)"
      R"("traceEvents":[)",
      quoted(scene.meta.name), quoted(scene.meta.about), scene.time.dt, quoted(versions));
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    Events events(out);
    if (i > 0) out << ',';
    events.name_process(i + 1, fmt::format("{} on {}", scene.meta.name, worlds[i].broadphase));
    for (const StepResult& step : *worlds[i].steps) events.step(i + 1, step);
  }
  out << "\n]}\n";
}

}  // namespace boxstream::view
