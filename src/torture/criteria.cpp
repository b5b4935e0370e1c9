// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/criteria.h"

#include <cstdio>

#include "checks.h"

namespace palpate::torture {

std::vector<NamedCriterion> criteria(const TortureScene& scene, const sim::Simulator& simulator) {
  std::vector<NamedCriterion> all;
  all.push_back({"finite", checkFinite()});
  all.push_back({"bounded", checkBounded(scene)});
  all.push_back({"inverted", checkInverted(scene)});
  all.push_back({"truth", checkTruth(scene, simulator)});
  all.push_back({"wrench", checkWrench(scene, simulator)});
  all.push_back({"energy", checkEnergy(scene, simulator)});
  all.push_back({"rest", checkRest(scene, simulator)});
  all.push_back({"time", checkTime(scene)});
  return all;
}

std::vector<std::string> criterionNames() {
  return {"finite", "bounded", "inverted", "truth",    "wrench", "energy", "rest",
          "time",   "crash",   "cycle",    "deadline", "same",   "cut"};
}

std::string said(const char* what, double value, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %.3g%s%s", what, value, *unit ? " " : "", unit);
  return text;
}

}  // namespace palpate::torture
