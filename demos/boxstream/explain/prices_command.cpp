// SPDX-License-Identifier: MIT
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "boxstream/explain/price_list.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "formats/scene_json/json_text.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::tool {
namespace {

struct PricesOptions {
  bool quick = false;  // takes seconds, too short to be accurate
  std::string json;    // empty: none; "-": standard output, in place of the table
  std::string into;    // empty: none; a page with two marks
};

constexpr PriceEffort thorough{256, 240, 9}, quick{16, 40, 3};
constexpr PriceEffort for_counts{64, 240, 1};  // which have no noise, and take fifty times as long

constexpr const char* begin_mark = "<!-- prices: begin -->\n";
constexpr const char* end_mark = "<!-- prices: end -->\n";

std::string number(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_not_of("-0.") == std::string::npos ? "0" : text;
}

std::string machine_text() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("{}, {}, Bullet {}, {:%Y-%m-%d}", cpu_name(), compiler_name(), bullet_version(), fmt::gmtime(now));
}

using nlohmann::json;

double rounded(double value) {
  return std::round(value * 10) / 10;
}

/// What was measured of one effect, over what `entry` had of it.
void note(json& entry, const Price& price, bool counts) {
  const auto add = [&](const std::string& prefix, const std::optional<Difference>& d) {
    if (!d) return;
    if (counts) {
      entry[prefix + "instructions_per_body_step"] = rounded(d->instructions);
      return;
    }
    entry[prefix + "ns_per_body_step"] = rounded(d->ns);
    entry[prefix + "interval_ns"] = {rounded(d->low), rounded(d->high)};
  };
  add("", price.called);
  add("uncalled_", price.uncalled);
  if (counts) return;
  entry.update({{"bytes_per_body", std::round(price.called->bytes)},
                {"pairs_per_body", std::round(price.called->pairs * 100) / 100},
                {"bodies", price.bodies},
                {"against", price.with == price.without ? "without it" : price.without}});
}

/// `record` with what was measured now: times and memory, or instructions.
json updated(json record, const std::vector<Price>& prices, bool counts) {
  record[counts ? "counted" : "machine"] = machine_text();
  for (const Price& price : prices)
    if (price.called) note(record["effects"][price.effect], price, counts);
  return record;
}

/// Nanoseconds, and the instructions beside them.
std::pair<std::string, std::string> cells(const json& entry, const std::string& prefix) {
  std::pair<std::string, std::string> out{"-", "-"};
  if (const auto ns = entry.find(prefix + "ns_per_body_step"); ns != entry.end()) {
    const double low = entry[prefix + "interval_ns"][0], high = entry[prefix + "interval_ns"][1];
    const std::string interval = fmt::format("{} to {}", number(low, 1), number(high, 1));
    const bool is_clear = low > 0 || high < 0;
    out.first = is_clear ? fmt::format("{} ({})", number(*ns, 1), interval) : "within noise: " + interval;
  }
  if (const auto count = entry.find(prefix + "instructions_per_body_step"); count != entry.end())
    out.second = number(*count, 1);
  return out;
}

/// Rows with a separator in them, for a terminal or for Markdown.
std::string table(const json& record, const char* row) {
  std::string text;
  for (const effects::Effect* const effect : effects::all_effects()) {
    const json entry = record.at("effects").value(effect->name, json::object());
    const auto [ns, instructions] = cells(entry, "");
    const auto [uncalled_ns, uncalled_instructions] = cells(entry, "uncalled_");
    const auto text_of = [&](const char* key, int digits) {
      return entry.contains(key) ? number(entry[key], digits) : "-";
    };
    text += fmt::format(fmt::runtime(row), effect->name, ns, instructions, uncalled_ns, uncalled_instructions,
                        text_of("bytes_per_body", 0), text_of("pairs_per_body", 2), entry.value("against", "-"));
  }
  return text;
}

std::string text_table(const json& record) {
  constexpr const char* row = "{:<21} {:>31} {:>9} {:>31} {:>9} {:>7} {:>6}   {}\n";
  return fmt::format(fmt::runtime(row), "effect", "ns", "instr", "uncalled", "instr", "bytes", "pairs", "against") +
         table(record, row);
}

std::string markdown(const json& record) {
  std::string head;
  if (record.contains("machine")) head += fmt::format("Measured on {}.\n", record["machine"].get<std::string>());
  if (record.contains("counted"))
    head += fmt::format("Instructions counted on {}.\n", record["counted"].get<std::string>());
  return head +
         "\n| Effect | ns | instructions | ns, uncalled | instructions, uncalled | bytes | pairs | against |\n"
         "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n" +
         table(record, "| {} | {} | {} | {} | {} | {} | {} | {} |\n");
}

/// What the file had before this run: a run that counts keeps times, and the other way round.
json read_record(const std::string& path) {
  if (path.empty() || !std::filesystem::is_regular_file(path)) return {{"format", 1}};
  json record = scenes::parse_json(scenes::read_text_file(path), path);
  if (!record.is_object() || !record.value("effects", json()).is_object())
    throw BadInput(fmt::format("{}: no list of prices, and not replaced by one", path));
  return record;
}

/// The text of a page with what is between its marks taken out, in two parts.
struct Page {
  std::string before, after;
};

Page read_page(const std::string& path) {
  const std::string text = scenes::read_text_file(path);
  const std::size_t begin = text.find(begin_mark), end = text.find(end_mark);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw BadInput(fmt::format("{}: no lines \"<!-- prices: begin -->\" and \"<!-- prices: end -->\"", path));
  return {text.substr(0, begin) + begin_mark, text.substr(end)};
}

int run_prices(const PricesOptions& options) {
  std::optional<Page> page;
  if (!options.into.empty()) page = read_page(options.into);
  json record = read_record(options.json);
  OutputFiles files;
  std::ostream* const json_file = files.add(options.json, files::Input::may_change);
  std::ostream* const page_file = files.add(options.into, files::Input::may_change);

  const bool counts = !std::isnan(measure::counted_instructions());
  StatusLine status;
  const std::vector<Price> prices = measure_prices(options.quick ? quick : counts ? for_counts : thorough, status);
  status.clear();
  record = updated(std::move(record), prices, counts);
  if (json_file != nullptr) *json_file << json_dump(record, 2) << "\n";
  if (page_file != nullptr) *page_file << page->before + markdown(record) + page->after;
  files.commit();
  if (options.json != "-") print(text_table(record));
  return 0;
}

Action set_up_prices(CommandLine& command) {
  const auto options = std::make_shared<PricesOptions>();
  command.add_flag("--quick", options->quick, "A first estimate, in seconds");
  add_json(command, options->json, "Write them for explain to show");
  add_file(command, "--into", options->into, "Write the table into a Markdown page, between its marks");
  return [options] { return run_prices(*options); };
}

}  // namespace

extern const Command prices_command{"prices", "Measure what each effect costs, and what if uncalled",
                                    R"(Examples:
  boxstream prices --quick
  boxstream prices --json demos/simulation/effects/prices.json --into docs/effects.md

For each effect two worlds take turns, step by step: the scene that calls for it (boxstream simulate effects/NAME), many
times side by side, with it and without it. Then a scene that does not call for it, with it built all the same and
without. What is shown is the median difference, for each body that is not fixed, and between which values the rounds
lie; where they do not agree on a sign, the price is within noise. Needs a machine that is otherwise idle.

Under callgrind (./dev prices) instructions are counted instead, on any machine. What FILE of --json has of the other
kind is kept, so that it holds both.)",
                                    set_up_prices};

}  // namespace boxstream::tool
