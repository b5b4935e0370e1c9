// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/material/material.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/material/law_list.h"

namespace palpate::material {
namespace {

template <class Visitor, class... Laws>
void forEachLaw(Visitor&& visit, const std::variant<Laws...>*) {
  (visit(static_cast<const Laws*>(nullptr)), ...);
}

template <class Visitor>
void forEachLaw(Visitor&& visit) {
  forEachLaw(visit, static_cast<const LawList*>(nullptr));
}

template <class Law>
void refuseUnknownConstants(const Constants& constants) {
  const std::vector<std::string> known = Law::constantNames();
  for (const auto& [name, value] : constants) {
    if (std::count(known.begin(), known.end(), name)) continue;
    const std::string nearest = nearestName(name, known);
    throw std::invalid_argument(name + ": no constant of law " + std::string(Law::kName) +
                                (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                                "; it has " + joinNames(known));
  }
}

}  // namespace

Material::Material(ListedLaw law) : law_(std::make_shared<const ListedLaw>(std::move(law))) {}

std::vector<std::string> materialNames() {
  std::vector<std::string> names;
  forEachLaw([&](const auto* law) { names.emplace_back(std::decay_t<decltype(*law)>::kName); });
  return names;
}

std::vector<std::string> constantNames(const std::string& name) {
  std::vector<std::string> names;
  forEachLaw([&](const auto* law) {
    using Law = std::decay_t<decltype(*law)>;
    if (name == Law::kName) names = Law::constantNames();
  });
  return names;
}

Material makeMaterial(const std::string& name, const Constants& constants) {
  std::optional<Material> made;
  forEachLaw([&](const auto* law) {
    using Law = std::decay_t<decltype(*law)>;
    if (name != Law::kName) return;
    refuseUnknownConstants<Law>(constants);
    made.emplace(ListedLaw{Law(constants)});
  });
  if (made) return *made;
  const std::string nearest = nearestName(name, materialNames());
  throw std::invalid_argument("law = " + name + ": must be one of " + joinNames(materialNames()) +
                              (nearest.empty() ? "" : " (did you mean " + nearest + "?)"));
}

Constants exampleConstants(const std::string& name) {
  Constants constants;
  forEachLaw([&](const auto* law) {
    using Law = std::decay_t<decltype(*law)>;
    if (name == Law::kName) constants = Law::example();
  });
  return constants;
}

std::string lawName(const Material& material) {
  return visitLaw([](const auto& law) { return std::string(law.kName); }, material);
}

bool needsFibres(const Material& material) {
  return visitLaw([](const auto& law) { return std::decay_t<decltype(law)>::kNeedsFibres; },
                  material);
}

bool isFrameIndifferent(const Material& material) {
  return visitLaw([](const auto& law) { return std::decay_t<decltype(law)>::kFrameIndifferent; },
                  material);
}

Moduli moduli(const Material& material) {
  return visitLaw([](const auto& law) { return law.moduli(); }, material);
}

}  // namespace palpate::material
