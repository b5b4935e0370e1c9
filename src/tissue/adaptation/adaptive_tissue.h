// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/tissue/adapt_settings.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "tissue/organ/organ_bodies.h"

namespace palpate::tissue {

/// As makeFemTissue(), with mesh adaptation: mesh::NestedMesh with the edge length
///
///   finest + growth max(0, d - kFineDistance finest)   at the distance d from the nearest tool.
///
/// The next mesh and its solver are made for predicted tool poses by a background task of `pool`,
/// and used kBackgroundTime after the request. mesh::MeshChange transfers fields: positions and
/// integrator history by interpolation, velocities with conserved momentum, viscous memory by
/// volume, contact state where its sample stays.
/// @throws as makeFemTissue(), and std::invalid_argument for 10-node tetrahedra with bent edges or
/// a method with precomputation on the mesh.
std::unique_ptr<OrganBodies> makeAdaptiveTissue(const mesh::TetMesh& mesh,
                                                const fem::Composition& composition,
                                                const Surroundings& surroundings,
                                                const FemSettings& settings,
                                                const AdaptSettings& adapt,
                                                ThreadPool* pool = nullptr);

/// Distance from a tool with edges of `finest`, in units of `finest` [-]. A wider zone costs more
/// than shorter edges of the same error: docs/meshes.md.
constexpr double kFineDistance = 1.0;
/// Tool displacement that requests a new mesh, in units of `finest` [-].
constexpr double kMinToolMotion = 1.0;
/// Largest predicted tool displacement, in units of `finest` [-].
constexpr double kMaxLookAhead = 2.5;
/// Simulated time from the request of a mesh to its use [s], and the least number of cycles.
constexpr double kBackgroundTime = 0.04;
constexpr int kMinBackgroundCycles = 2;
/// Prediction time of the tool poses [s]; less than kBackgroundTime, because hands turn back.
constexpr double kLookAheadTime = 0.03;
/// Most tetrahedra that one change bisects, without closure; more than a hand at 0.1 m/s requires.
/// The rest is requested again.
constexpr int kMaxBisections = 500;

}  // namespace palpate::tissue
