// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <boxstream/span.hpp>

#include "papers/hybrid/dimension_order.hpp"
#include "pictures/drawing/plot.hpp"
#include "pictures/drawing/tree_drawing.hpp"

/// The figures and tables of "Fast software for box intersections" and the comparisons of "Reporting intersections
/// among thick objects", measured here and now, each beside what the engine takes for the same input.
namespace boxstream::papers {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

struct Outcome {
  Table table{};
  std::vector<picture::Plot> plots{};
  std::vector<std::string> findings{};  ///< one line each
  std::vector<picture::TreeDrawing> trees{};
};

struct Settings {
  bool quick = false;  ///< few and small sets, in seconds: shows that it works, not how fast
  int repeats = 3;     ///< of each run; the median counts
  std::uint64_t seed = 1;
  DimensionOrder order{};  ///< of Version Three, and of Version One in figure 10
  bool restart = false;    ///< in another dimension, where the first tree does not divide the intervals
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

/// `run` throws std::runtime_error when two contestants do not find the same pairs.
struct Experiment {
  std::string_view name;  ///< as the user gives it: "6", "table1"
  std::string_view title;
  Outcome (*run)(const Settings& settings);
};

/// In the order of the paper.
Span<const Experiment> experiments();

/// Those of `boxstream paper structures`, one for each kind of work (see structures.hpp).
Span<const Experiment> structure_experiments();
/// Those of `boxstream paper thick`.
Span<const Experiment> thick_experiments();

Outcome figure_6(const Settings& settings);
Outcome figure_7(const Settings& settings);
Outcome figure_8(const Settings& settings);
Outcome figure_9(const Settings& settings);
Outcome figure_10(const Settings& settings);
Outcome figure_13(const Settings& settings);
Outcome figure_14(const Settings& settings);
Outcome figure_15(const Settings& settings);
Outcome figure_18(const Settings& settings);
Outcome figure_20(const Settings& settings);
Outcome figure_21(const Settings& settings);
Outcome figure_22(const Settings& settings);
Outcome figure_23(const Settings& settings);
Outcome trees_in_memory(const Settings& settings);
Outcome table_1(const Settings& settings);
Outcome other_batches(const Settings& settings);
Outcome dimension_orders(const Settings& settings);
Outcome table_2(const Settings& settings);
Outcome table_3(const Settings& settings);
Outcome median_heights(const Settings& settings);

Outcome volumes_at_work(const Settings& settings);
Outcome volumes_kept(const Settings& settings);
Outcome volumes_tight(const Settings& settings);

}  // namespace boxstream::papers
