// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <variant>

#include "palpate/material/corotational.h"
#include "palpate/material/demiray.h"
#include "palpate/material/guccione.h"
#include "palpate/material/holzapfel_gasser_ogden.h"
#include "palpate/material/holzapfel_ogden.h"
#include "palpate/material/linear.h"
#include "palpate/material/material.h"
#include "palpate/material/mooney_rivlin.h"
#include "palpate/material/neo_hookean.h"
#include "palpate/material/ogden.h"
#include "palpate/material/st_venant_kirchhoff.h"
#include "palpate/material/stable_neo_hookean.h"
#include "palpate/material/veronda_westmann.h"
#include "palpate/material/yeoh.h"

namespace palpate::material {

/// All material laws. To add one: write its header, include it above, list it here. Name lookup,
/// dispatch in the assembly, documentation and property tests read this list. Compiling the laws
/// takes seconds: include this only for a law's own type.
///
/// A law is a value type that derives from FiniteStrainLaw (law.h) and has
///     static constexpr std::string_view kName;            its name in files
///     static std::vector<std::string> constantNames();    what its constructor reads
///     static Constants example();                         constants of some tissue, for tests
///     explicit Law(const Constants&);                     throws std::invalid_argument
///     Moduli moduli() const;                              at rest (of the matrix between fibres)
///     double distortionalEnergy(const Mat3& F) const;     psi - kappa/2 theta^2 [J/m^3]
///     Mat3 distortionalStress(const Mat3& F) const;       its derivative by F [Pa]
///     Mat9 distortionalTangent(const Mat3& F) const;      its second one, by vec F, symmetric [Pa]
using LawList = std::variant<StVenantKirchhoff, NeoHookean, StableNeoHookean, Linear, Corotational,
                             MooneyRivlin, Yeoh, VerondaWestmann, Demiray, Ogden,
                             HolzapfelGasserOgden, Guccione, HolzapfelOgden>;

/// Content of a Material.
struct ListedLaw {
  LawList law;
};

/// Calls `visitor` with the law in its own type.
template <class Visitor>
decltype(auto) visitLaw(Visitor&& visitor, const Material& material) {
  return std::visit(std::forward<Visitor>(visitor), material.listed().law);
}

/// The law as a `Law`; null for another law.
template <class Law>
const Law* lawIf(const Material& material) {
  return std::get_if<Law>(&material.listed().law);
}

}  // namespace palpate::material
