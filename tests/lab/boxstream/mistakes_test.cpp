// SPDX-License-Identifier: MIT
// Slips of the hand on the command line, and inputs that are not what they seem.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "process.hpp"
#include "refusal.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using nlohmann::json;

TEST(Mistakes, WordsThatAreNotKnownAreNamedWithTheNearest) {
  expect_refusal(run_tool({"simulat", "pile"}),
                 {"unknown command 'simulat'; did you mean 'simulate'?", "boxstream --help"});
  expect_refusal(run_tool({"mesh", "chekc", "a.obj"}),
                 {"unknown command 'chekc'; did you mean 'check'?", "boxstream mesh --help"});
  expect_refusal(run_tool({"quaternion"}), {"unknown command 'quaternion'; there are simulate, ", " (see"});
  expect_refusal(run_tool({"simulate", "pile", "--pictrue", "a.png"}),
                 {"unknown option '--pictrue'; did you mean '--picture'?", "boxstream simulate --help"});
  expect_refusal(run_tool({"simulate", "pile", "--pictrue=a.png"}), {"'--pictrue'; did you mean '--picture'?"});
  expect_refusal(run_tool({"simulate", "--stpes", "3"}), {"unknown option '--stpes'; did you mean '--steps'?"});
  expect_refusal(run_tool({"--steps", "3"}), {"unknown option '--steps'", "boxstream --help"});
  expect_refusal(run_tool({"try", "true", "--frames", "3"}),
                 {"unknown option '--frames'; the program and its options stand behind --", "boxstream try --help"});
  expect_refusal(run_tool({"paper", "hybrid", "--quik"}), {"did you mean '--quick'?", "boxstream paper hybrid --help"});
  expect_refusal(run_tool({"pairs", "a", "b"}), {"b: one argument too many", "boxstream pairs --help"});
}

TEST(Mistakes, WordsOfListsToo) {
  const std::pair<std::vector<std::string>, const char*> slips[] = {
      {{"simulate", "effects/wnid"}, "unknown scene 'effects/wnid'; did you mean 'effects/wind'?"},
      {{"simulate", "pile", "--broadphase", "dvbt"}, "unknown broad-phase 'dvbt'; did you mean 'dbvt'?"},
      {{"replay", "a.bsrec", "--compare", "spa"}, "unknown broad-phase 'spa'; did you mean 'sap'?"},
      {{"aabbs", "a.aabbs", "--broadphase", "wrold"}, "unknown broad-phase 'wrold'; did you mean 'world'?"},
      {{"accuracy", "wall", "--knob", "substep=1"}, "unknown knob 'substep'; did you mean 'substeps'?"},
      {{"accuracy", "wall", "--knob", "erp=1", "--metric", "penetraton"},
       "unknown metric 'penetraton'; did you mean 'pene"},
      {{"accuracy", "wall", "--knob", "erp=1", "--metric", "finite.maen"},
       "unknown statistic 'maen'; did you mean 'mean'?"},
      {{"pairs", "-", "--solver", "gkj"}, "unknown solver 'gkj'; did you mean 'gjk'?"},
      {{"near", "--traffic", "aer"}, "unknown traffic 'aer'; did you mean 'air'?"},
      {{"mesh", "make", "tourus", "-o", "a.ply"}, "unknown surface 'tourus'; did you mean 'torus'?"},
      {{"paper", "hybrid", "--figure", "6,tabel1"}, "unknown figure 'tabel1'; did you mean 'table1'?"},
      {{"paper", "thick", "--figure", "srot"}, "unknown figure 'srot'; did you mean 'sort'?"},
      {{"paper", "structures", "--work", "raise"}, "unknown work 'raise'; there are build, "}};
  for (const auto& [words, line] : slips) expect_refusal(run_tool(words), {line});
}

