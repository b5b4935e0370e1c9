// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/state_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/base/types.h"
#include "support/heap_peak.h"

namespace palpate {
namespace {

std::string written() {
  StateWriter out;
  out.put(3);
  out.put(-0.0);
  out.put(Points(Points::Random(3, 5)));
  out.put(std::string("a\0b", 3));
  out.put(std::vector<double>{1.0, std::numeric_limits<double>::infinity()});
  return out.bytes();
}

void read(std::string_view bytes) {
  StateReader in(bytes);
  int i = 0;
  double d = 1.0;
  Points p;
  std::string s;
  std::vector<double> v;
  in.get(&i);
  in.get(&d);
  in.get(&p);
  in.get(&s);
  in.get(&v);
  in.finish();
  EXPECT_EQ(i, 3);
  EXPECT_TRUE(d == 0.0 && std::signbit(d));
  EXPECT_EQ(p.cols(), 5);
  EXPECT_EQ(s, std::string("a\0b", 3));
  EXPECT_EQ(v.size(), 2u);
}

TEST(StateBytes, GiveBackWhatWasPut) { read(written()); }

TEST(StateBytes, CutOffAnywhereAreRefused) {
  const std::string bytes = written();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_THROW(read(std::string_view(bytes).substr(0, n)), std::invalid_argument) << n;
  }
}

TEST(StateBytes, LongerThanReadAreRefused) {
  EXPECT_THROW(read(written() + "x"), std::invalid_argument);
}

TEST(StateBytes, OfAnotherSizeThanIsThereAreRefusedAndLeaveItAsItWas) {
  StateWriter out;
  out.put(Points(Points::Random(3, 5)));
  const Points four = Points::Random(3, 4);
  Points p = four;
  StateReader in(out.bytes());
  EXPECT_THROW(in.getSame(&p), std::invalid_argument);
  EXPECT_EQ(p, four);
  p = Points::Zero(3, 5);
  StateReader again(out.bytes());
  again.getSame(&p);
  again.finish();
  EXPECT_GT(p.norm(), 0.0);
}

TEST(StateBytes, HugeCountsAllocateNothing) {
  StateWriter out;
  out.put(std::numeric_limits<std::int64_t>::max());
  out.put(std::numeric_limits<std::int64_t>::max());
  std::vector<double> v;
  Points p;
  EXPECT_THROW(StateReader(out.bytes()).get(&v), std::invalid_argument);
  EXPECT_THROW(StateReader(out.bytes()).get(&p), std::invalid_argument);
}

// As many as there are bytes left, of things that take more.
TEST(StateBytes, CountsThatCannotBeAllocateLittle) {
  StateWriter out;
  out.put(std::int64_t{1000000});
  const std::string bytes = out.bytes() + std::string(1000000, '\0');
  std::vector<std::string> texts;
  std::vector<std::vector<double>> lists;
  std::vector<double> numbers;
  const test::HeapPeak heap;
  EXPECT_THROW(StateReader(bytes).get(&texts), std::invalid_argument);
  EXPECT_THROW(StateReader(bytes).get(&lists), std::invalid_argument);
  EXPECT_THROW(StateReader(bytes).get(&numbers), std::invalid_argument);
  EXPECT_LT(heap.bytes(), 100000U);
}

TEST(StateBytes, TruthIsZeroOrOne) {
  bool value = false;
  StateReader("\1").get(&value);
  EXPECT_TRUE(value);
  EXPECT_THROW(StateReader("\2").get(&value), std::invalid_argument);
  EXPECT_THROW(StateReader("\xFF").get(&value), std::invalid_argument);
}

TEST(StateBytes, MatricesOfAnotherHeightAreRefused) {
  StateWriter out;
  out.put(Eigen::VectorXd(Eigen::VectorXd::Ones(4)));
  Points p;
  EXPECT_THROW(StateReader(out.bytes()).get(&p), std::invalid_argument);
}

}  // namespace
}  // namespace palpate
