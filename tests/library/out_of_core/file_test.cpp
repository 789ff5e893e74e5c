// SPDX-License-Identifier: MIT
// Who can see the temporary file: this process alone.
#include <fcntl.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "file_calls.hpp"
#include "open_files.hpp"
#include "scratch_directory.hpp"
#include "vector_reader.hpp"

namespace boxstream::out_of_core_test {
namespace {

using tool_test::ScratchDirectory;

constexpr std::uint64_t least_memory = 64 << 10;

/// What the system says of the only open file of the folder.
struct OpenFile {
  std::size_t count = 0;  // of open files
  struct stat status = {};
  int flags = 0;

  explicit OpenFile(const std::string& folder) {
    const std::vector<int> files = open_files(folder);
    count = files.size();
    if (count == 0) return;
    fstat(files[0], &status);
    flags = fcntl(files[0], F_GETFD);
  }
};

/// Runs a search, whose sink calls `look`.
template <class Look>
void search_in(const ScratchDirectory& directory, const Look& look) {
  VectorReader<float> reader(tests::box_set<float>("dense").make(2100, 1));
  const auto sink = [&](Span<const WidePair>) {
    look();
    return true;
  };
  const OutOfCoreStats stats = stream_pairs(reader, sink, {least_memory, directory.file("")});
  EXPECT_GT(stats.file_bytes, 0u);
}

/// In a folder where everybody may do everything, by a program that would give its files to everybody.
void expect_file_of_its_own() {
  const ScratchDirectory directory;
  chmod(directory.file("").c_str(), 0777);
  const mode_t before = umask(0);
  std::size_t looks = 0;
  search_in(directory, [&] {
    if (++looks > 3) return;
    const OpenFile file(directory.file(""));
    EXPECT_EQ(file.count, 1u);
    EXPECT_EQ(file.status.st_mode, mode_t{S_IFREG | 0600});
    EXPECT_EQ(file.status.st_nlink, 0u) << "it has a name";
    EXPECT_EQ(file.flags & FD_CLOEXEC, FD_CLOEXEC) << "programs that this one starts have it";
    EXPECT_EQ(directory.count(), 0u);
  });
  umask(before);
  EXPECT_GT(looks, 0u);
  EXPECT_EQ(OpenFile(directory.file("")).count, 0u);
}

TEST(OutOfCoreFile, IsOfThisProcessAlone) {
  expect_file_of_its_own();
}

TEST(OutOfCoreFile, IsOfThisProcessAloneWhereEveryFileHasAName) {
  const file_calls::Refusals refusals;
  file_calls::refuse_nameless = true;
  expect_file_of_its_own();
}

/// Names that appear in a folder.
class NewNames {
 public:
  explicit NewNames(const std::string& folder) : events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    inotify_add_watch(events_, folder.c_str(), IN_CREATE | IN_MOVED_TO);
  }
  ~NewNames() { close(events_); }
  NewNames(const NewNames&) = delete;
  NewNames& operator=(const NewNames&) = delete;

  bool were_seen() const {
    alignas(inotify_event) char event[4096];
    return read(events_, event, sizeof event) > 0;
  }

 private:
  int events_;
};

TEST(OutOfCoreFile, NeverHasANameToBeOpenedOrReplacedBy) {
  const ScratchDirectory directory;
  const int probe = open(directory.file("").c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (probe < 0) GTEST_SKIP() << "this file system makes no file without a name";
  close(probe);
  const NewNames names(directory.file(""));
  search_in(directory, [] {});
  EXPECT_FALSE(names.were_seen());
  directory.write("a file", "");
  EXPECT_TRUE(names.were_seen());
}

}  // namespace
}  // namespace boxstream::out_of_core_test