TEST(Mistakes, BudgetsAreTimes) {
  for (const char* command : {"accuracy", "explain"}) {
    for (const char* no_time : {"60m", "soon", "-5s", "60 s", "", "0x10", "nan"})
      expect_refusal(run_tool({command, "hard/free_fall", "--budget", no_time}),
                     {"--budget: no time: " + std::string(no_time) + " (60, 60s or 1.5min)"});
    expect_refusal(run_tool({command, "hard/free_fall", "--budget", "0.5s"}),
                   {"--budget: 0.5s is not between 1 and 100000 seconds"});
    expect_refusal(run_tool({command, "hard/free_fall", "--budget", "2000min"}), {"2000min is not between"});
  }
  for (const char* time : {"2", "2s", "0.05min"})
    EXPECT_EQ(run_tool({"explain", "hard/free_fall", "--budget", time}).exit_code, 0) << time;
  EXPECT_EQ(
      run_tool({"accuracy", "hard/free_fall", "--knob", "substeps=1", "--repeats", "1", "--budget", "60s"}).exit_code,
      0);
}

TEST(Mistakes, SoAreThoseOfSceneFiles) {
  const ScratchDirectory here;
  json scene{{"format", 1},
             {"meta", {{"name", "n"}, {"about", "a"}}},
             {"time", {{"dt", 0.01}}},
             {"world", {{"bounds", {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}}}}},
             {"effects", {{"require", {"gravty"}}}}};
  expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}),
                 {"/effects/require/0: unknown effect 'gravty'; did you mean 'gravity'?"});
  scene["tiem"] = 1;
  expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}),
                 {"/tiem: unknown key; did you mean 'time'? (known: "});
}

TEST(Mistakes, EverySubcommandPointsToItsOwnHelp) {
  for (const char* const command : {"simulate", "explain", "accuracy", "import", "prices", "query", "replay", "list",
                                    "aabbs", "pairs", "near", "mesh", "paper"})
    expect_refusal(run_tool({command, "--nonesuch"}),
                   {"--nonesuch", std::string("(see boxstream ") + command + " --help)"});
  expect_refusal(run_tool({"mesh", "distance", "a.obj"}), {"boxstream mesh distance --help"});
}

TEST(Mistakes, ScenesOfTheOtherKindNameTheirCommand) {
  const Outcome query = run_tool({"simulate", "query_bins"});
  expect_refusal(query, {"query_bins", "boxstream query query_bins"});
  EXPECT_EQ(query.err.find("pile"), std::string::npos) << query.err;
  for (const char* const command : {"explain"}) expect_refusal(run_tool({command, "query_arm"}), {"boxstream query"});
  expect_refusal(run_tool({"simulate", "plie"}), {"unknown scene 'plie'; did you mean 'pile'?"});
}

TEST(Mistakes, AHyphenIsStandardOutputForText) {
  const ScratchDirectory here;
  RunOptions options;
  options.directory = here.file(".");
  const Outcome table = run_tool({"simulate", "wall", "--steps", "2", "--csv", "-"}, options);
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_TRUE(table.out.starts_with("step,bodies,")) << table.out;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 3);
  options.input = "0 0 0\n1 0 0\n";
  EXPECT_EQ(run_tool({"near", "-", "--radius", "2", "--csv", "-"}, options).out, "a,b,gap\n0,1,1\n");
  EXPECT_EQ(run_tool({"near", "-", "--radius", "2", "--save", "-"}, options).out, "# x,y,z\n0,0,0\n1,0,0\n");
  const Outcome sweep =
      run_tool({"accuracy", "wall", "--steps", "2", "--repeats", "1", "--knob", "substeps=1", "--csv", "-"}, options);
  EXPECT_TRUE(sweep.out.starts_with("substeps,")) << sweep.out << sweep.err;
  expect_refusal(run_tool({"near", "-", "--radius", "2", "--csv", "-", "--json", "-"}, options),
                 {"standard output: named for two outputs"});
  // What is no text says so.
  expect_refusal(run_tool({"simulate", "wall", "--log", "-"}, options), {"--log -"});
  expect_refusal(run_tool({"simulate", "wall", "--record", "-"}, options), {"--record -"});
  expect_refusal(run_tool({"simulate", "wall", "--picture", "-"}, options), {"picture"});
  expect_refusal(run_tool({"simulate", "wall", "--view", "-"}, options), {"--view -"});
  expect_refusal(run_tool({"paper", "hybrid", "--quick", "--csv", "-"}, options), {"directory"});
  EXPECT_EQ(here.count(), 0U) << "a file called -";
}

