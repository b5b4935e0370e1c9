// SPDX-License-Identifier: GPL-3.0-or-later
// The program prints rounding() and a hash of answers of the C library where it is asked to.
#include "palpate/base/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>
#include <string_view>

#include "palpate/base/content_hash.h"
#include "support/own_program.h"

namespace palpate {
namespace {

constexpr char kPrintRounding[] = "--print-rounding", kPrintAnswers[] = "--print-answers";

// Of many arguments: variants of a function answer alike to 499 of 500.
std::uint64_t answers() {
  ContentHash hash(0);
  for (int k = 1; k <= 20000; ++k) {
    const double x = 4.7e-5 * k;
    for (const double y : {std::exp(x), std::log(x), std::pow(x, 1.7), std::sin(x), std::asin(x),
                           std::atan(x), std::tan(x), std::expm1(x)}) {
      hash.add(&y, sizeof y);
    }
  }
  return hash.value();
}

TEST(Rounding, IsTheSameInEveryProcessOfOneKind) {
  const std::string own = test::runThisProgram(test::kOwnKernels, kPrintRounding);
  EXPECT_FALSE(own.empty());
  EXPECT_EQ(test::runThisProgram(test::kOwnKernels, kPrintRounding), own);
  EXPECT_EQ(test::runThisProgram("", kPrintRounding), rounding());
}

TEST(Rounding, IsAnotherWhereTheCLibraryAnswersOtherwise) {
  if (test::runThisProgram(test::kOwnKernels, kPrintAnswers) ==
      test::runThisProgram(test::kOldestKernels, kPrintAnswers)) {
    GTEST_SKIP() << "the C library of this machine has one variant of its functions";
  }
  EXPECT_NE(test::runThisProgram(test::kOwnKernels, kPrintRounding),
            test::runThisProgram(test::kOldestKernels, kPrintRounding));
}

}  // namespace
}  // namespace palpate

int main(int argc, char** argv) {
  const std::string_view asked = argc == 2 ? argv[1] : "";
  if (asked == palpate::kPrintRounding) {
    std::cout << palpate::rounding();
    return 0;
  }
  if (asked == palpate::kPrintAnswers) {
    std::cout << palpate::answers();
    return 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
