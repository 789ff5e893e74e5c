// SPDX-License-Identifier: MIT
#include "formats/import/guarded.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "formats/scene_model/scene_error.hpp"
#include "scratch_directory.hpp"

namespace boxstream::import_test {
namespace {

using imports::Allowance;
using imports::guarded;

std::string complaint(const std::function<std::string()>& work, const Allowance& allowance = {}) {
  try {
    guarded("file", work, allowance);
  } catch (const scenes::SceneError& error) {
    return error.what();
  }
  return {};
}

TEST(Guarded, GivesWhatTheWorkReturns) {
  EXPECT_EQ(guarded("file", [] { return std::string(); }, {}), "");
  std::string large(3'000'000, 'x');
  large[7] = '\0';
  EXPECT_EQ(guarded("file", [&] { return large; }, {}), large);
}

TEST(Guarded, FilesThatNameOthersHaveRoomForThem) {
  const tool_test::ScratchDirectory scratch;
  const auto megabytes_for = [&](const std::string& name) {
    return imports::allowance_for(scratch.write(name, std::string(1000, ' '))).memory >> 20;
  };
  EXPECT_EQ(megabytes_for("small.glb"), 256u);
  EXPECT_EQ(megabytes_for("small.urdf"), 4096u);
  EXPECT_EQ(megabytes_for("small.gltf"), 4096u);
}

TEST(Guarded, PassesOnWhatTheWorkThrows) {
  EXPECT_EQ(complaint([]() -> std::string { throw std::runtime_error("a\nb\n"); }), "file: a\\x0ab");
  EXPECT_EQ(complaint([]() -> std::string { throw scenes::SceneError("other: reason"); }), "other: reason");
  EXPECT_EQ(complaint([]() -> std::string { throw std::bad_alloc(); }), "file: needs too much memory");
}

TEST(Guarded, OutlivesACrash) {
  EXPECT_EQ(complaint([]() -> std::string {
              std::signal(SIGSEGV, SIG_DFL);  // sanitizers have a handler of their own
              std::raise(SIGSEGV);
              return {};
            }),
            "file: the reader crashed on it (Segmentation fault)");
}

TEST(Guarded, OutlivesAnExit) {
  EXPECT_EQ(complaint([]() -> std::string { std::quick_exit(0); }), "file: the reader gave up on it");
}

TEST(Guarded, StopsEndlessWork) {
  Allowance short_one;
  short_one.wall_seconds = 1;
  EXPECT_EQ(complaint(
                [] {
                  volatile unsigned i = 0;
                  for (;;) i = i + 1;
                  return std::string();
                },
                short_one),
            "file: takes too long to read");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Guarded, RefusesAHugeAllocation) {
  EXPECT_EQ(complaint([] { return std::string(std::size_t{8} << 30, 'x'); }), "file: needs too much memory");
}
#endif

TEST(Guarded, KeepsWhatTheWorkPrintsToItself) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  guarded("file",
          [] {
            std::printf("chatter");
            std::fprintf(stderr, "more");
            std::fflush(stdout);
            return std::string();
          },
          {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace boxstream::import_test
