// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "papers/experiments/experiment.hpp"

namespace boxstream::papers {

/// How the engine is called in tables and plots.
inline constexpr const char* engine_name = "boxstream";

/// One measurement, and so one line of a CSV file.
struct Row {
  std::string series;
  std::size_t n;
  double x;
  double value;
  std::uint64_t pairs;
};

/// Columns: series, n, `x_name`, `value_name`, pairs.
Table table_of(const std::vector<Row>& rows, const std::string& x_name, const std::string& value_name);

/// A line a series, in the order in which they first appear. The engine's is bold; those that begin with its name have
/// its colour.
picture::Plot plot_of(const std::vector<Row>& rows, const std::string& title, const std::string& x_label,
                      const std::string& unit);

/// A table with `x_name` and milliseconds, and one plot of it.
Outcome outcome_of(const std::vector<Row>& rows, const std::string& x_name, const std::string& title,
                   const std::string& x_label, std::vector<std::string> findings = {});

}  // namespace boxstream::papers
