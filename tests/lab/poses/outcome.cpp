// SPDX-License-Identifier: MIT
#include "outcome.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "gaps.hpp"
#include "process.hpp"
#include "truth.hpp"

namespace boxstream::poses {
namespace {

/// FCL's default tolerance, and the scale of the smaller shape.
double tolerance(const HardPose& pose) {
  return 1e-6 * std::max(1.0, std::min(radius(pose.a), radius(pose.b)));
}

/// Without enable_signed_distance FCL answers 0 or -1 for what touches or overlaps, and documents it.
std::string distance_error(const HardPose& pose, double value) {
  const double t = tolerance(pose);
  if (pose.query == Query::distance && pose.truth <= t && (value == -1 || std::abs(value) <= t)) return {};
  return std::abs(value - pose.truth) <= t ? "" : "distance";
}

std::string contact_error(const HardPose& pose, bool is_contact, double depth, double normal_length) {
  const double t = tolerance(pose);
  if (is_contact != (pose.truth < 0) && std::abs(pose.truth) > t) return is_contact ? "false contact" : "missed";
  if (!is_contact) return {};
  if (!(std::abs(normal_length - 1) < 1e-6)) return "normal of length " + std::to_string(normal_length).substr(0, 4);
  return std::abs(depth + std::min(pose.truth, 0.0)) <= t ? "" : "depth";
}

/// From the lines that the program prints as it goes.
Outcome read(const HardPose& pose, const std::string& lines) {
  Outcome outcome;
  outcome.value = std::numeric_limits<double>::quiet_NaN();
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "pair") {
      int first = 0;
      words >> first;
      ++outcome.delivered;
      outcome.in_order &= first == 0;
    } else if (word == "distance") {
      std::string value;
      words >> value;
      outcome.value = std::strtod(value.c_str(), nullptr);
      outcome.message = distance_error(pose, outcome.value);
      outcome.kind = outcome.message.empty() ? "right" : "wrong";
    } else if (word == "contact") {
      std::string is, depth, length;
      words >> is >> depth >> length;
      const double deep = std::strtod(depth.c_str(), nullptr);
      if (is == "1") outcome.value = -deep;
      outcome.message = contact_error(pose, is == "1", deep, std::strtod(length.c_str(), nullptr));
      outcome.kind = outcome.message.empty() ? "right" : "wrong";
    } else if (word == "threw") {
      outcome.kind = "throws";
      std::getline(words >> std::ws, outcome.message);
    } else if (word == "after") {
      words >> outcome.after;
    }
  }
  return outcome;
}

/// How the process ended says more than what it printed, if it did not end by itself.
void note_end(Outcome& outcome, const tool_test::Outcome& ended) {
  if (ended.exit_code == 128 + SIGXCPU)
    outcome.kind = "no end";
  else if (ended.exit_code == 128 + SIGABRT)
    outcome.kind = "aborts";
  else if (ended.exit_code != 0)
    outcome.kind = "crashes";
  else if (outcome.kind.empty())
    outcome.kind = "silent";
  if (ended.exit_code != 0) outcome.message = ended.err.substr(0, ended.err.find('\n'));
}

tool_test::RunOptions limits() {
  tool_test::RunOptions options;
  options.cpu_seconds = 5;  // most take milliseconds, two cones on one place about as long
  return options;
}

}  // namespace

Outcome run(const std::string& program, const HardPose& pose, Manager manager, Solver solver) {
  const auto ended = tool_test::run_program(program, {pose.name, name(manager), name(solver)}, limits());
  Outcome outcome = read(pose, ended.out);
  note_end(outcome, ended);
  return outcome;
}

std::vector<Outcome> run_gaps(const std::string& program, Solver solver) {
  constexpr int at_once = 50;
  const std::string mark = "case\n";
  std::vector<Outcome> outcomes;
  while (outcomes.size() < gap_poses) {
    const int first = static_cast<int>(outcomes.size()), last = std::min(first + at_once, gap_poses);
    const auto ended = tool_test::run_program(
        program, {"--gaps", name(solver), std::to_string(first), std::to_string(last)}, limits());
    for (std::size_t at = ended.out.find(mark); at != std::string::npos;) {
      const std::size_t next = ended.out.find(mark, at + 1);
      outcomes.push_back(read(gap_pose(static_cast<int>(outcomes.size())), ended.out.substr(at, next - at)));
      if (next == std::string::npos) note_end(outcomes.back(), ended);
      at = next;
    }
    if (static_cast<int>(outcomes.size()) == first) throw std::runtime_error(program + " --gaps: no answers");
  }
  return outcomes;
}

const char* name(Manager manager) {
  return manager == Manager::boxstream ? "boxstream" : "native";
}

const char* name(Solver solver) {
  return solver == Solver::libccd ? "libccd" : "indep";
}

}  // namespace boxstream::poses
