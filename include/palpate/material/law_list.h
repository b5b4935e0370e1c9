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

/// Every material law. To add one: write its header, include it above, add it here. The name
/// lookup, the dispatch in the assembly, the documentation and the property tests all read this
/// list. Compiling the laws costs seconds: only who needs a law's own type includes this.
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

/// What a Material holds.
struct ListedLaw {
  LawList law;
};

/// Calls `visitor` with the law itself, in the type that it has in the list.
template <class Visitor>
decltype(auto) visitLaw(Visitor&& visitor, const Material& material) {
  return std::visit(std::forward<Visitor>(visitor), material.listed().law);
}

/// The material's law if it is a `Law`, else null.
template <class Law>
const Law* lawIf(const Material& material) {
  return std::get_if<Law>(&material.listed().law);
}

}  // namespace palpate::material
