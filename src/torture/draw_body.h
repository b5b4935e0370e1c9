// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Constants of a law that at small strains has this Young's modulus [Pa] and Poisson's ratio; of
/// one with fibres its matrix has.
material::Constants constantsOf(const std::string& law, double young, double poisson);

/// Of the same law, so many times as stiff.
material::Constants stiffened(material::Constants constants, double times);

/// Gives the organ a tissue model, an element and a law with its constants, and a density.
void drawBody(Draw* draw, TortureOrgan* organ);

/// Method and integrator that take all that the scene's organs have.
void drawMethod(Draw* draw, TortureScene* scene);

/// An angular frequency that the organ's slowest motion has at least [1/s], when it is held.
double slowestFrequency(const TortureOrgan& organ);

/// Damping after which the organ is at rest soon.
void drawDamping(Draw* draw, const TortureScene& scene, TortureOrgan* organ);

}  // namespace palpate::torture
