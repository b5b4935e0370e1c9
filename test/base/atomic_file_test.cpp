// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "palpate/base/error.h"
#include "support/contains.h"
#include "support/temp_folder.h"

namespace palpate::atomic_file_test {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::fileBytes;

/// While it lives, no file of this process grows beyond so many bytes: write() fails, as on a full
/// disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

class AtomicFileTest : public ::testing::Test {
 protected:
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(fs::path(file_).parent_path()), {}));
  }
  std::string complaint(const std::string& file, const std::string& bytes = "new") const {
    try {
      writeFileAtomically(file, bytes);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  test::TempFolder folder_;
  const std::string file_ = folder_.path("state.csv");
};

TEST_F(AtomicFileTest, IsThereWhenItIsWholeAndNotBefore) {
  const std::string bytes("a\0b\n", 4);
  {
    AtomicFile whole(file_);
    std::ofstream(whole.part(), std::ios::binary) << bytes;
    EXPECT_FALSE(fs::exists(file_));
    whole.commit();
  }
  EXPECT_EQ(fileBytes(file_), bytes);
  EXPECT_EQ(filesInFolder(), 1u);
  writeFileAtomically(file_, std::string(1 << 20, 'x'));
  EXPECT_EQ(fileBytes(file_).size(), std::size_t{1} << 20);
  writeFileAtomically(file_, "");
  EXPECT_EQ(fileBytes(file_), "");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldOneStays) {
  folder_.write("state.csv", "old");
  {
    const AtomicFile whole(file_);
    std::ofstream(whole.part()) << "half";
  }
  EXPECT_EQ(fileBytes(file_), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(AtomicFileTest, OnAFullDiskTheOldOneStays) {
  folder_.write("state.csv", "old");
  {
    const FullDisk full(1000);
    const std::string said = complaint(file_, std::string(100000, 'x'));
    EXPECT_TRUE(contains(said, file_ + ": cannot be written: "));
  }
  EXPECT_EQ(fileBytes(file_), "old");
  EXPECT_EQ(filesInFolder(), 1u);
  EXPECT_EQ(complaint(file_, std::string(100000, 'x')), "");
}

TEST_F(AtomicFileTest, SaysWhyItCannotBeWritten) {
  EXPECT_TRUE(contains(complaint(folder_.path("no/such/state.csv")), "No such file"));
  EXPECT_FALSE(fs::exists(folder_.path("no")));
  fs::create_directory(folder_.path("taken"));
  EXPECT_TRUE(contains(complaint(folder_.path("taken")), "no regular file"));
  EXPECT_TRUE(contains(complaint("/dev/null"), "no regular file"));
}

TEST_F(AtomicFileTest, WithoutPermissionTheOldOneStays) {
  if (::geteuid() == 0) GTEST_SKIP() << "needs a user who may not write everywhere; this is root";
  folder_.write("state.csv", "old");
  fs::permissions(fs::path(file_).parent_path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_TRUE(contains(complaint(file_), "Permission denied"));
  fs::permissions(fs::path(file_).parent_path(), fs::perms::owner_all);
  EXPECT_EQ(fileBytes(file_), "old");
}

TEST_F(AtomicFileTest, BehindALinkTheFileItselfIsMeant) {
  folder_.write("real.csv", "old");
  fs::create_symlink(folder_.path("real.csv"), file_);
  writeFileAtomically(file_, "new");
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(fileBytes(folder_.path("real.csv")), "new");
}

TEST_F(AtomicFileTest, WritersOfTheSameFileDoNotMix) {
  std::vector<std::thread> writers;
  for (const char letter : {'a', 'b', 'c', 'd'}) {
    writers.emplace_back([this, letter] {
      for (int i = 0; i < 20; ++i) writeFileAtomically(file_, std::string(50000, letter));
    });
  }
  for (std::thread& writer : writers) writer.join();
  const std::string bytes = fileBytes(file_);
  EXPECT_EQ(bytes, std::string(50000, bytes.at(0)));
  EXPECT_EQ(filesInFolder(), 1u);
}

}  // namespace
}  // namespace palpate::atomic_file_test
