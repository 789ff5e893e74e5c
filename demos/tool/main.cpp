// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <boxstream/detector.hpp>
#include <exception>

#include "bad_input.hpp"
#include "commands.hpp"
#include "machine.hpp"
#include "scene/scene_error.hpp"

namespace {

namespace tool = boxstream::tool;

constexpr int exit_failure = 1;
constexpr int exit_bad_input = 2;

constexpr const char* simulate_help = R"(Examples:
  boxstream simulate pile
  boxstream simulate pile --compare dbvt --picture pile.png
  boxstream simulate my-scene.json --broadphase sap --steps 200 --json - | jq .worlds[0].summary
  boxstream simulate pile --view pile.html --record pile.glb --trace pile-trace.json

SCENE is a file, or the name of a scene that comes with the tool (boxstream list).
Broad-phases: boxstream; Bullet's own dbvt (btDbvtBroadphase), dbvt-deferred (the same, collecting pairs once a step),
sap (bt32BitAxisSweep3) and simple (btSimpleBroadphase: quadratic).

Times: "broad-phase" is updateAabbs + calculateOverlappingPairs, since some do their work in one and some in the other;
"dispatch" is dispatchAllCollisionPairs, which pays for false pairs.

--log records the world asked for, not the one it is compared with. Writing is part of its broad-phase times then.
--record and --view show that world too, outside the times; --trace has all worlds.

--compare steps two worlds side by side, one step each in turn. They drift apart after a while, because the order of
pairs is the order of contacts in the solver; so pair counts are given for both. "pairs equal: yes" means: in every step
and in both worlds, the other broad-phase, fed with exactly the same boxes, found the same set of overlapping pairs, and
so did an independent search. (Near misses that dbvt and sap hold beside them are sorted out by a test of the boxes.)

Exit code: 0; 1 if pairs differ or the run fails; 2 for bad input, with nothing written.)";

constexpr const char* import_help = R"(Examples:
  boxstream import robot.urdf -o robot.json --fixed-base --floor 0
  boxstream import world.bullet -o world.json
  boxstream import part.stl -o part.json --up z --hulls 32 --floor -1

FILE is a robot (.urdf), a world (.bullet) or a mesh (.obj, .stl, .ply, .gltf, .glb). A mesh becomes one body of convex
parts. What scenes have no word for is named on standard error, a line each. Scenes can also name such files themselves:
generators of type import, shapes with "file".

Exit code: 0; 2 for a file that cannot be read or carried over, with nothing written.)";

constexpr const char* mesh_help = R"(Examples:
  boxstream mesh make klein 200 --out klein.ply
  boxstream mesh check klein.ply --picture klein.png
  boxstream mesh distance original.stl simplified.stl --picture error.ply

Files are read as .obj, .stl, .ply, .gltf and .glb; vertices at the same place are one. They are written as .ply and
.glb, with a colour for each vertex, or .png.

check finds all pairs of triangles that intersect, exactly, touching and lying in one plane included. Triangles that
share a vertex or an edge count if they have more in common than that. Triangles without area are counted, and in no
pair. The picture has triangles that intersect in red.

distance is that of the vertices of each surface from the other surface. Between vertices it can be larger. Pictures go
from black, where the surfaces meet, over red and yellow to white, where they are farthest apart.

Exit code: 0; 1 if check finds a pair, or a run fails; 2 for bad input, with nothing written.)";

constexpr const char* prices_help = R"(Examples:
  boxstream prices --quick
  boxstream prices --json demos/effects/prices.json --into docs/effects.md

For each effect two worlds take turns, step by step: the scene that calls for it (boxstream simulate effects/NAME), many
times side by side, with it and without it. Then a scene that does not call for it, with it built all the same and
without. What is shown is the median difference, for each body that is not fixed. Wants a machine with nothing else to
do.)";

constexpr const char* explain_help = R"(Examples:
  boxstream explain wall
  boxstream explain my-scene.json --json - | jq '.effects[] | select(.on) | .effect'

