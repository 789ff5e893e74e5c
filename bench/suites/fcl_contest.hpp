// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "suites/fcl_works.hpp"
#include "suites/predictor.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

/// Compares our manager with FCL's, work by work, and adds a row for each of these.
class FclContest {
 public:
  /// Everything is borrowed. The first of `kinds` is ours.
  FclContest(const Options& options, const std::vector<FclManagerKind>& kinds, Report& report, Progress& progress)
      : options_(options), kinds_(kinds), report_(report), progress_(progress) {}

  void run(const std::string& batch, const FclWork& work, std::size_t n);

 private:
  struct Runner {
    const FclManagerKind* kind;
    std::vector<FclWorker> workers;  // one a cast
    std::vector<double> ms;
    int calls = 1;  // a sample
    FclAnswer last, all;
    FclAnswer checked;
  };

  FclScene make_scene(std::size_t n) const;
  std::string key_of(const FclManagerKind& kind) const;
  double trial_ms(const FclManagerKind& kind, std::size_t n) const;
  double predict_ms(const FclManagerKind& kind);
  static double run_once(Runner& runner);
  void enter(const FclManagerKind& kind, FclScene& scene);
  void run_rounds(FclScene& scene);
  Row row_of(const std::string& peer) const;
  void report_rows();
  void show(const std::string& what);

  const Options& options_;
  const std::vector<FclManagerKind>& kinds_;
  Report& report_;
  Progress& progress_;
  Predictor predictor_;

  // Of the case that runs.
  std::string batch_;
  const FclWork* work_ = nullptr;
  std::size_t n_ = 0;
  std::vector<Runner> runners_;  // ours is the first
  std::vector<Row> skipped_;
};

}  // namespace boxstream::bench
