// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/material/constants.h"

namespace palpate::material {

struct ListedLaw;  // defined in law_list.h

/// An immutable law of law_list.h with its constants; copies share it.
class Material {
 public:
  explicit Material(ListedLaw law);
  const ListedLaw& listed() const { return *law_; }

 private:
  std::shared_ptr<const ListedLaw> law_;
};

/// Names of all laws, in the order of the list.
std::vector<std::string> materialNames();

/// Names of the constants of law `name`; empty for an unknown law.
std::vector<std::string> constantNames(const std::string& name);

/// @throws std::invalid_argument for an unknown law (with the nearest known name), an unknown
/// constant, or constants that the law refuses.
Material makeMaterial(const std::string& name, const Constants& constants);

/// Law::example(); empty for an unknown name.
Constants exampleConstants(const std::string& name);

/// Name of the law in files.
std::string lawName(const Material& material);

/// Whether the law needs fibre directions.
bool needsFibres(const Material& material);

/// Whether psi(R F) = psi(F) for every rotation R; false for laws of small rotations.
bool isFrameIndifferent(const Material& material);

/// Moduli of the law at rest.
Moduli moduli(const Material& material);

}  // namespace palpate::material
