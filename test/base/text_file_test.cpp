// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/text_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "support/contains.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::text_file_test {
namespace {

using test::complaint;
using test::contains;

class TextFile : public ::testing::Test {
 protected:
  std::string complaintOf(const std::string& file, std::size_t max_bytes = 100) const {
    return complaint([&] { readTextFile(file, max_bytes); });
  }
  test::TempFolder folder_;
};

TEST_F(TextFile, GivesAllBytes) {
  std::string bytes(70000, 'x');
  bytes[0] = '\0';
  bytes[1] = '\n';
  EXPECT_EQ(readTextFile(folder_.write("a", bytes), bytes.size()), bytes);
  EXPECT_EQ(readTextFile(folder_.write("b", ""), 0), "");
}

TEST_F(TextFile, FollowsLinks) {
  folder_.write("a", "text");
  std::filesystem::create_symlink(folder_.path("a"), folder_.path("link"));
  EXPECT_EQ(readTextFile(folder_.path("link"), 4), "text");
  std::filesystem::create_symlink(folder_.path("round"), folder_.path("round"));
  EXPECT_TRUE(contains(complaintOf(folder_.path("round")), "cannot be opened"));
}

TEST_F(TextFile, IsRefusedBeyondTheBoundBeforeItIsRead) {
  const std::string file = folder_.write("a", "text");
  EXPECT_TRUE(contains(complaintOf(file, 3), "is larger than 0 MiB"));
  std::filesystem::resize_file(file, std::uintmax_t{1} << 42);  // with nothing in it
  EXPECT_TRUE(contains(complaintOf(file, std::size_t{1} << 30), "is larger than 1024 MiB"));
}

// Which have no end, or where nobody writes.
TEST_F(TextFile, IsRefusedIfItIsADeviceAPipeOrAFolder) {
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& file : {std::string("/dev/zero"), std::string("/dev/null"), pipe}) {
    EXPECT_TRUE(contains(complaintOf(file), "must be a regular file")) << file;
  }
  EXPECT_TRUE(contains(complaintOf(folder_.path("")), "is a folder"));
}

TEST_F(TextFile, ThatIsNotThereIsSaidSo) {
  EXPECT_TRUE(contains(complaintOf(folder_.path("absent")), "no such file"));
  EXPECT_TRUE(contains(complaintOf(folder_.write("a", "") + "/b"), "no such file"));
}

// As those of /proc, which say that they are empty.
TEST_F(TextFile, IsReadToItsEndWhateverItSaysOfItsSize) {
  EXPECT_TRUE(contains(readTextFile("/proc/self/status", 1 << 20), "VmPeak"));
  EXPECT_TRUE(contains(complaintOf("/proc/self/status", 10), "is larger"));
}

}  // namespace
}  // namespace palpate::text_file_test
