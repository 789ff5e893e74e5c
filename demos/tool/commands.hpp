// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace boxstream::tool {

// Each command prints its result on standard output and returns the exit code. They throw BadInput and
// scenes::SceneError for what the user got wrong, and anything else for what went wrong underneath.

struct SimulateOptions {
  std::string scene;
  std::optional<std::string> broadphase;  // none: as the scene says
  std::optional<std::string> compare;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  std::string json;                 // empty: none; "-": standard output, in place of the table
  std::string picture;              // empty: none
  std::string log;                  // empty: none
  std::vector<std::string> record;  // by extension
  std::string csv;                  // empty: none
  std::string view;                 // empty: none
  std::string trace;                // empty: none
  std::uint64_t record_every = 0;   // 0: as the size of the file allows
  std::uint64_t view_every = 0;     // 0: as the size of the file allows
  bool all_effects = false;         // also what the scene does not call for
  bool only_called = false;         // says the default aloud
  bool outputs_anywhere = false;    // the scene may name outputs outside of the current folder
};
int simulate_command(const SimulateOptions& options);

struct ExplainOptions {
  std::string scene;
  double scale = 1;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  std::string json;                    // empty: none; "-": standard output, in place of the table
};
/// Says which effects a scene calls for, and why.
int explain_command(const ExplainOptions& options);

struct AccuracyOptions {
  std::string scene;
  std::vector<std::string> knobs;    // "NAME=VALUE,VALUE..."
  std::vector<std::string> metrics;  // empty: penetration and energy_drift
  std::string broadphase = "boxstream";
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  int repeats = 9;
  std::string csv, plot;  // empty: none
  std::string json;       // empty: none; "-": standard output, in place of the table
};
/// Runs a scene with its knobs turned, and says what each setting costs and how far off it is.
int accuracy_command(const AccuracyOptions& options);

struct QueryOptions {
  std::string scene;
  std::string manager;  // empty: boxstream
  std::optional<std::string> compare;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  std::string json;     // empty: none; "-": standard output, in place of the table
  std::string picture;  // empty: none
};
int query_command(const QueryOptions& options);

struct ListOptions {
  bool details = false;  // sizes, tags and source, too
};
struct ImportOptions {
  std::string file;
  std::string output;             // "-": standard output
  std::optional<std::string> up;  // "y" or "z"; none: as is usual for the kind of file
  std::optional<double> floor;    // a ground plane at this height; none: no ground
  bool fixed_base = false;
  bool hold = false;
  bool keep_still = false;
  std::optional<double> density;
  std::optional<int> hulls;  // most convex parts of a mesh; none: as is usual
  double error = 0.05;
};
/// Writes a scene of what a file of another program holds.
int import_command(const ImportOptions& options);

struct PricesOptions {
  bool quick = false;  // a look that takes seconds, too short to believe
  std::string json;    // empty: none; "-": standard output, in place of the table
  std::string into;    // empty: none; a page with two marks
};
/// Measures what each effect costs.
int prices_command(const PricesOptions& options);

/// Scenes by name.
int list_command(const ListOptions& options);

struct ReplayOptions {
  std::string file;  // "-": standard input
  std::string broadphase = "boxstream";
  std::optional<std::string> compare;
  std::string json;      // empty: none; "-": standard output, in place of the text
  bool partial = false;  // a file that is cut off is taken for what is there
  bool dump = false;     // print the calls, and replay nothing
};
int replay_command(const ReplayOptions& options);

struct AabbsOptions {
  std::string file;                  // "-": standard input
  std::string broadphase = "world";  // boxstream's World, or one of those of `simulate`
  std::optional<std::string> compare;
  std::string json;  // empty: none; "-": standard output, in place of the text
};
int aabbs_command(const AabbsOptions& options);

struct PairsOptions {
  std::string file;  // "-": standard input
  bool list = false;
  // Of the narrow phase, for shapes.
  double tolerance = 1e-6;
  int iterations = 500;
  std::string solver = "auto";  // or "gjk", "mpr"
};
int pairs_command(const PairsOptions& options);

struct NearOptions {
  std::string file;                   // "-": standard input; empty: traffic
  std::string traffic;                // "air", "sea"; empty: a file
  std::size_t count = 2000;           // of traffic
  std::uint64_t seed = 1;             // of traffic
  std::optional<double> radius;       // none: what traffic keeps
  std::optional<int> dimensions;      // none: as the columns of the file say
  std::string engine = "production";  // or "thick"
  bool list = false;
  std::string csv, picture, save;  // empty: none
  std::string json;                // empty: none; "-": standard output, in place of the count
};
int near_command(const NearOptions& options);

struct PaperOptions {
  std::vector<std::string> figures;  // empty: all
  std::string csv, svg;              // directories; empty: none
  bool quick = false;
  int repeats = 3;
  std::uint64_t seed = 1;
};
int paper_hybrid_command(const PaperOptions& options);
int paper_structures_command(const PaperOptions& options);
int paper_thick_command(const PaperOptions& options);

struct MeshCheckOptions {
  std::string file;
  bool list = false;
  std::string picture;  // empty: none
};
/// 1 if the surface meets itself.
int mesh_check_command(const MeshCheckOptions& options);

struct MeshDistanceOptions {
  std::string a, b;
  std::string picture, picture_back;  // of a, of b; empty: none
};
int mesh_distance_command(const MeshDistanceOptions& options);

struct MeshMakeOptions {
  std::string surface;  // "klein", "sphere", "torus"
  std::size_t n = 64;
  std::string output;
};
int mesh_make_command(const MeshMakeOptions& options);

}  // namespace boxstream::tool
