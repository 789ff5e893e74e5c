// SPDX-License-Identifier: MIT
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <optional>

#include "boxstream/explain/price_list.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/json_dump.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/scene_json/json_text.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::tool {
namespace {

struct PricesOptions {
  bool quick = false;  // takes seconds, too short to be accurate
  std::string json;    // empty: none; "-": standard output, in place of the table
  std::string into;    // empty: none; a page with two marks
};

constexpr PriceEffort thorough{256, 240, 9}, quick{16, 40, 3};

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

/// Rows with a separator in them, for a terminal or for Markdown.
std::string table(const std::vector<Price>& prices, const char* row) {
  std::string text;
  for (const Price& p : prices) {
    const auto ns = [](const std::optional<Difference>& d) -> std::string {
      if (!d) return "-";
      const std::string interval = fmt::format("{} to {}", number(d->low, 1), number(d->high, 1));
      return d->is_clear() ? fmt::format("{} ({})", number(d->ns, 1), interval) : "within noise: " + interval;
    };
    text += fmt::format(fmt::runtime(row), p.effect, ns(p.called), ns(p.uncalled),
                        p.called ? number(p.called->bytes, 0) : "-", p.called ? number(p.called->pairs, 2) : "-",
                        !p.called             ? "-"
                        : p.with == p.without ? "without it"
                                              : p.without);
  }
  return text;
}

std::string text_table(const std::vector<Price>& prices) {
  constexpr const char* row = "{:<21} {:>31} {:>31} {:>7} {:>6}   {}\n";
  return fmt::format(fmt::runtime(row), "effect", "ns", "uncalled", "bytes", "pairs", "against") + table(prices, row);
}

std::string markdown(const std::vector<Price>& prices) {
  return fmt::format("Measured on {}.\n\n", machine_text()) +
         "| Effect | ns | ns, uncalled | bytes | pairs | against |\n"
         "| --- | ---: | ---: | ---: | ---: | --- |\n" +
         table(prices, "| {} | {} | {} | {} | {} | {} |\n");
}

std::string document(const std::vector<Price>& prices) {
  nlohmann::ordered_json effects = nlohmann::ordered_json::object();
  const auto round = [](double x, double unit) { return std::round(x / unit) * unit; };
  for (const Price& p : prices) {
    if (!p.called) continue;
    nlohmann::ordered_json& entry = effects[p.effect];
    entry = {{"ns_per_body_step", round(p.called->ns, 0.125)},
             {"interval_ns", {round(p.called->low, 0.125), round(p.called->high, 0.125)}},
             {"bytes_per_body", round(p.called->bytes, 1)},
             {"pairs_per_body", round(p.called->pairs, 0.0078125)},
             {"bodies", p.bodies}};
    if (p.uncalled) entry["uncalled_ns_per_body_step"] = round(p.uncalled->ns, 0.125);
  }
  const nlohmann::ordered_json all{{"format", 1}, {"machine", machine_text()}, {"effects", std::move(effects)}};
  return json_dump(all, 2) + "\n";
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
  OutputFiles files;
  std::ostream* const json_file = files.add(options.json);
  std::ostream* const page_file = files.add(options.into, files::Input::may_change);

  StatusLine status;
  const std::vector<Price> prices = measure_prices(options.quick ? quick : thorough, status);
  status.clear();
  if (json_file != nullptr) *json_file << document(prices);
  if (page_file != nullptr) *page_file << page->before + markdown(prices) + page->after;
  files.commit();
  if (options.json != "-") print(text_table(prices));
  return 0;
}

Action set_up_prices(CLI::App& command) {
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
lie; where they do not agree on a sign, the price is within noise. Needs a machine that is otherwise idle.)",
                                    set_up_prices};

}  // namespace boxstream::tool
