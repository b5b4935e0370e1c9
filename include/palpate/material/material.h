// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "palpate/material/constants.h"
#include "palpate/material/corotational.h"
#include "palpate/material/demiray.h"
#include "palpate/material/guccione.h"
#include "palpate/material/holzapfel_gasser_ogden.h"
#include "palpate/material/holzapfel_ogden.h"
#include "palpate/material/linear.h"
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
/// list.
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
using Material = std::variant<StVenantKirchhoff, NeoHookean, StableNeoHookean, Linear, Corotational,
                              MooneyRivlin, Yeoh, VerondaWestmann, Demiray, Ogden,
                              HolzapfelGasserOgden, Guccione, HolzapfelOgden>;

/// The names in the list, in its order.
std::vector<std::string> materialNames();

/// The constants that the law `name` reads; empty for an unknown name.
std::vector<std::string> constantNames(const std::string& name);

/// @throws std::invalid_argument for an unknown law (with the nearest known one), an unknown
/// constant, or what the law's constructor refuses.
Material makeMaterial(const std::string& name, const Constants& constants);

/// The law's Law::example(); empty for an unknown name.
Constants exampleConstants(const std::string& name);

/// Whether the law needs fibre directions.
bool needsFibres(const Material& material);

/// Moduli of the law at rest.
Moduli moduli(const Material& material);

}  // namespace palpate::material
