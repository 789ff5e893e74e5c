// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/printable.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Row;

std::string error_text(const AccuracyResult& result, std::size_t row) {
  const std::size_t m = place_of_judge(result);
  const accuracy::ErrorInterval error = accuracy::error_interval(result.request, result.sweep, row, m);
  if (std::isnan(error.value)) return "-";
  const double band = result.sweep.rows[row].bands.empty() ? NAN : result.sweep.rows[row].bands[m];
  if (!std::isfinite(band)) return fmt::format("{:.3g}", error.value);
  return error.value <= band ? fmt::format("< {:.2g}", band) : fmt::format("{:.3g} ± {:.1g}", error.value, band);
}

}  // namespace

std::string accuracy_table(const AccuracyResult& result) {
  std::size_t width = 8;
  for (const Row& row : result.sweep.rows) width = std::max(width, row.label.size());
  std::string out = fmt::format("scene    {}: {}\n         {}\n\n  {:<{}}  {:>9}  {:>17}",
                                files::printable(result.sweep.scene.name), files::printable(result.sweep.scene.about),
                                run_text(result), "setting", width, "ms per s", "95 % interval");
  const std::vector<std::size_t> columns = applicable(result);
  for (const std::size_t m : columns) out += fmt::format("  {:>14}", result.request.measures[m].name);
  const bool with_error = judge(result) != nullptr && has_own_error(result, place_of_judge(result));
  if (with_error) out += fmt::format("  {:>18}", "off by");
  out += "\n";
  const auto to = std::back_inserter(out);
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    fmt::format_to(to, "{} {:<{}}  {:>9.4g}  {:>17}",
                   !row.may_be_advised() ? '!'
                   : on_front(result, i) ? '*'
                                         : ' ',
                   row.label, width, row.ms.median, fmt::format("{:.4g} - {:.4g}", row.ms.low, row.ms.high));
    for (const std::size_t m : columns) {
      const double value = row.series[m].of(result.request.measures[m]);
      fmt::format_to(to, "  {:>14}", std::isnan(value) ? "-" : fmt::format("{:.4g}", value));
    }
    if (with_error) fmt::format_to(to, "  {:>18}", error_text(result, i));
    if (!row.failure.empty())
      out += fmt::format("  failed: {}", files::printable(row.failure));
    else if (!row.unsound.empty())
      out += fmt::format("  {}", files::printable(row.unsound));
    out += "\n";
  }
  out += "\n";
  if (const accuracy::Measure* const measure = judge(result)) {
    fmt::format_to(to,
                   "* no other sound setting is better in both time and {}; ! not sound, whatever its numbers; values "
                   "are the worst of all steps unless the name says otherwise\n",
                   measure->name);
    for (const auto& [word, text] : findings(result)) fmt::format_to(to, "{:<10} {}\n", word, files::printable(text));
  }
  if (result.sweep.all_settings > result.sweep.rows.size())
    fmt::format_to(to, "{} of {} settings were tried\n", result.sweep.rows.size(), result.sweep.all_settings);
  if (result.sweep.stopped) out += "stopped before all was measured\n";
  if (result.sweep.turns == 0)
    out += "times are those of the runs that were measured: there was no time left to time settings by turns\n";
  for (const auto& [name, text] : notes(result)) fmt::format_to(to, "{} {}\n", name, text);
  if (result.sweep.control_spread > 0.03)
    out += "the machine was busy: differences below that of the two controls are not significant\n";
  return out;
}

}  // namespace boxstream::tool
