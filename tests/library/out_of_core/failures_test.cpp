// SPDX-License-Identifier: MIT
// What ends a search early leaves nothing behind: a sink that refuses or throws, a reader that fails, a full disk.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "file_calls.hpp"
#include "open_files.hpp"
#include "scratch_directory.hpp"
#include "vector_reader.hpp"

namespace boxstream::out_of_core_test {
namespace {

constexpr std::uint64_t least_memory = 64 << 10;

VectorReader<float> dense(std::size_t fails_at = 0) {
  return VectorReader<float>(tests::box_set<float>("dense").make(3000, 1), 500, fails_at);
}

const auto take_all = [](Span<const WidePair>) { return true; };

TEST(OutOfCoreFailures, SinkStopsTheSearchAtAnyBatch) {
  const tool_test::ScratchDirectory directory;
  std::size_t batches = 0;
  auto reader = dense();
  stream_pairs(reader, [&](Span<const WidePair>) { return ++batches != 0; }, {least_memory});
  ASSERT_GT(batches, 20u);
  for (std::size_t last = 1; last < batches; last += 3) {
    std::size_t calls = 0;
    stream_pairs(reader, [&](Span<const WidePair>) { return ++calls < last; }, {least_memory, directory.file("")});
    ASSERT_EQ(calls, last) << "called again after it returned false";
    ASSERT_EQ(directory.count(), 0u);
  }
}

TEST(OutOfCoreFailures, WhatSinkAndReaderThrowPassesThrough) {
  const tool_test::ScratchDirectory directory;
  auto reader = dense();
  const auto refuse = [](Span<const WidePair>) -> bool { throw std::domain_error("the sink fails"); };
  EXPECT_THROW(stream_pairs(reader, refuse, {least_memory, directory.file("")}), std::domain_error);
  stream_pairs(reader, take_all, {least_memory});
  for (std::size_t call = 1; call <= 14; ++call) {  // two passes of six blocks, and the end of each
    auto failing = dense(call);
    EXPECT_THROW(stream_pairs(failing, take_all, {least_memory, directory.file("")}), std::runtime_error) << call;
  }
  EXPECT_EQ(directory.count(), 0u);
}

/// What the error says, which it says once.
std::string error_in(const std::string& directory, std::errc reason) {
  auto reader = dense();
  try {
    stream_pairs(reader, take_all, {least_memory, directory});
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), reason);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(OutOfCoreFailures, ErrorsOfTheFileNameFolderAndReason) {
  EXPECT_EQ(error_in("/no/such/folder", std::errc::no_such_file_or_directory),
            "boxstream: the temporary file in /no/such/folder cannot be made: No such file or directory");
  EXPECT_EQ(error_in("/dev/null", std::errc::not_a_directory),
            "boxstream: the temporary file in /dev/null cannot be made: Not a directory");
}

TEST(OutOfCoreFailures, TheSystemsFolderIsThatOfTheEnvironment) {
  const char* const variable = std::getenv("TMPDIR");
  const std::string before = variable != nullptr ? variable : "";
  setenv("TMPDIR", "/no/folder/at/all", 1);
  const std::string text = error_in({}, std::errc::no_such_file_or_directory);
  variable != nullptr ? setenv("TMPDIR", before.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_EQ(text, "boxstream: the temporary file in /no/folder/at/all cannot be made: No such file or directory");
}

/// Some of a block still fits, or none, or whole blocks do; signals come between.
TEST(OutOfCoreFailures, FullDiskGivesItsReasonAndLeavesNothing) {
  const tool_test::ScratchDirectory directory;
  const file_calls::Refusals refusals;
  const std::string expected = "boxstream: the temporary file in " + directory.file("") + " cannot be written: ";
  for (const bool named : {false, true})
    for (const bool interrupted : {false, true})
      for (const std::uint64_t room : {0, 1, 4095, 4096, 50000}) {
        file_calls::refuse_nameless = named;
        file_calls::interrupt = interrupted;
        file_calls::room = room;
        EXPECT_EQ(error_in(directory.file(""), std::errc::no_space_on_device), expected + "No space left on device");
        EXPECT_EQ(file_calls::room, 0u) << "what fits is written";
        EXPECT_EQ(directory.count(), 0u);
        EXPECT_TRUE(open_files(directory.file("")).empty());
      }
}

TEST(OutOfCoreFailures, SignalsAndShortWritesChangeNothing) {
  const file_calls::Refusals refusals;
  auto reader = dense();
  const OutOfCoreStats whole = stream_pairs(reader, take_all, {least_memory});
  file_calls::interrupt = true;
  const OutOfCoreStats interrupted = stream_pairs(reader, take_all, {least_memory});
  EXPECT_EQ(interrupted.pairs, whole.pairs);
  EXPECT_EQ(interrupted.bytes_written, whole.bytes_written);
}

/// The system's limit on the size of files: writing fails half way.
TEST(OutOfCoreFailures, TooLargeAFileIsAnErrorAndLeavesNothing) {
  const tool_test::ScratchDirectory directory;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t limit : {0, 30000, 60000}) {
    const rlimit small{limit, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    auto reader = dense();
    std::error_code code;
    try {
      stream_pairs(reader, take_all, {least_memory, directory.file("")});
    } catch (const std::system_error& error) {
      code = error.code();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(code, std::errc::file_too_large) << limit;
    EXPECT_EQ(directory.count(), 0u);
  }
  std::signal(SIGXFSZ, handler);
  auto reader = dense();
  EXPECT_GT(stream_pairs(reader, take_all, {least_memory, directory.file("")}).file_bytes, 60000u);
}

TEST(OutOfCoreFailures, LittleMemoryIsRefused) {
  auto reader = dense();
  for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1}, least_memory - 1})
    EXPECT_THROW(stream_pairs(reader, take_all, {memory}), std::invalid_argument) << memory;
  EXPECT_EQ(reader.calls(), 0u);
}

}  // namespace
}  // namespace boxstream::out_of_core_test
