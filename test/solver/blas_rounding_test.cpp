// SPDX-License-Identifier: GPL-3.0-or-later
// The program prints blasRounding() or a hash of a product where it is asked to.
#include "palpate/solver/blas_rounding.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string>
#include <string_view>

#include "palpate/base/content_hash.h"
#include "support/contains.h"
#include "support/own_program.h"

namespace palpate::solver {
namespace {

constexpr char kPrintRounding[] = "--print-rounding", kPrintProduct[] = "--print-product";

TEST(BlasRounding, IsTheSameInEveryProcessOfOneKind) {
  const std::string own = test::runThisProgram(test::kOwnKernels, kPrintRounding);
  EXPECT_TRUE(test::contains(own, "CHOLMOD")) << own;
  EXPECT_EQ(test::runThisProgram(test::kOwnKernels, kPrintRounding), own);
  EXPECT_EQ(test::runThisProgram("", kPrintRounding), blasRounding());
}

TEST(BlasRounding, IsAnotherWhereTheBlasAnswersOtherwise) {
  if (test::runThisProgram(test::kOwnKernels, kPrintProduct) ==
      test::runThisProgram(test::kOldestKernels, kPrintProduct)) {
    GTEST_SKIP() << "the BLAS of this machine has one variant of its kernels";
  }
  EXPECT_NE(test::runThisProgram(test::kOwnKernels, kPrintRounding),
            test::runThisProgram(test::kOldestKernels, kPrintRounding));
}

// Threads cut a factorisation into other parts.
TEST(BlasRounding, IsAnotherWithMoreThreads) {
  const std::string one = test::runThisProgram("OPENBLAS_NUM_THREADS=1", kPrintRounding);
  if (!test::contains(one, "1 threads")) GTEST_SKIP() << "this BLAS says no threads: " << one;
  const std::string two = test::runThisProgram("OPENBLAS_NUM_THREADS=2", kPrintRounding);
  if (test::contains(two, "1 threads")) GTEST_SKIP() << "this BLAS has one thread: " << two;
  EXPECT_NE(one, two);
}

}  // namespace
}  // namespace palpate::solver

int main(int argc, char** argv) {
  using namespace palpate;
  const std::string_view asked = argc == 2 ? argv[1] : "";
  if (asked == solver::kPrintRounding) {
    std::cout << solver::blasRounding();
    return 0;
  }
  if (asked == solver::kPrintProduct) {
    const std::vector<double> product = solver::blasProduct();
    ContentHash hash(0);
    hash.add(product.data(), sizeof(double) * product.size());
    std::cout << hash.value();
    return 0;
  }
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
