// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/material/constants.h"

namespace palpate::material {

struct ListedLaw;  // law_list.h, which has the laws themselves

/// A law of the list in law_list.h, with its constants. They never change, and copies share them.
class Material {
 public:
  explicit Material(ListedLaw law);
  const ListedLaw& listed() const { return *law_; }

 private:
  std::shared_ptr<const ListedLaw> law_;
};

/// The names in the list, in its order.
std::vector<std::string> materialNames();

/// The constants that the law `name` reads; empty for an unknown name.
std::vector<std::string> constantNames(const std::string& name);

/// @throws std::invalid_argument for an unknown law (with the nearest known one), an unknown
/// constant, or what the law's constructor refuses.
Material makeMaterial(const std::string& name, const Constants& constants);

/// The law's Law::example(); empty for an unknown name.
Constants exampleConstants(const std::string& name);

/// The law's name in files.
std::string lawName(const Material& material);

/// Whether the law needs fibre directions.
bool needsFibres(const Material& material);

/// psi(R F) = psi(F) for every rotation R: the law is not for small rotations only.
bool isFrameIndifferent(const Material& material);

/// Moduli of the law at rest.
Moduli moduli(const Material& material);

}  // namespace palpate::material
