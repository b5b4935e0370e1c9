// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/csv_writer.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/base/error.h"
#include "support/temp_folder.h"

namespace palpate::io::csv_writer_test {
namespace {

TEST(CsvWriter, WritesHeaderAndRows) {
  const test::TempFolder folder;
  CsvWriter csv(folder.path("a.csv"), {"t", "n", "status"});
  csv << 0.1 << 3 << "converged";
  csv.endRow();
  csv << 1.0 / 3.0 << -1 << "a, \"b\"";
  csv.endRow();
  csv.close();
  EXPECT_EQ(test::fileBytes(folder.path("a.csv")),
            "t,n,status\n0.1,3,converged\n0.3333333333333333,-1,\"a, \"\"b\"\"\"\n");
}

TEST(CsvWriter, FlushedRowsCanBeRead) {
  const test::TempFolder folder;
  CsvWriter csv(folder.path("a.csv"), {"t"});
  csv << 1;
  csv.endRow();
  csv.flush();
  EXPECT_EQ(test::fileBytes(folder.path("a.csv")), "t\n1\n");
}

TEST(CsvWriter, RowsAreAsLongAsTheHeader) {
  const test::TempFolder folder;
  CsvWriter csv(folder.path("a.csv"), {"t", "x"});
  csv << 1;
  EXPECT_THROW(csv.endRow(), std::logic_error);
}

TEST(CsvWriter, RefusesWhereNothingCanBeWritten) {
  const test::TempFolder folder;
  EXPECT_THROW(CsvWriter(folder.path("no/such/folder.csv"), {"t"}), InputError);
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "needs /dev/full to imitate a disk without room; this system has none";
  CsvWriter csv("/dev/full", {"t"});
  EXPECT_THROW(csv.flush(), InputError);
}

}  // namespace
}  // namespace palpate::io::csv_writer_test