An effect is something a world can do: gravity, friction, sweeping of fast bodies, sensors, wind ... A scene is simulated
with those that it calls for, and no others. For each that is on: the first element of the scene that calls for it (a JSON
pointer), and why. A scene can state what it expects: {"effects": {"require": [...], "forbid": [...]}}.
boxstream simulate --all-effects builds all of them, for comparison.)";

constexpr const char* accuracy_help = R"(Examples:
  boxstream accuracy pile --knob substeps=1,2,4,8 --metric penetration
  boxstream accuracy my-scene.json --knob dt=1/60,1/120,1/240 --knob iterations=5,10,20 --plot front.svg
  boxstream accuracy hard/chain_40 --knob iterations=10,20,40,80 --knob substeps=1,4 --metric trajectory

A knob is a key of the scene's blocks time and solver (cache_friction, contact_erp, dt, erp, friction_directions,
iterations, residual, slop, split_impulse, substeps, warmstart) or a JSON pointer to any other value
(/bodies/0/friction; "*" is every element: /bodies/*/ccd). Several knobs: all combinations.

Metrics are those of checks, "penetration", momentum_drift, angular_momentum_drift, energy_change (with its sign),
joint_error (m), joint_angle (degrees), mean_square_penetration (m^2), height_loss, tunnelled (share out of bounds),
collapse_time (s, until a tenth of the height is lost), stands, repeatable; and against a run with 64 substeps:
trajectory (m), orientation (degrees), agrees_for (s, until contacts differ), trajectory_until (that time). The worst of
all steps counts, unless .p95, .mean, .last or .integral (over time) stands behind the name.

Every setting simulates the same time: once to be measured, and --repeats times for the clock, settings taking turns. The
first setting has a twin that is timed like all others: what differs by less than the two do is not told apart. A star
marks settings that no other beats in both time and the first metric. A run that fails is shown as failed.)";

constexpr const char* query_help = R"(Examples:
  boxstream query query_arm
  boxstream query query_bins --compare tree
  boxstream query my-queries.json --manager tree --compare naive --steps 20 --json - | jq .managers[].queries

SCENE is a file, or the name of a scene that comes with the tool (boxstream list): groups of objects, each in a manager
of its own, that move along fixed courses, and queries after each step.
Managers: boxstream; FCL's own tree (DynamicAABBTreeCollisionManager), tree_array, ssap, sap, interval, hash and naive,
which holds every object against every other.

"broad" is the time of a query without what FCL's narrow phase takes in the callbacks, "narrow" is the latter. "update"
tells the managers what moved. Medians of the steps; "steps hit" are those with a pair that touches.

--compare asks two managers in turn, step by step, about the same objects. "answers equal: yes" means: in every step the
same pairs, contacts and distances, to the last bit. Pairs go to FCL's solvers in one fixed order, since (b, a) gives
other last digits than (a, b). Of FCL's managers sap, interval and hash are known to miss boxes that only touch.

Exit code: 0; 1 if answers differ or the run fails; 2 for bad input, with nothing written.)";

constexpr const char* replay_help = R"(Examples:
  boxstream simulate pile --log pile.bsrec
  boxstream replay pile.bsrec --broadphase dbvt --compare sap
  boxstream replay pile.bsrec --dump | less

Makes the calls that a world made to its broad-phase, without the world. After each batch (calculateOverlappingPairs)
these must be the same sets: the pairs of each broad-phase whose boxes overlap (some hold near misses beside them), those
of an independent search, and those that the recording has a hash of. Hits of box queries likewise, but for the
recording. The first batch where they differ is printed, and the first pair with its boxes.

A program that crashes while it records leaves a file that is cut off (of simulate: FILE.NUMBER.part), with all batches
up to then: replay it with --partial.

Times are those of all calls of a broad-phase: boxes, queries and batches.

Exit code: 0; 1 if something differs; 2 for bad input: a file that is no recording, or broken.)";

constexpr const char* aabbs_help = R"(Examples:
  boxstream simulate pile --record pile.aabbs
  boxstream aabbs pile.aabbs --compare dbvt
  boxstream aabbs Brownian.aabbs --broadphase dbvt --json - | jq .broadphases

Files of Broadmark: the boxes of the same objects, frame after frame. Each frame gives all boxes to the broad-phase and
asks for the pairs. Broad-phases: world, which is boxstream's own and the default, and those of simulate, as Bullet calls
them. No pair is filtered out, not even of two boxes that never move.

--compare asks two of them. "pairs equal: yes" means: in every frame the pairs whose boxes overlap are the same sets, and
those of an independent search. It stops at the first frame where they are not.

Times are from the first box of a frame to its last pair; the first frame makes the objects.

Exit code: 0; 1 if pairs differ; 2 for bad input: a file of another kind or size.)";

constexpr const char* pairs_help = R"(Examples:
  boxstream pairs boxes.txt
  boxstream pairs --list - < boxes.txt

One box a line: minx miny minz maxx maxy maxz, separated by blanks or commas; '#' starts a comment. Boxes are closed:
touching counts. --list prints the pairs in place of their number, one a line, as numbers of boxes counted from 0.

JSON in place of rows gives convex shapes, as scenes do:
  {"format": 1,
   "shapes": [{"name": "ball", "type": "sphere", "radius": 1}, {"name": "slab", "type": "box", "half_extents": [4, 1, 4]}],
   "bodies": [{"shape": "slab"}, {"shape": "ball", "position": [0, 1.9, 0], "rotation": {"axis": [0, 0, 1], "degrees": 30}}]}
Shapes: box, sphere, capsule, cylinder, cone, hull. Pairs of boxes around them go to the narrow phase on libccd. --list
prints one line for each of these pairs, with names where bodies have them, else numbers:
  A B touch depth D direction X Y Z by METHOD    B leaves A when it moves by D along the direction
  A B apart distance D
and, in brackets, inexact or iteration limit where no solver could prove its answer: a depth is then an upper bound.)";

constexpr const char* near_help = R"(Examples:
  boxstream near points.csv --radius 0.5
  boxstream near --radius 0 --dimensions 2 --csv overlaps.csv - < disks.csv
  boxstream near --traffic sea --count 3000 --picture sea.svg
  boxstream near --traffic air --radius 5 --save aircraft.csv --json - | jq .pairs

All pairs of points that are at most the radius apart; of disks and balls, all whose gap is at most the radius. "At most"
is exact for the numbers as they are read, to the last bit. One object a line: x y, x y z, or x y z radius, separated by
blanks or commas, all lines alike; with --dimensions 2, x y or x y radius. '#' starts a comment.

--csv and --json give each pair (numbers of objects counted from 0) with its gap, in order. --list prints the pairs in
place of their number.

--traffic makes up aircraft or ships in place of a file, in nautical miles: ships as disks, in lanes and at anchor, to
keep 0.5 apart; aircraft as points, to keep 5 apart, with heights stretched so that 1000 ft are 5 miles. The area grows
with --count. --save writes them for near to read (ships with --dimensions 2).

--engine production, the default, is the library's find_near_pairs; thick is the divide and conquer algorithm of
"Reporting intersections among thick objects" (boxstream paper thick). Both find the same pairs.)";

constexpr const char* paper_hybrid_help = R"(Examples:
  boxstream paper hybrid --quick
  boxstream paper hybrid --figure 6,8,table1 --csv results --svg results

Measures what A. Zomorodian and H. Edelsbrunner, "Fast software for box intersections" (2002), show in figures and
tables, with their procedures as this project wrote them from the paper, and beside each what the engine takes for the
same boxes. Figures: 6 procedures; 7, 8 cutoffs; 9 trees; table1 skewed boxes; 10 a sphere; 13, 14 sorting; 18 Versions
One and Two; 20, 21 cubes; table3 memory. Two more: level, the height of the medians that all others start from, and
batches, boxes that the paper did not try.

Times are processor time of one thread, the median of --repeats, from the caller's boxes to the last pair. All
contestants must find the same pairs, or the run fails. Sizes are the paper's; all figures take some minutes.)";

constexpr const char* paper_structures_help = R"(Examples:
  boxstream paper structures --quick
  boxstream paper structures --work boxes,rays --csv results --svg results

Measures the structures of G. Zachmann and E. Langetepe, "Geometric data structures for computer graphics" (2002), that
find touching boxes, as this project wrote them, side by side with the engine on boxes of several distributions, and says
which was fastest at what. Work: build; points in a box; boxes that touch a box; first box on one of many rays; updates,
of one box at a time; the longest insertion; pairs of two sets; frames, of boxes that move a little. Then bounding volume
hierarchies for themselves: the tightness of each kind of volume, volumes of each kind under each builder, and what a
slice of the recursion tree saves that is kept from frame to frame.

Times are processor time of one thread, medians of --repeats turns. All structures must give the same answers as the
engine, or the run fails. It takes some minutes.)";

constexpr const char* paper_thick_help = R"(Examples:
  boxstream paper thick --quick
  boxstream paper thick --figure sort,radii --csv results --svg results

Measures what "Reporting intersections among thick objects" compares in its section 3, with its algorithm as this project
wrote it from the paper, and beside it what the engine takes for the same disks and balls (find_near_pairs). Figures:
sort, against quicksort of the same items; naive, against testing all pairs; pairs, over their number, and with reference
points anywhere in the disks; and what the paper has not: radii, within a factor; space, balls in three dimensions;
traffic, air and sea (boxstream near). A Delaunay triangulation is measured by boxstream_bench near, where CGAL is found.

Times are processor time of one thread, medians of --repeats turns. All contestants must find the same pairs, or the run
fails.)";

std::string version_text() {
  return fmt::format("boxstream {} (Bullet {}, {}, {})", tool::boxstream_version(), tool::bullet_version(),
                     boxstream::simd_target(), tool::compiler_name());
}

void add_steps(CLI::App* app, std::optional<std::uint64_t>& steps, const char* text) {
  app->add_option("--steps", steps, text)->type_name("N")->check(CLI::Range(1, 10'000'000));
}

void add_scale(CLI::App* app, double& scale, const char* text) {
  app->add_option("--scale", scale, text)->type_name("FACTOR")->check(CLI::Range(1e-4, 1e4));
}

/// `choice`: the option that names experiments.
void add_paper_options(CLI::App* app, const char* choice, tool::PaperOptions& paper) {
  app->add_option(choice, paper.figures, "Which ones, separated by commas; default: all")
      ->type_name("LIST")
      ->delimiter(',');
  app->add_flag("--quick", paper.quick, "Small sets: seconds in place of minutes");
  app->add_option("--csv", paper.csv, "Write a table each into this directory")->type_name("DIR");
  app->add_option("--svg", paper.svg, "Write a plot each into this directory")->type_name("DIR");
  app->add_option("--repeats", paper.repeats, "Runs to take the median of; default: 3")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app->add_option("--seed", paper.seed, "Of the input; default: 1")->type_name("N");
}

int run(int argc, char** argv) {
  CLI::App app("Finds the pairs of axis-aligned boxes that touch, in physics scenes and in files.", "boxstream");
  app.set_version_flag("--version", version_text(), "Print versions and exit");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n  boxstream list\n  boxstream simulate pile --compare dbvt --picture pile.png\n"
      "  boxstream explain pile\n"
      "  boxstream accuracy pile --knob substeps=1,2,4,8 --metric penetration\n"
      "  boxstream simulate pile --log pile.bsrec\n  boxstream replay pile.bsrec --broadphase dbvt\n"
      "  boxstream query query_bins --compare tree\n  boxstream pairs boxes.txt\n\n\"boxstream COMMAND --help\" says "
      "more.");

  tool::SimulateOptions simulate;
  CLI::App* const simulate_app =
      app.add_subcommand("simulate", "Run a scene on Bullet, headless, and time its broad-phase");
  simulate_app->add_option("SCENE", simulate.scene, "Scene file or name")->required();
  simulate_app->add_option("--broadphase", simulate.broadphase, "boxstream, dbvt, dbvt-deferred, sap or simple")
      ->type_name("NAME");
  simulate_app->add_option("--compare", simulate.compare, "Run the same scene on this one beside it, and compare pairs")
      ->type_name("NAME");
  add_steps(simulate_app, simulate.steps, "Number of steps; default: as the scene says");
  simulate_app->add_option("--json", simulate.json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  simulate_app->add_option("--picture", simulate.picture, "Draw the result: FILE.png or FILE.svg")->type_name("FILE");
  add_scale(simulate_app, simulate.scale, "About this many times as many generated bodies; default: 1");
  simulate_app
      ->add_option("--record", simulate.record,
                   "Write FILE.glb, an animation (glTF 2.0), or FILE.aabbs, the boxes of all objects in each step")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  simulate_app->add_option("--csv", simulate.csv, "Write a table of each step: pairs, times, energy, penetration ...")
      ->type_name("FILE");
  simulate_app->add_option("--log", simulate.log, "Record the calls to the broad-phase, for replay")->type_name("FILE");
  simulate_app->add_option("--view", simulate.view, "Make a page that plays the run in a browser: FILE.html")
      ->type_name("FILE");
  simulate_app->add_option("--trace", simulate.trace, "Write the times for Perfetto or chrome://tracing: FILE.json")
      ->type_name("FILE");
  simulate_app
      ->add_option("--record-every", simulate.record_every,
                   "Keep every Nth step in animations; default: as many as fit in 1 GB")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000));
  simulate_app
      ->add_option("--view-every", simulate.view_every,
                   "Keep every Nth step in the page; default: as many as fit in 60 MB")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000));
  CLI::Option* const all_effects =
      simulate_app->add_flag("--all-effects", simulate.all_effects, "Build what the scene does not call for too");
  simulate_app
      ->add_flag("--only-called", simulate.only_called, "Build what the scene calls for and nothing else; the default")
      ->excludes(all_effects);
  // The last one counts, so that scripts can put their defaults first.
  for (const char* const name : {"--broadphase", "--compare", "--steps", "--scale", "--json", "--picture", "--log",
                                 "--csv", "--view", "--trace", "--record-every", "--view-every"})
    simulate_app->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  simulate_app->footer(simulate_help);

  tool::ExplainOptions explain;
  CLI::App* const explain_app = app.add_subcommand("explain", "Say which effects a scene calls for, and why");
  explain_app->add_option("SCENE", explain.scene, "Scene file or name")->required();
  add_steps(explain_app, explain.steps, "As for simulate: what would run is what is explained");
  add_scale(explain_app, explain.scale, "As for simulate");
  explain_app->add_option("--json", explain.json, "Write the plan; - is standard output")->type_name("FILE");
  explain_app->footer(explain_help);

  tool::AccuracyOptions accuracy;
  CLI::App* const accuracy_app = app.add_subcommand("accuracy", "Show what accuracy of a scene costs in time");
  accuracy_app->add_option("SCENE", accuracy.scene, "Scene file or name")->required();
  accuracy_app->add_option("--knob", accuracy.knobs, "A value of the scene, and what to set it to; may be repeated")
      ->type_name("NAME=VALUE,VALUE...")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  accuracy_app
      ->add_option("--metric", accuracy.metrics, "What to measure; may be repeated; default: penetration, energy_drift")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  accuracy_app->add_option("--broadphase", accuracy.broadphase, "As for simulate; default: boxstream")
      ->type_name("NAME");
  add_steps(accuracy_app, accuracy.steps, "Of the scene as it is; all settings simulate the same time");
  add_scale(accuracy_app, accuracy.scale, "As for simulate");
  accuracy_app->add_option("--repeats", accuracy.repeats, "Timed runs of each setting; default: 9")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  accuracy_app->add_option("--csv", accuracy.csv, "Write the table")->type_name("FILE");
  accuracy_app->add_option("--json", accuracy.json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  accuracy_app->add_option("--plot", accuracy.plot, "Draw time against the first metric: FILE.svg or FILE.png")
      ->type_name("FILE");
  accuracy_app->footer(accuracy_help);

  tool::ImportOptions import;
  CLI::App* const import_app = app.add_subcommand("import", "Make a scene of a robot, a world or a mesh");
  import_app->add_option("FILE", import.file, ".urdf, .bullet, .obj, .stl, .ply, .gltf or .glb")->required();
  import_app->add_option("-o,--output", import.output, "Scene to write; - is standard output")
      ->type_name("FILE")
      ->required();
  import_app->add_option("--up", import.up, "The file's upward axis; default: z for .urdf, else y")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"y", "z"}));
  import_app->add_option("--floor", import.floor, "Add a ground plane at this height")
      ->type_name("Y")
      ->check(CLI::Range(-1e5, 1e5));
  import_app->add_flag("--fixed-base", import.fixed_base, "URDF: the root link does not move");
  import_app->add_flag("--hold", import.hold,
                       "URDF: motors that keep joints where they are, as strong as their effort");
  import_app->add_flag("--static", import.keep_still, "Mesh: a static triangle mesh in place of convex parts");
  import_app->add_option("--density", import.density, "kg/m^3 of meshes (1000) and of links without a mass (an error)")
      ->type_name("D")
      ->check(CLI::Range(1e-6, 1e5));
  import_app->add_option("--hulls", import.hulls, "Cut meshes into at most so many convex parts; 16, for URDF 1")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  import_app->add_option("--error", import.error, "With --hulls: volume that is enough, as a fraction; default: 0.05")
      ->type_name("E")
      ->check(CLI::Range(0.0, 100.0));
  import_app->footer(import_help);

  CLI::App* const mesh_app = app.add_subcommand("mesh", "Surfaces: self-intersections, and the distance of two");
  mesh_app->require_subcommand(1);
  mesh_app->footer(mesh_help);
  tool::MeshCheckOptions mesh_check;
  CLI::App* const mesh_check_app = mesh_app->add_subcommand("check", "Find the triangles of a surface that intersect");
  mesh_check_app->add_option("FILE", mesh_check.file, "Mesh")->required();
  mesh_check_app->add_flag("--list", mesh_check.list, "Print all pairs, by numbers of triangles from 0 on");
  mesh_check_app->add_option("--picture", mesh_check.picture, "Write it with them in red: FILE.ply, .glb or .png")
      ->type_name("FILE");
  tool::MeshDistanceOptions mesh_distance;
  CLI::App* const mesh_distance_app = mesh_app->add_subcommand("distance", "Say how far two surfaces are apart");
  mesh_distance_app->add_option("A", mesh_distance.a, "Mesh")->required();
  mesh_distance_app->add_option("B", mesh_distance.b, "Mesh")->required();
  mesh_distance_app
      ->add_option("--picture", mesh_distance.picture, "Write A, coloured by distance from B: FILE.ply, .glb or .png")
      ->type_name("FILE");
  mesh_distance_app->add_option("--picture-back", mesh_distance.picture_back, "Write B, coloured by distance from A")
      ->type_name("FILE");
  tool::MeshMakeOptions mesh_make;
  CLI::App* const mesh_make_app = mesh_app->add_subcommand("make", "Make a closed surface of about n^2 triangles");
  mesh_make_app->add_option("SURFACE", mesh_make.surface, "klein, a bottle that goes through itself; sphere; torus")
      ->check(CLI::IsMember({"klein", "sphere", "torus"}))
      ->required();
  mesh_make_app->add_option("N", mesh_make.n, "Cells around; default: 64")->check(CLI::Range(8, 4000));
  mesh_make_app->add_option("-o,--out", mesh_make.output, "FILE.ply, .glb or .png")->type_name("FILE")->required();

  tool::PricesOptions prices;
  CLI::App* const prices_app = app.add_subcommand("prices", "Measure what each effect costs, and what if uncalled");
  prices_app->add_flag("--quick", prices.quick, "A first look, in seconds");
  prices_app->add_option("--json", prices.json, "Write them for explain to show; - is standard output")
      ->type_name("FILE");
  prices_app->add_option("--into", prices.into, "Write the table into a Markdown page, between its marks")
      ->type_name("FILE");
  prices_app->footer(prices_help);

  tool::QueryOptions query;
  CLI::App* const query_app =
      app.add_subcommand("query", "Run a scene of queries on FCL: collisions and distances between groups of objects");
  query_app->add_option("SCENE", query.scene, "Scene file or name")->required();
  query_app
      ->add_option("--manager", query.manager,
                   "boxstream, boxstream_tight, tree, tree_array, ssap, sap, interval, hash or naive")
      ->type_name("NAME");
  query_app->add_option("--compare", query.compare, "Ask this one too, in turn, and compare answers")
      ->type_name("NAME");
  add_steps(query_app, query.steps, "Number of steps; default: as the scene says");
  add_scale(query_app, query.scale, "Scattered objects and vehicles: this many times as many; default: 1");
  query_app->add_option("--json", query.json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  query_app->add_option("--picture", query.picture, "Draw the last step and the times: FILE.png or FILE.svg")
      ->type_name("FILE");
  for (const char* const name : {"--picture", "--manager", "--compare", "--steps", "--scale", "--json"})
    query_app->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  query_app->footer(query_help);

  tool::ReplayOptions replay;
  CLI::App* const replay_app =
      app.add_subcommand("replay", "Make recorded calls to a broad-phase, and find the first wrong pair");
  replay_app->add_option("FILE", replay.file, "Recording (simulate --log); - is standard input")->required();
  replay_app->add_option("--broadphase", replay.broadphase, "As for simulate; default: boxstream")->type_name("NAME");
  replay_app->add_option("--compare", replay.compare, "Replay on this one too")->type_name("NAME");
  replay_app->add_option("--json", replay.json, "Write the result; - is standard output")->type_name("FILE");
  replay_app->add_flag("--partial", replay.partial, "A file that is cut off: replay what is there");
  replay_app->add_flag("--dump", replay.dump, "Print the calls, one a line, and replay nothing");
  for (const char* const name : {"--broadphase", "--compare", "--json"})
    replay_app->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  replay_app->footer(replay_help);

  tool::ListOptions list;
  CLI::App* const list_app = app.add_subcommand("list", "Name the scenes that come with the tool");
  list_app->add_flag("--long", list.details, "What each has in it, too, its tags, and where its numbers are from");

  tool::AabbsOptions aabbs;
  CLI::App* const aabbs_app = app.add_subcommand("aabbs", "Find the pairs in each frame of a file of boxes");
  aabbs_app->add_option("FILE", aabbs.file, "Frames (simulate --record, or Broadmark); - is standard input")
      ->required();
  aabbs_app->add_option("--broadphase", aabbs.broadphase, "world, or as for simulate; default: world")
      ->type_name("NAME");
  aabbs_app->add_option("--compare", aabbs.compare, "Ask this one too, and compare pairs")->type_name("NAME");
  aabbs_app->add_option("--json", aabbs.json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  for (const char* const name : {"--broadphase", "--compare", "--json"})
    aabbs_app->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  aabbs_app->footer(aabbs_help);

  tool::PairsOptions pairs;
  CLI::App* const pairs_app = app.add_subcommand("pairs", "Find the pairs in a file of boxes or convex shapes");
  pairs_app->add_option("FILE", pairs.file, "Rows of boxes, or JSON of shapes; - is standard input")->required();
  pairs_app->add_flag("--list", pairs.list, "Print the pairs");
  pairs_app
      ->add_option("--tolerance", pairs.tolerance,
                   "Shapes: largest error of depths and distances, as a fraction of the smaller shape; default: 1e-6")
      ->type_name("T")
      ->check(CLI::Range(1e-15, 0.1));
  pairs_app->add_option("--iterations", pairs.iterations, "Shapes: most iterations of one solver; default: 500")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  pairs_app
      ->add_option("--solver", pairs.solver, "Shapes: libccd's gjk (with EPA) or mpr alone; default: auto, all of them")
      ->type_name("NAME")
      ->check(CLI::IsMember({"auto", "gjk", "mpr"}));
  pairs_app->footer(pairs_help);

  tool::NearOptions near;
  CLI::App* const near_app =
      app.add_subcommand("near", "Find all points, disks or balls within a distance of each other");
  near_app->add_option("FILE", near.file, "Rows of points or balls; - is standard input");
  near_app->add_option("--radius", near.radius, "The distance; of traffic, by default the usual one")->type_name("R");
  near_app->add_option("--dimensions", near.dimensions, "Of FILE; default: 2 for two columns, else 3")
      ->type_name("D")
      ->check(CLI::IsMember({2, 3}));
  CLI::Option* const traffic =
      near_app->add_option("--traffic", near.traffic, "Make up air or sea traffic in place of FILE")
          ->type_name("NAME")
          ->check(CLI::IsMember({"air", "sea"}));
  near_app->get_option("--dimensions")->excludes(traffic);
  near_app->add_option("--count", near.count, "Aircraft or ships; default: 2000")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000))
      ->needs(traffic);
  near_app->add_option("--seed", near.seed, "Of the traffic; default: 1")->type_name("N")->needs(traffic);
  near_app->add_option("--engine", near.engine, "production or thick; default: production")
      ->type_name("NAME")
      ->check(CLI::IsMember({"production", "thick"}));
  near_app->add_flag("--list", near.list, "Print the pairs");
  near_app->add_option("--csv", near.csv, "Write the pairs as a table")->type_name("FILE");
  near_app->add_option("--json", near.json, "Write the pairs and what was asked; - is standard output")
      ->type_name("FILE");
  near_app->add_option("--picture", near.picture, "Draw all objects and pairs from above: FILE.png or FILE.svg")
      ->type_name("FILE");
  near_app->add_option("--save", near.save, "Write the objects as a table")->type_name("FILE");
  near_app->footer(near_help);

  tool::PaperOptions paper;
  CLI::App* const paper_app = app.add_subcommand("paper", "Repeat the experiments of the papers behind the engine");
  paper_app->require_subcommand(1);
  CLI::App* const paper_hybrid_app =
      paper_app->add_subcommand("hybrid", "\"Fast software for box intersections\": its figures and tables");
  add_paper_options(paper_hybrid_app, "--figure", paper);
  paper_hybrid_app->footer(paper_hybrid_help);
  CLI::App* const paper_structures_app = paper_app->add_subcommand(
      "structures", "\"Geometric data structures for computer graphics\": those that find boxes");
  add_paper_options(paper_structures_app, "--work", paper);
  paper_structures_app->footer(paper_structures_help);
  CLI::App* const paper_thick_app = paper_app->add_subcommand(
      "thick", "\"Reporting intersections among thick objects\": its comparisons, and more of them");
  add_paper_options(paper_thick_app, "--figure", paper);
  paper_thick_app->footer(paper_thick_help);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    throw tool::BadInput(fmt::format("{} (see boxstream --help)", error.what()));
  }
  if (*simulate_app) return tool::simulate_command(simulate);
  if (*import_app) return tool::import_command(import);
  if (*mesh_check_app) return tool::mesh_check_command(mesh_check);
  if (*mesh_distance_app) return tool::mesh_distance_command(mesh_distance);
  if (*mesh_make_app) return tool::mesh_make_command(mesh_make);
  if (*prices_app) return tool::prices_command(prices);
  if (*explain_app) return tool::explain_command(explain);
  if (*accuracy_app) return tool::accuracy_command(accuracy);
  if (*query_app) return tool::query_command(query);
  if (*replay_app) return tool::replay_command(replay);
  if (*list_app) return tool::list_command(list);
  if (*aabbs_app) return tool::aabbs_command(aabbs);
  if (*near_app) return tool::near_command(near);
  if (*paper_hybrid_app) return tool::paper_hybrid_command(paper);
  if (*paper_structures_app) return tool::paper_structures_command(paper);
  if (*paper_thick_app) return tool::paper_thick_command(paper);
  return tool::pairs_command(pairs);
}

int complain(const char* reason, int code) {
  fmt::print(stderr, "boxstream: {}\n", reason);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const tool::BadInput& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const boxstream::scenes::SceneError& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failure);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failure);
  }
}
