// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/number.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <locale>
#include <random>
#include <string>

namespace palpate::number_test {
namespace {

TEST(ParseNumber, ReadsWholeDecimals) {
  EXPECT_EQ(parseNumber("1.5").value(), 1.5);
  EXPECT_EQ(parseNumber("-2e-3").value(), -2e-3);
  EXPECT_EQ(parseNumber("+7").value(), 7.0);
  EXPECT_EQ(parseNumber(".5").value(), 0.5);
}

TEST(ParseNumber, RefusesWhatIsNoFiniteDecimal) {
  for (const char* text : {"", " 1", "1 ", "1,5", "nan", ".nan", "inf", "-inf", "0x10", "1e999",
                           "1.2.3", "e", "-", "--1", "1e", "infinity", "1_000"}) {
    EXPECT_FALSE(parseNumber(text)) << text;
  }
}

TEST(ParseAnyNumber, ReadsWhatStrtodReads) {
  EXPECT_EQ(parseAnyNumber("1.5").value(), 1.5);
  EXPECT_EQ(parseAnyNumber("-inf").value(), -INFINITY);
  EXPECT_EQ(parseAnyNumber("1e999").value(), INFINITY);
  EXPECT_EQ(parseAnyNumber("0x10").value(), 16.0);
  EXPECT_TRUE(std::isnan(parseAnyNumber("nan").value()));
  for (const char* text : {"", "1 ", "1,5", "1.2.3", "e", "-", "--1", "1e", "1_000"}) {
    EXPECT_FALSE(parseAnyNumber(text)) << text;
  }
}

TEST(ParseAnyNumber, ReadsAPartOfATextAndNumbersOfAnyLength) {
  const std::string text = "12345";
  EXPECT_EQ(parseAnyNumber(std::string_view(text).substr(1, 2)).value(), 23.0);
  for (const std::size_t zeros : {61u, 62u, 63u, 64u, 65u, 300u}) {
    EXPECT_EQ(parseAnyNumber("." + std::string(zeros, '0') + "5"),
              parseAnyNumber("5e-" + std::to_string(zeros + 1)));
    EXPECT_EQ(parseNumber("." + std::string(zeros, '0') + "5x"), std::nullopt);
  }
  EXPECT_FALSE(parseAnyNumber(std::string_view("1\0", 2)));
}

TEST(FormatNumber, IsShort) {
  EXPECT_EQ(formatNumber(0.1), "0.1");
  EXPECT_EQ(formatNumber(-9.81), "-9.81");
  EXPECT_EQ(formatNumber(5e-4), "0.0005");
  EXPECT_EQ(formatNumber(std::nan("")), "nan");
  EXPECT_EQ(formatNumber(-INFINITY), "-inf");
}

TEST(FormatNumber, ComesBackBitForBit) {
  std::mt19937_64 rng(20240229);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = rng();
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(parseNumber(formatNumber(value)).value_or(0.0), value);
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(parseNumber(formatNumber(tiny)).value(), tiny);
  EXPECT_TRUE(std::signbit(parseNumber(formatNumber(-0.0)).value()));
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(FormatNumber, DoesNotFollowTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPoint));
  const std::string text = formatNumber(1234.5);
  const double value = parseNumber("0.5").value_or(-1.0);
  std::locale::global(before);
  EXPECT_EQ(text, "1234.5");
  EXPECT_EQ(value, 0.5);
  // The C library's locale as well, where the machine has one with a comma.
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8")) return;
  EXPECT_EQ(formatNumber(1234.5), "1234.5");
  EXPECT_EQ(parseNumber("0.5").value_or(-1.0), 0.5);
  std::setlocale(LC_NUMERIC, "C");
}

}  // namespace
}  // namespace palpate::number_test
