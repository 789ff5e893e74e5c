// SPDX-License-Identifier: MIT
// What ends a search early leaves nothing behind: a sink that refuses or throws, a reader that fails, a full disk.
#include <csignal>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
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

TEST(OutOfCoreFailures, FileHasNoNameWhileItIsUsed) {
  const tool_test::ScratchDirectory directory;
  auto reader = dense();
  const auto stats = stream_pairs(reader,
                                  [&](Span<const WidePair>) {
                                    EXPECT_EQ(directory.count(), 0u);
                                    return true;
                                  },
                                  {least_memory, directory.file("")});
  EXPECT_GT(stats.file_bytes, 0u);
}

TEST(OutOfCoreFailures, ErrorsOfTheFileNameFolderAndReason) {
  auto reader = dense();
  try {
    stream_pairs(reader, take_all, {least_memory, "/no/such/folder"});
    ADD_FAILURE() << "no error";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
    EXPECT_NE(std::string(error.what()).find("/no/such/folder"), std::string::npos) << error.what();
  }
}

/// A limit on the size of files stands for a full disk: writing fails half way.
TEST(OutOfCoreFailures, FullDiskIsAnErrorAndLeavesNothing) {
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
  EXPECT_THROW(stream_pairs(reader, take_all, {least_memory - 1}), std::invalid_argument);
  EXPECT_EQ(reader.calls(), 0u);
}

}  // namespace
}  // namespace boxstream::out_of_core_test
