// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <boxstream/detector.hpp>
#include <filesystem>

#include "base/output_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "papers/experiments/experiment.hpp"

namespace boxstream::tool {
namespace {

struct PaperOptions {
  std::vector<std::string> figures;  // empty: all
  std::string csv, svg;              // directories; empty: none
  bool quick = false;
  int repeats = 3;
  std::uint64_t seed = 1;
  std::string order = "012";
  bool restart = false;
};

namespace fs = std::filesystem;
using papers::Experiment;
using papers::Outcome;
using papers::Table;

constexpr std::size_t most_rows_shown = 200;

/// Those of these names; all if there are none.
std::vector<Experiment> chosen(Span<const Experiment> from, const std::vector<std::string>& names) {
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
                                              simd_target(), measure::library_version());
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

/// "012": each of the three digits once.
papers::DimensionOrder order_of(const std::string& text) {
  std::string digits = text;
  std::sort(digits.begin(), digits.end());
  if (digits != "012") throw BadInput(fmt::format("--order {}: each of 0, 1 and 2 once, as in 102", text));
  return {{text[0] - '0', text[1] - '0', text[2] - '0'}};
}

/// Files of the experiments are named with `prefix` in front.
int run_experiments(Span<const Experiment> all, std::string_view prefix, const PaperOptions& options) {
  const std::vector<Experiment> experiments = chosen(all, options.figures);
  make_directory(options.csv);
  make_directory(options.svg);
  StatusLine status;
  papers::Settings settings;
  settings.quick = options.quick;
  settings.repeats = options.repeats;
  settings.seed = options.seed;
  settings.order = order_of(options.order);
  settings.restart = options.restart;
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

using OptionsOfPaper = std::shared_ptr<PaperOptions>;

std::vector<std::string> names_of(Span<const Experiment> experiments) {
  std::vector<std::string> names;
  for (const Experiment& e : experiments) names.emplace_back(e.name);
  return names;
}

/// `noun`: what an experiment is called.
OptionsOfPaper add_options(CommandLine& command, const std::string& noun, Span<const Experiment> experiments) {
  const auto options = std::make_shared<PaperOptions>();
  CLI::Option* const choice =
      command.add_option("--" + noun, options->figures, "Which ones, separated by commas: {}; default: all");
  take_words(command, choice->type_name("LIST")->delimiter(','), noun, names_of(experiments));
  command.add_flag("--quick", options->quick, "Small sets: seconds in place of minutes");
  command.add_option("--csv", options->csv, "Write a table each into this directory")->type_name("DIR");
  command.add_option("--svg", options->svg, "Write a plot each into this directory")->type_name("DIR");
  command.add_option("--repeats", options->repeats, "Runs to take the median of; default: 3")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command.add_option("--seed", options->seed, "Of the input; default: 1")->type_name("N");
  return options;
}

/// Dimension order and restart, for the versions of Hybrid.
void add_orders(CommandLine& command, const OptionsOfPaper& options) {
  command
      .add_option(
          "--order", options->order,
          "Dimensions scanned, of the second and of the first level of the tree; default: 012. For figures 7, 8, "
          "10, table1 and batches")
      ->type_name("DIGITS");
  command.add_flag("--restart", options->restart,
                   "There, restart in another dimension where the first tree does not divide the intervals");
}

Action running(Span<const Experiment> all, const char* prefix, const OptionsOfPaper& options) {
  return [=] { return run_experiments(all, prefix, *options); };
}

const Command hybrid{"hybrid", "\"Fast software for box intersections\": its figures and tables",
                     R"(Examples:
  boxstream paper hybrid --quick
  boxstream paper hybrid --figure 6,8,table1 --csv results --svg results

Measures what A. Zomorodian and H. Edelsbrunner, "Fast software for box intersections" (2002), show in figures and
tables, with their procedures as this project wrote them from the paper, and beside each what the engine takes for the
same boxes. Figures: 6 procedures; 7, 8 cutoffs; 9 trees; table1 skewed boxes; 10 a sphere; table2 memory of this
machine; 13, 14, 15 sorting; 18 Versions One and Two; 20, 21 cubes; 22 a surface that intersects itself; 23 the distance
of two surfaces; table3 bytes. Four more: trees, what they would hold if they were kept;
level, the height of the medians that all others start from; order, the dimensions in other orders and a restart in
another one; batches, boxes that the paper did not try.

Times are processor time of one thread, the median of --repeats, from the caller's boxes to the last pair. All
contestants must find the same pairs, or the run fails. Sizes are the paper's; all figures take some minutes.)",
                     [](CommandLine& command) {
                       const auto options = add_options(command, "figure", papers::experiments());
                       add_orders(command, options);
                       return running(papers::experiments(), "", options);
                     }};

const Command structures{"structures", "\"Geometric data structures for computer graphics\": those that find boxes",
                         R"(Examples:
  boxstream paper structures --quick
  boxstream paper structures --work boxes,rays --csv results --svg results

Measures the structures of G. Zachmann and E. Langetepe, "Geometric data structures for computer graphics" (2002), that
find touching boxes, as this project wrote them, side by side with the engine on boxes of several distributions, and says
which was fastest at what. Work: build; points in a box; boxes that touch a box; first box on one of many rays; updates,
of one box at a time; the longest insertion; pairs of two sets; frames, of boxes that move a little. Then bounding volume
hierarchies for themselves: the tightness of each kind of volume, volumes of each kind under each builder, and what a
slice of the recursion tree saves that is kept from frame to frame.

Times are processor time of one thread, medians of --repeats turns. All structures must give the same answers as the
engine, or the run fails. It takes some minutes.)",
                         [](CommandLine& command) {
                           return running(papers::structure_experiments(), "structures-",
                                          add_options(command, "work", papers::structure_experiments()));
                         }};

const Command thick{"thick", "\"Reporting intersections among thick objects\": its comparisons, and more of them",
                    R"(Examples:
  boxstream paper thick --quick
  boxstream paper thick --figure sort,radii --csv results --svg results

Measures what "Reporting intersections among thick objects" compares in its section 3, with its algorithm as this project
wrote it from the paper, and beside it what the engine takes for the same disks and balls (find_near_pairs). Figures:
sort, against quicksort of the same items; naive, against testing all pairs; pairs, over their number, and with reference
points anywhere in the disks; and what the paper has not: radii, within a factor; space, balls in three dimensions;
traffic, air and sea (boxstream near). A Delaunay triangulation is measured by boxstream_bench near, where CGAL is found.

Times are processor time of one thread, medians of --repeats turns. All contestants must find the same pairs, or the run
fails.)",
                    [](CommandLine& command) {
                      return running(papers::thick_experiments(), "thick-",
                                     add_options(command, "figure", papers::thick_experiments()));
                    }};

}  // namespace

extern const Command paper_command{
    "paper", "Repeat the experiments of the papers behind the engine", "", nullptr, {&hybrid, &structures, &thick}};

}  // namespace boxstream::tool
