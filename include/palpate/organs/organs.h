// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::organs {

/// Names of organs for makeOrgan(): liver, kidney, gallbladder, gallbladder_hollow, slab.
std::vector<std::string> organNames();

/// Surface of an adult organ in nearly uniform triangles with a mean edge of about `edge_length`
/// [m]; closed, outward, free of self-intersection. Deterministic.
///
/// z is up, the lowest point is at z = 0, and the bounding box is centred in x and y.
///
///     liver        0.22 x 0.15 x 0.09 m   right lobe at -x, inferior border at -y,
///                                         visceral side down
///     kidney       0.11 x 0.06 x 0.045 m  long axis along x, hilum at +y
///     gallbladder  0.09 x 0.04 x 0.035 m  fundus at -x, neck at +x
///     gallbladder_hollow              the same, a wall of 2.5 mm around a cavity: two shells
///     slab         0.10 x 0.10 x 0.03 m   a box; its edges are exact
///
/// @throws InputError if there is no such organ, or the edge length is not in
///   [kMinOrganEdge, maxOrganEdge(name)].
mesh::SurfaceMesh makeOrgan(const std::string& name, double edge_length);

constexpr double kMinOrganEdge = 1e-3;  ///< [m]

/// Longest edges that still resolve the organ's shape [m].
double maxOrganEdge(const std::string& name);

}  // namespace palpate::organs
