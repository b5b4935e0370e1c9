// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Constants of a law with this Young's modulus [Pa] and Poisson's ratio at small strains; for laws
/// with fibres those of the matrix.
material::Constants constantsOf(const std::string& law, double young, double poisson);

/// Constants of the same law with `times` the stiffness.
material::Constants stiffened(material::Constants constants, double times);

/// Draws the organ's tissue model, element, law with constants, and density.
void drawBody(Draw* draw, TortureOrgan* organ);

/// Draws a method and integrator that support all organs of the scene.
void drawMethod(Draw* draw, TortureScene* scene);

/// Lower bound of the angular frequency of the held organ's slowest motion [1/s].
double slowestFrequency(const TortureOrgan& organ);

/// Draws damping that brings the organ to rest soon.
void drawDamping(Draw* draw, const TortureScene& scene, TortureOrgan* organ);

}  // namespace palpate::torture
