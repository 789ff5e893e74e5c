// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tables/measuring.hpp"
#include "tables/report.hpp"

namespace boxstream::bench {

struct Options {
  bool quick = false;
  std::vector<std::string> cases;  ///< empty: the suite's own choice
  std::vector<std::size_t> sizes;  ///< empty: the suite's own choice
  std::vector<std::string> peers;  ///< empty: the suite's own choice
  std::uint64_t seed = 1;
  int steps = 0;              ///< of each world in the bullet suite; 0: as the scene says, fewer with `quick`
  int frames = 60;            ///< of each case in the frames suite
  unsigned threads = 2;       ///< for ours and peers that use several
  double limit_seconds = 10;  ///< a peer predicted to take longer than this for one run is skipped
  Interleaving interleaving;

  bool wants_case(const std::string& name) const { return is_among(cases, name); }
  bool wants_peer(const std::string& name) const { return is_among(peers, name); }
  /// The cases to run: those asked for, or else one of the suite's own lists.
  std::vector<std::string> cases_or(std::vector<std::string> of_quick, std::vector<std::string> of_all) const {
    return !cases.empty() ? cases : quick ? of_quick : of_all;
  }
  /// The same of sizes, sorted: the times of smaller runs predict those of larger ones.
  std::vector<std::size_t> sizes_or(std::vector<std::size_t> of_quick, std::vector<std::size_t> of_all) const {
    std::vector<std::size_t> chosen = !sizes.empty() ? sizes : quick ? of_quick : of_all;
    std::sort(chosen.begin(), chosen.end());
    return chosen;
  }

 private:
  static bool is_among(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  }
};

/// What `--help` says of a case.
struct CaseText {
  std::string name, description;
};

/// Of a table whose entries have a name and a description.
template <class Table>
std::vector<CaseText> texts_of(const Table& table) {
  std::vector<CaseText> texts;
  for (const auto& each : table) texts.push_back({std::string(each.name), std::string(each.description)});
  return texts;
}

/// Detector::find_pairs against all peers.
void run_batch_suite(const Options& options, Report& report, Progress& progress);
bool is_batch(const std::string& name);

/// A World from frame to frame against peers that keep a structure, and some that do not. Cases are "U:brown".
void run_frames_suite(const Options& options, Report& report, Progress& progress);
/// The same of few boxes, where what an update costs without any is the most of it.
void run_small_suite(const Options& options, Report& report, Progress& progress);
bool is_frames_case(const std::string& name);

/// Our FCL manager against every manager of FCL: cases are a batch and a work, as "U:small".
/// Present only where FCL is (BOXSTREAM_BENCH_FCL).
void run_fcl_suite(const Options& options, Report& report, Progress& progress);
bool is_fcl_case(const std::string& name);
/// Without their batches.
std::vector<CaseText> fcl_case_texts();

/// Worlds like those of users of FCL, and of Bullet, against all broad-phases of these: cases are a user and a query,
/// as "moveit:collide". Each is present only where its engine is (BOXSTREAM_BENCH_FCL, BOXSTREAM_BENCH_BULLET).
void run_fcl_users(const Options& options, Report& report, Progress& progress);
std::vector<CaseText> fcl_user_texts();
void run_bullet_users(const Options& options, Report& report, Progress& progress);
std::vector<CaseText> bullet_user_texts();

/// Two batches, filters and double boxes: what Detector::find_pairs does beside one batch of floats.
void run_sets_suite(const Options& options, Report& report, Progress& progress);
std::vector<CaseText> sets_case_texts();

/// Many sets in one call, frame by frame, against as many calls and as many of Bullet's broad-phases.
void run_many_suite(const Options& options, Report& report, Progress& progress);
std::vector<CaseText> many_case_texts();

/// Surfaces of triangles: where one meets itself, and the distance of two. n is the number of triangles.
void run_mesh_suite(const Options& options, Report& report, Progress& progress);
std::vector<CaseText> mesh_case_texts();

/// Detector::find_pairs over n, on one and several threads, against all peers and the time that one sort takes.
void run_scaling_suite(const Options& options, Report& report, Progress& progress);

/// From the paper's program, as published, to Detector::find_pairs: one step more in each row. Present only where the
/// paper's programs are built (BOXSTREAM_BENCH_STEPS).
void run_steps_suite(const Options& options, Report& report, Progress& progress);

/// Detector::find_pairs as it plans against the best fixed plan that a search finds.
void run_tune_suite(const Options& options, Report& report, Progress& progress);

/// Whole worlds on Bullet: updateAabbs + calculateOverlappingPairs + dispatch of a step, and (case "NAME:step") all of
/// the step, on boxstream and on Bullet's own broad-phases, interleaved.
/// Present only where the scenes library is built (BOXSTREAM_BENCH_BULLET).
void run_bullet_suite(const Options& options, Report& report, Progress& progress);
bool is_scene(const std::string& name);

}  // namespace boxstream::bench
