// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "scratch_directory.hpp"

namespace boxstream::files {
namespace {

using tool_test::ScratchDirectory;

std::string reason_of(const std::string& name, std::uint64_t most) {
  try {
    read_file(name, most);
  } catch (const BadFile& error) {
    EXPECT_EQ(error.what(), name + ": " + error.reason());
    return error.reason();
  }
  return "was read";
}

TEST(ReadFile, AllOfItOrTheReason) {
  const ScratchDirectory directory;
  std::string text(200'001, 'x');
  text[70'000] = '\0';
  EXPECT_EQ(read_file(directory.write("a", text), 1 << 20), text);
  EXPECT_EQ(read_file(directory.write("b", ""), 0), "");
  EXPECT_EQ(read_file(directory.file("a"), text.size()), text);
  EXPECT_EQ(reason_of(directory.file("a"), text.size() - 1), "larger than 0 MiB");
  EXPECT_EQ(reason_of(directory.file("none"), 10), "No such file or directory");
  EXPECT_EQ(reason_of(directory.file(""), 10), "Is a directory");
}

TEST(ReadFile, WithoutEnd) {
  EXPECT_EQ(reason_of("/dev/zero", 3 << 20), "larger than 3 MiB");
  InputFile zeros("/dev/zero");
  EXPECT_THROW(zeros.read_rest(3 << 20), BadFile);
}

TEST(ReadFile, IsKnownByAnyName) {
  const ScratchDirectory directory;
  const std::string file = directory.write("a", "text");
  const auto known = [](const std::string& name) {
    struct stat status {};
    EXPECT_EQ(stat(name.c_str(), &status), 0);
    return was_read({status.st_dev, status.st_ino});
  };
  EXPECT_FALSE(known(file));
  read_file(file, 10);
  std::filesystem::create_hard_link(file, directory.file("hard"));
  std::filesystem::create_symlink("a", directory.file("soft"));
  for (const char* const name : {"a", "hard", "soft"}) EXPECT_TRUE(known(directory.file(name))) << name;
  EXPECT_FALSE(known(directory.write("b", "text")));
  InputFile in(directory.file("b"));
  EXPECT_TRUE(known(directory.file("b")));
}

TEST(IsBelow, FollowsLinks) {
  const ScratchDirectory here, elsewhere;
  const std::string top = here.file(".");
  std::filesystem::create_directory(here.file("sub"));
  std::filesystem::create_symlink(elsewhere.file("."), here.file("out"));
  std::filesystem::create_symlink("sub", here.file("in"));
  for (const char* const name : {"a", "sub/a", "sub/../a", "sub/new/a", "in/a", "a b", "..a"})
    EXPECT_TRUE(is_below(top, here.file(name))) << name;
  for (const char* const name : {"../a", "sub/../../a", "out/a", "out/new/a", "in/../../a"})
    EXPECT_FALSE(is_below(top, here.file(name))) << name;
  EXPECT_FALSE(is_below(top, "/etc/passwd"));
  // A name that begins alike is another folder.
  EXPECT_FALSE(is_below(top, here.file("").substr(0, here.file("").size() - 1) + "x/a"));
}

}  // namespace
}  // namespace boxstream::files
