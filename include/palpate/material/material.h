// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "palpate/material/constants.h"
#include "palpate/material/neo_hookean.h"
#include "palpate/material/st_venant_kirchhoff.h"
#include "palpate/material/stable_neo_hookean.h"

namespace palpate::material {

/// Every material law. To add one: write its header, add it here. The name lookup, the dispatch in
/// the assembly, the documentation and the property tests all read this list.
///
/// A law is a value type with
///     static constexpr std::string_view kName;            its name in files
///     static std::vector<std::string> constantNames();    what its constructor reads
///     explicit Law(const Constants&);                     throws std::invalid_argument
///     Moduli moduli() const;                              at rest, for the Hooke limit
///     double energyDensity(const Mat3& F) const;          psi [J/m^3]
///     Mat3 firstPiolaKirchhoff(const Mat3& F) const;      P = d psi / d F [Pa]
///     Mat9 tangent(const Mat3& F) const;                  d vec P / d vec F [Pa], symmetric
using Material = std::variant<StVenantKirchhoff, NeoHookean, StableNeoHookean>;

/// The names in the list, in its order.
std::vector<std::string> materialNames();

/// The constants that the law `name` reads; empty for an unknown name.
std::vector<std::string> constantNames(const std::string& name);

/// @throws std::invalid_argument for an unknown law (with the nearest known one), an unknown
/// constant, or what the law's constructor refuses.
Material makeMaterial(const std::string& name, const Constants& constants);

/// Moduli of the law at rest.
Moduli moduli(const Material& material);

}  // namespace palpate::material
