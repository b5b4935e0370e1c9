// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/enrichment/press_plan.h"
#include "palpate/enrichment/pressed_body.h"
#include "palpate/mesh/size_field.h"

namespace palpate::models {

/// A body of [Bounik, Shamsi, Sedaaghi 2020]: its surfaces, with as many points as published, what
/// holds it, and how it is pressed. Corotational, 5 kPa, nu = 0.45.
struct EnrichedBody {
  std::string name;
  mesh::SurfaceMesh coarse, fine, true_surface;
  double held_below, held_above;  ///< Nodes up to this height and from that on are held [m].
  double fine_edge, coarse_edge;  ///< Of tetrahedra [m].
  double patch;                   ///< [m]
  enrichment::PressPlan plan;
  int train, test;
  std::vector<int> contacts;  ///< Coarse points well above what is held.
};

/// A round bar, 182 and 722 points, held at both ends.
EnrichedBody cylinderBody();
/// The package's liver, 140 and 2210 points, held at its bottom.
EnrichedBody liverBody();

mesh::TetMesh filled(const mesh::SurfaceMesh& surface, const mesh::SizeField& edge_length);

/// Of the body's material and supports. `surface`: where displacements are wanted.
std::unique_ptr<enrichment::PressedBody> pressedBody(const EnrichedBody& body, mesh::TetMesh mesh,
                                                     const Points& surface);

}  // namespace palpate::models
