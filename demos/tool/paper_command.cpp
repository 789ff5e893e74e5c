// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <filesystem>

#include "bad_input.hpp"
#include "commands.hpp"
#include "files/output_file.hpp"
#include "machine.hpp"
#include "papers/experiments/experiment.hpp"
#include "print.hpp"
#include "status_line.hpp"

namespace boxstream::tool {
namespace {

namespace fs = std::filesystem;
using papers::Experiment;
using papers::Outcome;
using papers::Table;

constexpr std::size_t most_rows_shown = 200;

/// `noun`: what the user was to name.
std::vector<Experiment> chosen(Span<const Experiment> from, const std::vector<std::string>& names, const char* noun) {
  std::string known;
  for (const Experiment& e : from) known += fmt::format("{}{}", known.empty() ? "" : ", ", e.name);
  for (const std::string& name : names)
    if (std::none_of(from.begin(), from.end(), [&](const Experiment& e) { return e.name == name; }))
      throw BadInput(fmt::format("no {} '{}'; there are {}", noun, name, known));
  std::vector<Experiment> all;
  for (const Experiment& e : from)
    if (names.empty() || std::find(names.begin(), names.end(), e.name) != names.end()) all.push_back(e);
  return all;
}

void make_directory(const std::string& directory) {
  if (directory.empty()) return;
  if (directory == "-") throw BadInput("-: these are files in a directory, not for standard output");
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw BadInput(fmt::format("{}: cannot be made: {}", directory, error.message()));
}

/// "figure-6", "table1", and with the prefix "thick-", "thick-sort".
std::string file_name(std::string_view prefix, std::string_view experiment) {
  const bool number = experiment[0] >= '0' && experiment[0] <= '9';
  return fmt::format("{}{}{}", prefix, number ? "figure-" : "", experiment);
}

/// Fields of the experiments may have commas in them, but no quotes.
std::string csv(const Table& table) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const bool plain = fields[i].find(',') == std::string::npos;
      text += (i == 0 ? "" : ",") + (plain ? fields[i] : '"' + fields[i] + '"');
    }
    text += '\n';
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

void save_csv(const Table& table, const std::string& path) {
  files::write_file(path, csv(table));
}

void save_pictures(const Outcome& outcome, const std::string& stem) {
  const std::string small_print = fmt::format("{}, {}, {}, one thread, boxstream {}", cpu_name(), compiler_name(),
                                              simd_target(), boxstream_version());
  int count = 0;
  const auto save = [&](auto drawing, const auto& write) {
    ++count;
    files::OutputFile output(count == 1 ? stem + ".svg" : fmt::format("{}-{}.svg", stem, count));
    drawing.small_print = small_print;
    write(drawing, output.stream(), picture::PictureFormat::svg);
    output.commit();
  };
  for (const picture::Plot& plot : outcome.plots)
    save(plot, [](const auto& p, std::ostream& out, auto format) { picture::write_plot(p, out, format); });
  for (const picture::TreeDrawing& tree : outcome.trees) save(tree, picture::write_tree);
}

std::string shown(const Table& table) {
  if (table.rows.size() > most_rows_shown)
    return fmt::format("{} rows: too many to show; --csv writes them\n", table.rows.size());
  std::string text;
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  const auto line = [&](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += i == 0 ? fmt::format("{:<{}}", fields[i], widths[i]) : fmt::format("  {:>{}}", fields[i], widths[i]);
    text += "\n";
  };
  line(table.columns);
  for (const auto& row : table.rows) line(row);
  return text;
}

/// `noun`: what an experiment is called. Files of the experiments are named with `prefix` in front.
int run_experiments(Span<const Experiment> all, const char* noun, std::string_view prefix,
                    const PaperOptions& options) {
  const std::vector<Experiment> experiments = chosen(all, options.figures, noun);
  make_directory(options.csv);
  make_directory(options.svg);
  StatusLine status;
  papers::Settings settings;
  settings.quick = options.quick;
  settings.repeats = options.repeats;
  settings.seed = options.seed;
  for (const Experiment& experiment : experiments) {
    settings.progress = [&](const std::string& text) { status.say(fmt::format("{}: {}", experiment.name, text)); };
    const Outcome outcome = experiment.run(settings);
    status.clear();
    const std::string name = file_name(prefix, experiment.name);
    std::string text = fmt::format("{}: {}\n", name, experiment.title) + shown(outcome.table);
    for (const std::string& finding : outcome.findings) text += fmt::format("  {}\n", finding);
    print(text + "\n");
    if (!options.csv.empty()) save_csv(outcome.table, (fs::path(options.csv) / (name + ".csv")).string());
    if (!options.svg.empty()) save_pictures(outcome, (fs::path(options.svg) / name).string());
  }
  return 0;
}

}  // namespace

int paper_hybrid_command(const PaperOptions& options) {
  return run_experiments(papers::experiments(), "figure", "", options);
}

int paper_structures_command(const PaperOptions& options) {
  return run_experiments(papers::structure_experiments(), "work", "structures-", options);
}

int paper_thick_command(const PaperOptions& options) {
  return run_experiments(papers::thick_experiments(), "figure", "thick-", options);
}

}  // namespace boxstream::tool
