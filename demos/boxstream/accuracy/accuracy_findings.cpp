// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boxstream/accuracy/accuracy_result.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Row;
using Findings = std::vector<std::pair<std::string, std::string>>;

/// What the others are compared with, and how far that can be trusted.
void add_reference(const AccuracyResult& result, Findings& all) {
  const accuracy::Reference& reference = result.sweep.reference;
  if (result.request.truth.value)
    all.emplace_back("truth", fmt::format("{} is {:g}", judge(result)->name, *result.request.truth.value));
  if (!reference.failure.empty()) all.emplace_back("reference", "none: " + reference.failure);
  if (reference.name.empty()) return;
  std::string text = reference.name;
  if (reference.is_estimated()) {
    text += fmt::format("; by the runs before it, it is off by up to {:.2g} m", reference.error.back());
    if (reference.angle_error.back() > 0) text += fmt::format(" and {:.2g} degrees", reference.angle_error.back());
    text += ": smaller differences from it are equal";
  }
  all.emplace_back("reference", text);
  if (!reference.remark.empty()) all.emplace_back("", reference.remark);
  if (reference.holds < result.sweep.seconds)
    all.emplace_back("",
                     fmt::format("it holds for {:.3g} s of {:.3g} s: then finer steps end elsewhere, and there is no "
                                 "one answer; what still says something is energy, momentum, penetration, "
                                 "joint_error, the scene's checks, and the statistics of many runs",
                                 reference.holds, result.sweep.seconds));
}

std::string prefix(const accuracy::Line& line) {
  return line.name.empty() ? "" : line.name + ": ";
}

void add_orders(const AccuracyResult& result, Findings& all) {
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep))
    if (const auto order = accuracy::order_of_convergence(result.request, result.sweep, line, place_of_judge(result)))
      all.emplace_back("order", fmt::format("{}{:.2f} in {}", prefix(line), *order, result.request.knobs.back().name));
}

void add_costs(const AccuracyResult& result, Findings& all) {
  if (!result.bound) return;
  if (const double band = band_of(result, place_of_judge(result)); *result.bound < band)
    all.emplace_back("bound",
                     fmt::format("{:g} is less than the {:.2g} that the reference may be off by: whether it is kept "
                                 "is not known",
                                 *result.bound, band));
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep))
    if (const auto cost = accuracy::cost_at(result.request, result.sweep, line, place_of_judge(result), *result.bound))
      all.emplace_back(fmt::format("at {:g}", *result.bound),
                       fmt::format("{}{:.3g} ms ({:.3g} - {:.3g}){}", prefix(line), cost->median, cost->low, cost->high,
                                   cost->is_measured ? ", its cheapest" : ", between two settings"));
}

std::string times_own(const AccuracyResult& result, std::size_t best) {
  const auto own = result.sweep.own;
  if (!own || *own == best || !result.sweep.rows[*own].failure.empty()) return "";
  const Row &row = result.sweep.rows[best], &plain = result.sweep.rows[*own];
  return fmt::format(", {:.2g} times the scene as it is ({:.2g} - {:.2g})", row.ms.median / plain.ms.median,
                     row.ms.low / plain.ms.high, row.ms.high / plain.ms.low);
}

/// The one to take.
void add_advice(const AccuracyResult& result, Findings& all) {
  const std::string what =
      result.bound ? fmt::format(" with {} of at most {:g}", judge(result)->name, *result.bound) : std::string();
  const auto best = advised(result);
  if (!best) {
    all.emplace_back("advice", "none: no setting that was tried is sound" + what);
    return;
  }
  const Row& row = result.sweep.rows[*best];
  all.emplace_back("advice", fmt::format("{}: the cheapest that is sound{}, {:.3g} ms for a second{}", row.label, what,
                                         row.ms.median, times_own(result, *best)));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> findings(const AccuracyResult& result) {
  Findings all;
  if (judge(result) == nullptr) return all;
  if (is_shortened(result))
    all.emplace_back("shortened",
                     fmt::format("{:.3g} s of {:.3g} s are simulated, and the scene's checks not asked: the "
                                 "budget allows no more; --budget, or --steps",
                                 result.sweep.seconds, result.sweep.seconds_of_scene));
  add_reference(result, all);
  add_orders(result, all);
  add_costs(result, all);
  add_advice(result, all);
  return all;
}

}  // namespace boxstream::tool
