// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem/force_excess.h"

#include <algorithm>
#include <cmath>

namespace palpate::tissue {
namespace {

// excess = factor ratio^power, least squares of the logarithms. Computed by the benchmark `graded`.
struct PowerLaw {
  const char* element;
  double factor, power;
};
constexpr PowerLaw kLaws[] = {{"anp", 0.34, 1.40},
                              {"tet4", 0.69, 1.12},
                              {"p1p1", 0.28, 1.39},
                              {"tet10", 0.09, 1.94},
                              {"tet10p", 0.07, 1.70}};

const PowerLaw* lawOf(const std::string& element) {
  const auto* const law = std::find_if(std::begin(kLaws), std::end(kLaws),
                                       [&](const PowerLaw& l) { return element == l.element; });
  return law == std::end(kLaws) ? nullptr : law;
}

}  // namespace

std::optional<double> forceExcess(const std::string& element, double ratio) {
  const PowerLaw* law = lawOf(element);
  if (law == nullptr) return {};
  return law->factor * std::pow(ratio, law->power);
}

std::optional<double> edgeRatioFor(const std::string& element, double excess) {
  const PowerLaw* law = lawOf(element);
  if (law == nullptr) return {};
  return std::pow(excess / law->factor, 1.0 / law->power);
}

}  // namespace palpate::tissue
