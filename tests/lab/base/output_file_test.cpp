// SPDX-License-Identifier: MIT
#include "base/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "base/read_file.hpp"
#include "scratch_directory.hpp"

namespace boxstream::files {
namespace {

using tool_test::ScratchDirectory;

std::string refusal(const std::string& name) {
  try {
    OutputFile file(name);
  } catch (const BadFile& error) {
    return error.reason();
  }
  return "none";
}

mode_t mode_of(const std::string& name) {
  struct stat status {};
  EXPECT_EQ(stat(name.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const ScratchDirectory directory;
  {
    OutputFile dropped(directory.file("a"));
    dropped.stream() << "half" << std::flush;
    EXPECT_EQ(directory.count(), 1U);
    EXPECT_FALSE(std::filesystem::exists(directory.file("a")));
  }
  EXPECT_EQ(directory.count(), 0U);
  OutputFile kept(directory.file("a"));
  kept.stream() << "whole";
  kept.commit();
  EXPECT_EQ(directory.read("a"), "whole");
  EXPECT_EQ(directory.count(), 1U);
}

TEST(OutputFile, LargeAndSmallPiecesInOrder) {
  const ScratchDirectory directory;
  std::string expected;
  OutputFile file(directory.file("a"));
  for (int i = 0; i < 300; ++i) {
    const std::string piece(static_cast<std::size_t>(i * i * 7 % 90'001), static_cast<char>('a' + i % 26));
    expected += piece + '\n';
    file.stream() << piece;
    file.stream().put('\n');
  }
  file.commit();
  EXPECT_EQ(directory.read("a"), expected);
}

TEST(OutputFile, KeepsTheModeOfTheFileThatItReplaces) {
  const ScratchDirectory directory;
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    chmod(directory.write("a", "earlier").c_str(), mode);
    write_file(directory.file("a"), "later");
    EXPECT_EQ(mode_of(directory.file("a")), mode);
    EXPECT_EQ(directory.read("a"), "later");
  }
  const mode_t mask = umask(027);
  write_file(directory.file("new"), "text");
  umask(mask);
  EXPECT_EQ(mode_of(directory.file("new")), 0640u);
}

/// What another has put where the part goes is neither followed nor written over.
TEST(OutputFile, OpensNoPartThatIsThere) {
  const ScratchDirectory directory;
  const std::string part = "a." + std::to_string(getpid()) + ".part";
  const std::string victim = directory.write("victim", "precious");
  std::filesystem::create_symlink("victim", directory.file(part));
  write_file(directory.file("a"), "text");
  EXPECT_EQ(directory.read("victim"), "precious");
  EXPECT_EQ(directory.read("a"), "text");
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file(part)));
}

TEST(OutputFile, IsNoInput) {
  const ScratchDirectory directory;
  const std::string file = directory.write("a", "input");
  std::filesystem::create_hard_link(file, directory.file("hard"));
  std::filesystem::create_symlink("a", directory.file("soft"));
  std::filesystem::create_directory(directory.file("sub"));
  read_file(file, 100);
  for (const char* const name : {"a", "hard", "soft", "./a", "sub/../a"})
    EXPECT_EQ(refusal(directory.file(name)), "cannot be written: it is an input too") << name;
  EXPECT_EQ(refusal(directory.file("b")), "none");
  write_file(file, "changed", Input::may_change);
  EXPECT_EQ(directory.read("a"), "changed");

  // Read only after it was opened for writing: nothing has happened to it yet.
  const std::string late = directory.write("late", "input");
  OutputFile out(late);
  out.stream() << "output";
  read_file(late, 100);
  EXPECT_THROW(out.commit(), BadFile);
  EXPECT_EQ(directory.read("late"), "input");
}

TEST(OutputFile, OneForEachName) {
  const ScratchDirectory directory;
  std::filesystem::create_symlink("a", directory.file("link"));
  directory.write("a", "");
  const OutputFile first(directory.file("a")), out("-");
  EXPECT_EQ(refusal(directory.file("./a")), "named for two outputs");
  EXPECT_EQ(refusal(directory.file("link")), "named for two outputs");
  EXPECT_EQ(refusal("-"), "named for two outputs");
  EXPECT_EQ(refusal(directory.file("b")), "none");
}

TEST(OutputFile, DevicesAreWrittenStraightThrough) {
  write_file("/dev/null", std::string(1'000'000, 'x'));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  OutputFile full("/dev/full");
  full.stream() << "text";
  try {
    full.commit();
    FAIL() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(OutputFile, Refusals) {
  const ScratchDirectory directory;
  EXPECT_EQ(refusal(directory.file("")), "cannot be written: is a directory");
  EXPECT_EQ(refusal(directory.file("no/a")), "cannot be written: No such file or directory");
  EXPECT_EQ(refusal(""), "cannot be written: names no file");
  directory.write("file", "");
  EXPECT_NE(refusal(directory.file("file/a")), "none");
  EXPECT_EQ(directory.count(), 1U);
}

}  // namespace
}  // namespace boxstream::files
