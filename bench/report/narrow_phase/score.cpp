// SPDX-License-Identifier: MIT
#include "narrow_phase/score.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "measure/interleave.hpp"

namespace boxstream::report::narrow {
namespace {

using How = Answer::How;

/// Coordinates are a few sizes, and each has half a unit in its last place.
constexpr double rounding = 1e-15;

/// Without a contact nothing of the depth is found. What touches has no distance.
double error_of(Query query, double value, double truth) {
  if (query == Query::distance) return std::abs(std::fmax(value, 0) - std::fmax(truth, 0));
  return std::isnan(value) ? std::fmax(-truth, 0) : std::abs(value - truth);
}

bool touches(double value) {
  return value <= 0;  // NaN: no contact
}

std::string failures(std::span<const Answer> answers) {
  std::string text;
  for (const auto& [how, verb] : {std::pair(How::unsure, "not sure"),
                                  {How::threw, "throws"},
                                  {How::aborted, "aborts"},
                                  {How::crashed, "crashes"},
                                  {How::no_end, "no end"}}) {
    std::size_t count = 0;
    for (const Answer& answer : answers) count += answer.how == how;
    if (count == 0) continue;
    text += (text.empty() ? "" : "; ") + std::string(verb) + " on " + std::to_string(count) + " of " +
            std::to_string(answers.size());
  }
  return text;
}

}  // namespace

Score score(Query query, std::span<const Pose> poses, std::span<const Answer> answers) {
  Score score;
  std::vector<double> errors;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (answers[i].how != How::answered) {
      score.unanswered += 1;
      continue;
    }
    score.missed += poses[i].truth < -rounding * poses[i].size && !touches(answers[i].value);
    score.extra += poses[i].truth > rounding * poses[i].size && touches(answers[i].value);
    errors.push_back(error_of(query, answers[i].value, poses[i].truth) / poses[i].size);
  }
  const bool has_errors = query != Query::verdict && !errors.empty();
  score.error_max = has_errors ? measure::quantile(errors, 1) : std::nan("");
  score.error_p95 = has_errors ? measure::quantile(errors, 0.95) : std::nan("");
  for (double* share : {&score.missed, &score.extra, &score.unanswered}) *share /= static_cast<double>(poses.size());
  score.failure = failures(answers);
  return score;
}

}  // namespace boxstream::report::narrow
