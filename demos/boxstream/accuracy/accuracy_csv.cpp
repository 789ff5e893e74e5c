// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_csv.hpp"

#include <fmt/format.h>

#include <cmath>

namespace boxstream::tool {
namespace {

using accuracy::Row;
using accuracy::Series;

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// As a field of CSV.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

}  // namespace

std::string accuracy_csv(const AccuracyResult& result) {
  std::string out;
  for (const accuracy::Knob& knob : result.request.knobs) out += knob.name + ",";
  out += "steps,ms_per_s,ms_per_s_low,ms_per_s_high";
  for (const accuracy::Measure& measure : result.request.measures)
    for (const char* part : {"worst", "p95", "mean", "last", "integral"})
      out += fmt::format(",{}_{}", measure.name, part);
  out += ",error,band,front,failure,unsound\n";
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    for (const nlohmann::json& value : row.setting) out += text_of(value) + ",";
    out += fmt::format("{},{},{},{}", row.steps, row.ms.median, row.ms.low, row.ms.high);
    for (const Series& s : row.series)
      out += fmt::format(",{},{},{},{},{}", s.worst, s.p95, s.mean, s.last, s.integral);
    const bool judged = judge(result) != nullptr && !row.series.empty();
    out += fmt::format(",{},{},{},{},{}\n",
                       judged ? accuracy::error_of(result.request, result.sweep, row, place_of_judge(result)) : NAN,
                       judged && !row.bands.empty() ? row.bands[place_of_judge(result)] : NAN,
                       on_front(result, i) ? 1 : 0, quoted(row.failure), quoted(row.unsound));
  }
  return out;
}

}  // namespace boxstream::tool