TEST(Mistakes, TablesMayNameTheirColumns) {
  RunOptions options;
  options.input = "x,y,z,radius\n0,0,0,1\n5,0,0,1\n";
  const Outcome near = run_tool({"near", "-", "--radius", "3"}, options);
  EXPECT_EQ(near.out, "objects 2, pairs 1\n") << near.err;
  options.input = "# boxes\n\"min x\" miny minz maxx maxy maxz\n0 0 0 1 1 1\n1 1 1 2 2 2\n";
  EXPECT_EQ(run_tool({"pairs", "-"}, options).out, "boxes 2, pairs 1\n");
  // A header is the first row, and has no number in it.
  options.input = "0 0 0\nx y z\n";
  expect_refusal(run_tool({"near", "-", "--radius", "3"}, options), {"standard input:2: \"x\" is not a number"});
  options.input = "x 0 0\n";
  expect_refusal(run_tool({"near", "-", "--radius", "3"}, options), {"standard input:1: \"x\" is not a number"});
  // Numbers in another form are not names of columns.
  options.input = "0;0;0;1;1;1\n";
  expect_refusal(run_tool({"pairs", "-"}, options), {"standard input:1: \"0;0;0;1;1;1\" is not a number"});
  options.input = "\"0\" \"1\"\n";
  expect_refusal(run_tool({"near", "-", "--radius", "3"}, options), {"standard input:1: \"\"0\"\" is not a number"});
  options.input = std::string(
      "\xFF\xFE"
      "0\0 \0"
      "1\0\n\0",
      10);
  expect_refusal(run_tool({"near", "-", "--radius", "3"}, options), {"a text in UTF-16: save it as UTF-8"});
}

/// Sanitizers take terabytes of addresses, so that memory cannot be limited.
RunOptions little_memory() {
  RunOptions options;
  options.mebibytes = tests::sanitized ? 0 : 6000;
  options.cpu_seconds = tests::sanitized ? 0 : 60;
  return options;
}

TEST(Mistakes, InputsWithoutEndComeToOne) {
  const RunOptions options = little_memory();
  expect_refusal(run_tool({"simulate", "/dev/zero"}, options), {"/dev/zero: ", "larger than 256 MiB"});
  expect_refusal(run_tool({"near", "/dev/zero", "--radius", "1"}, options),
                 {"/dev/zero:1: more than 65536 characters"});
  expect_refusal(run_tool({"pairs", "/dev/zero"}, options), {"/dev/zero:1: more than 65536 characters"});
  expect_refusal(run_tool({"replay", "/dev/zero"}, options), {"/dev/zero: larger than 1024 MiB"});
  expect_refusal(run_tool({"aabbs", "/dev/zero"}, options), {"/dev/zero: "});
  expect_refusal(run_tool({"accuracy", "hard/free_fall", "--truth", "/dev/zero", "--body", "ball"}, options),
                 {"/dev/zero: ", "larger than 256 MiB"});
  expect_refusal(run_tool({"import", "/dev/zero", "-o", "-"}, options), {"/dev/zero: "});
  expect_refusal(run_tool({"mesh", "check", "/dev/zero"}, options), {"/dev/zero: "});
  const ScratchDirectory here;
  std::filesystem::create_symlink("/dev/zero", here.file("zero.stl"));
  expect_refusal(run_tool({"mesh", "check", here.file("zero.stl")}, options), {"zero.stl: "});
  const json scene{{"format", 1},
                   {"meta", {{"name", "n"}, {"about", "a"}}},
                   {"time", {{"dt", 0.01}}},
                   {"world", {{"bounds", {{"min", {-1, -1, -1}}, {"max", {1, 1, 1}}}}}},
                   {"shapes", {{{"name", "m"}, {"type", "mesh"}, {"file", "/dev/zero"}}}}};
  expect_refusal(run_tool({"simulate", here.write("s.json", scene.dump())}, options), {"/dev/zero"});
  for (const char* const shell : {"yes '0 0 0 1 1 1 7' | \"$0\" pairs -", "yes '{' | tr -d '\\n' | \"$0\" pairs -"}) {
    const Outcome run = run_program("/bin/sh", {"-c", shell, tool_program()}, options);
    EXPECT_EQ(run.exit_code, 2) << run.err;
  }
}

