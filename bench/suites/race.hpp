// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "suites/suites.hpp"

namespace boxstream::bench {

/// Other methods of doing what a case asks for, timed interleaved with ours; a row for each.
class Race {
 public:
  /// All but the row is borrowed.
  Race(const Options& options, Report& report, Progress& progress, Row common)
      : row(std::move(common)), options_(options), report_(report), progress_(progress) {}

  /// `equal` compares the result of the last run with ours. Of a family only the fastest method is shown, and all whose
  /// results differ.
  void add(const std::string& name, std::function<void()> run, std::function<bool()> equal,
           const std::string& family = "") {
    methods_.push_back({name, family.empty() ? name : family, std::move(run), std::move(equal), false, ""});
  }
  /// A method that does not compete: it does other work, or the same under other conditions. Without `equal` its result
  /// is not compared.
  void add_yardstick(const std::string& name, std::function<void()> run, std::function<bool()> equal = nullptr) {
    methods_.push_back({name, name, std::move(run), std::move(equal), true, ""});
  }
  void skip(const std::string& name, const std::string& why) {
    methods_.push_back({name, name, nullptr, nullptr, false, why});
  }

  /// Times `ours` and those of the methods that the options ask for.
  void run(const std::function<void()>& ours);

  Row row;           ///< what all rows have in common
  double units = 1;  ///< frames in a run, of which rows have the time of one

 private:
  struct Method {
    std::string name, family;
    std::function<void()> run;
    std::function<bool()> equal;
    bool yardstick;
    std::string skipped;
    std::optional<bool> is_equal{};
    Series series{};
  };
  bool is_best_of_family(const Method& method) const;

  const Options& options_;
  Report& report_;
  Progress& progress_;
  std::vector<Method> methods_;
};

}  // namespace boxstream::bench
