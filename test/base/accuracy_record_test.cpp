// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/accuracy_record.h"

#include <gtest/gtest-spi.h>
#include <stdlib.h>  // setenv: POSIX

#include <limits>

#include "support/temp_folder.h"

namespace palpate::test::accuracy_record_test {
namespace {

const AccuracyRow kRow{"a \"bar\"", "one element", "anp", "force [N]", 1.01,
                       1.0,         "closed form", 0.01,  0.02};

TEST(AccuracyRecord, IsALineOfJsonWithAllDigits) {
  EXPECT_EQ(accuracyLine(kRow),
            "{\"case\": \"a \\\"bar\\\"\", \"mesh\": \"one element\", \"element\": \"anp\", "
            "\"quantity\": \"force [N]\", \"value\": 1.01, \"reference\": 1, \"source\": "
            "\"closed form\", \"error\": 0.01, \"bound\": 0.02}\n");
  AccuracyRow row = kRow;
  row.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(accuracyLine(row).find("\"value\": null"), std::string::npos);
}

TEST(AccuracyRecord, AppendsToTheNamedFileOnly) {
  const TempFolder folder;
  const std::string file = folder.path("rows.jsonl");
  unsetenv("PALPATE_ACCURACY_OUT");
  recordAccuracy(kRow);
  setenv("PALPATE_ACCURACY_OUT", file.c_str(), 1);
  recordAccuracy(kRow);
  recordAccuracy(kRow);
  unsetenv("PALPATE_ACCURACY_OUT");
  EXPECT_EQ(fileBytes(file), accuracyLine(kRow) + accuracyLine(kRow));
}

TEST(AccuracyRecord, FailsTheTestBeyondTheBound) {
  unsetenv("PALPATE_ACCURACY_OUT");
  AccuracyRow row = kRow;
  row.error = 0.03;
  EXPECT_NONFATAL_FAILURE(recordAccuracy(row), "instead of");
  row.error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NONFATAL_FAILURE(recordAccuracy(row), "instead of");
}

}  // namespace
}  // namespace palpate::test::accuracy_record_test