/// glTF with one triangle whose corners are in a file called `uri`.
std::string gltf(const std::string& uri) {
  return json{{"asset", {{"version", "2.0"}}},
              {"buffers", {{{"uri", uri}, {"byteLength", 36}}}},
              {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
              {"accessors",
               {{{"bufferView", 0},
                 {"componentType", 5126},
                 {"count", 3},
                 {"type", "VEC3"},
                 {"min", {0, 0, 0}},
                 {"max", {1, 1, 0}}}}},
              {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
              {"nodes", {{{"mesh", 0}}}},
              {"scenes", {{{"nodes", {0}}}}},
              {"scene", 0}}
      .dump();
}

TEST(Mistakes, AMeshReadsNothingOutsideOfItsFolder) {
  const ScratchDirectory top;
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  std::filesystem::create_directories(top.file("mesh/sub"));
  top.write("secret.bin", bytes);
  for (const char* const name : {"mesh/own.bin", "mesh/sub/own.bin"}) top.write(name, bytes);
  std::filesystem::create_symlink("../secret.bin", top.file("mesh/link.bin"));
  std::filesystem::create_symlink("..", top.file("mesh/up"));
  const auto check = [&](const std::string& uri) {
    return run_tool({"mesh", "check", top.write("mesh/a.gltf", gltf(uri))});
  };
  for (const char* const uri : {"own.bin", "./own.bin", "sub/own.bin", "sub/../own.bin"})
    EXPECT_EQ(check(uri).exit_code, 0) << uri << check(uri).err;
  for (const std::string& uri : {std::string("../secret.bin"), std::string("sub/../../secret.bin"),
                                 std::string("link.bin"), std::string("up/secret.bin")})
    expect_refusal(check(uri), {"a.gltf: ", "names a file outside of its folder: "});
  for (const std::string& uri : {std::string("%2e%2e/secret.bin"), std::string("..%2fsecret.bin"),
                                 top.file("secret.bin"), "file://" + top.file("secret.bin")})
    EXPECT_EQ(check(uri).exit_code, 2) << uri;
  // The file itself may be a link: its user has named it.
  std::filesystem::create_symlink("mesh/own.bin", top.file("own.bin"));
  top.write("mesh/a.gltf", gltf("own.bin"));
  std::filesystem::create_symlink("a.gltf", top.file("mesh/b.gltf"));
  EXPECT_EQ(run_tool({"mesh", "check", top.file("mesh/b.gltf")}).exit_code, 0);
  // Materials are of no use here, so that those outside are merely not read.
  top.write("secret.mtl", "newmtl m\n");
  top.write("mesh/a.obj", "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run_tool({"mesh", "check", top.file("mesh/a.obj")}).exit_code, 0);
}

/// No byte that steers a terminal, but for the ends of lines.
void expect_harmless(const Outcome& run, const std::string& what) {
  for (const std::string& text : {run.out, run.err})
    EXPECT_TRUE(std::none_of(text.begin(), text.end(),
                             [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f || c == 0x9b; }))
        << what << ": " << json(text).dump(-1, ' ', true, json::error_handler_t::replace);
}

TEST(Mistakes, NamesDoNotSteerTheTerminal) {
  const std::string evil =
      "\x1b]0;owned\a\x1b[2J\rfine\nline\xc2\x9b"
      "31m";
  const ScratchDirectory here;
  const json scene{
      {"format", 1},
      {"meta", {{"name", evil}, {"about", evil}, {"tags", {evil}}, {"source", evil}}},
      {"time", {{"dt", 0.01}, {"steps", 2}}},
      {"world", {{"bounds", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}}}}},
      {"shapes", {{{"name", evil}, {"type", "sphere"}, {"radius", 1}}}},
      {"bodies",
       {{{"name", evil}, {"shape", evil}, {"mass", 1}}, {{"name", evil + "2"}, {"shape", evil}, {"mass", 1}}}}};
  const std::string file = here.write("s\x1b[31m.json", scene.dump());
  json shapes = scene;
  for (const char* const key : {"meta", "time", "world"}) shapes.erase(key);
  for (json& body : shapes["bodies"]) body.erase("mass");
  const std::string bodies = here.write("shapes.json", shapes.dump());
  json broken = scene;
  broken[evil] = 1;
  const std::string bad = here.write("bad.json", broken.dump());
  ASSERT_EQ(run_tool({"simulate", file, "--log", here.file("a.bsrec"), "--record", here.file("a.aabbs")}).exit_code, 0);
  const std::vector<std::vector<std::string>> runs{
      {"simulate", file},
      {"simulate", file, "--json", "-"},
      {"simulate", file, "--compare", "dbvt"},
      {"explain", file},
      {"explain", file, "--json", "-"},
      {"accuracy", file, "--knob", "substeps=1", "--repeats", "1"},
      {"accuracy", file, "--knob", "substeps=1", "--repeats", "1", "--json", "-"},
      {"replay", here.file("a.bsrec")},
      {"replay", here.file("a.bsrec"), "--json", "-"},
      {"replay", here.file("a.bsrec"), "--dump"},
      {"aabbs", here.file("a.aabbs")},
      {"aabbs", here.file("a.aabbs"), "--json", "-"},
      {"pairs", bodies},
      {"pairs", bodies, "--list"},
      {"near", file, "--radius", "1"},
      {"simulate", bad},
      {"simulate", evil},
      {"simulate", "pile", "--broadphase", evil},
      {"simulate", "pile", "--picture", evil},
      {"simulate", "pile", "--" + evil},
      {evil},
      {"query", evil},
      {"import", evil, "-o", "-"},
      {"import", file, "-o", evil},
      {"mesh", "check", evil + ".stl"},
      {"paper", "hybrid", "--figure", evil},
      {"simulate", "pile", "--json", evil + "/a"}};
  for (const auto& arguments : runs) {
    const Outcome run = run_tool(arguments);
    expect_harmless(run, arguments[0]);
    EXPECT_EQ((run.out + run.err).find("\nline"), std::string::npos) << arguments[0] << ": a line is made up";
  }
  EXPECT_NE(run_tool({"pairs", bodies, "--list"}).out.find("touch depth"), std::string::npos);
}

/// Words of the command line shuffled, cut, doubled and spoilt: always an exit code of the three, one line where it is
/// refused, and nothing written.
TEST(Mistakes, FuzzedCommandLines) {
  const ScratchDirectory here;
  RunOptions options;
  options.directory = here.file(".");
  options.input = "1 2 3\n";
  options.cpu_seconds = tests::sanitized ? 0 : 20;
  const std::vector<std::string> words{"near",   "pairs",    "list",   "explain", "mesh",   "check",  "make",
                                       "sphere", "replay",   "aabbs",  "-",       "--",     "--json", "--csv",
                                       "--log",  "--radius", "--list", "--count", "--seed", "--dump", "wall",
                                       "points", "-1",       "0",      "1e999",   "nan",    "--help", "--steps",
                                       "",       "=",        "--=",    "--csv=-", "-o",     "a,b",    "\xff",
                                       "--knob", "x=1",      "\n",     "--save",  "8",      "--out",  "query_arm"};
  std::mt19937 random(7);
  for (int round = 0; round < (tests::sanitized ? 20 : 150); ++round) {
    std::vector<std::string> arguments;
    // Never `simulate`, `accuracy` and `prices`, which may be right and take long.
    for (std::size_t i = 0, count = random() % 6; i < count; ++i) {
      std::string word = words[random() % words.size()];
      if (random() % 5 == 0 && !word.empty()) word[random() % word.size()] = static_cast<char>(1 + random() % 255);
      if (random() % 9 == 0) word += words[random() % words.size()];
      arguments.push_back(word);
    }
    here.write("points", "0 0 0\n1 0 0\n");
    const Outcome run = run_tool(arguments, options);
    const std::string line = json(arguments).dump(-1, ' ', true, json::error_handler_t::replace);
    EXPECT_TRUE(run.exit_code >= 0 && run.exit_code <= 2) << line << run.exit_code << run.err;
    if (run.exit_code == 2) {
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << line << run.err;
      EXPECT_TRUE(run.err.starts_with("boxstream: ")) << line << run.err;
    }
    expect_harmless(run, line);
    for (const auto& entry : std::filesystem::directory_iterator(here.file(".")))
      EXPECT_FALSE(entry.path().string().ends_with(".part") || entry.path().filename() == "-") << line;
  }
}

TEST(Mistakes, TimesOfAccuracyAreWithinTheRun) {
  for (const char* none : {"-1", "0", "nan", "0.001"})
    expect_refusal(run_tool({"accuracy", "hard/free_fall", "--at", none}), {"before the end of the first step"});
  for (const char* many : {"1e30", "inf", "1e6"})
    expect_refusal(run_tool({"accuracy", "hard/free_fall", "--at", many}), {"more than 10000000 steps"});
  expect_refusal(run_tool({"accuracy", "hard/free_fall", "--at", "1", "--steps", "5"}), {"one of the two"});
}

TEST(Mistakes, OneNewFileUnderTwoNamesIsOne) {
  const std::string name = "two_names_" + std::to_string(std::random_device()()) + ".csv";
  expect_refusal(run_tool({"simulate", "wall", "--steps", "1", "--csv", name, "--states", "./" + name}),
                 {"named for two outputs"});
  EXPECT_FALSE(std::filesystem::exists(name));
}

TEST(Mistakes, ReferencesOfAccuracyAreNotOverwritten) {
  const ScratchDirectory directory;
  const std::string truth = directory.file("truth.csv");
  std::ofstream(truth) << "seconds,x,y,z\n0,0,10,0\n1,0,5,0\n";
  expect_refusal(run_tool({"accuracy", "hard/free_fall", "--truth", truth, "--csv", truth}), {"it is an input too"});
}

TEST(Mistakes, GapsOfWallsLeaveHalfBricks) {
  const ScratchDirectory directory;
  const auto wall = [&](double gap) {
    json scene = {{"format", 1},
                  {"meta", {{"name", "wall"}, {"about", "A wall."}}},
                  {"time", {{"dt", 0.01}, {"steps", 1}}},
                  {"world", {{"gravity", {0, -10, 0}}, {"bounds", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}}}}},
                  {"shapes", {{{"name", "b"}, {"type", "box"}, {"half_extents", {0.2, 0.1, 0.1}}}}},
                  {"generators",
                   {{{"type", "wall"},
                     {"columns", 3},
                     {"rows", 2},
                     {"origin", {0, 0, 0}},
                     {"gap", gap},
                     {"brick", {{"shape", "b"}, {"mass", 1}}}}}}};
    std::ofstream(directory.file("wall.json")) << scene;
    return run_tool({"simulate", directory.file("wall.json"), "--steps", "1"});
  };
  EXPECT_EQ(wall(0.1).exit_code, 0);
  expect_refusal(wall(0.5), {"/generators/0/gap"});
  expect_refusal(wall(0.4), {"/generators/0/gap"});
}

}  // namespace
}  // namespace boxstream::tool_test
