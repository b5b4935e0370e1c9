// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "organ_bodies.h"
#include "palpate/tissue/adapt_settings.h"
#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::tissue {

/// As makeFemTissue(), of a mesh that is refined where tools come near, before they touch, and
/// coarse again where they have left: mesh::NestedMesh with the size
///
///   finest + growth max(0, d - kFineDistance finest)   at the distance d from the nearest tool.
///
/// The next mesh, and all that is needed to solve on it, is made for where the tools go, beside the
/// cycle by a helper of `pool` where it has one, and taken into use kBackgroundTime after it was
/// asked for. Fields are carried over as mesh::MeshChange says: positions and the past of the
/// integrator by interpolation, velocities so that the momentum is kept, viscous memory by volume,
/// the memory of touches where its sample stays.
/// @throws as makeFemTissue(), and std::invalid_argument for 10-node tetrahedra with bent edges or
/// a method that precomputes what a change of the mesh would undo.
std::unique_ptr<OrganBodies> makeAdaptiveTissue(const mesh::TetMesh& mesh,
                                                const fem::Composition& composition,
                                                const Surroundings& surroundings,
                                                const FemSettings& settings,
                                                const AdaptSettings& adapt,
                                                ThreadPool* pool = nullptr);

/// Within this distance of a tool, in units of `finest`, tetrahedra are as fine as they get: room
/// for what a hand moves while the next mesh is made.
constexpr double kFineDistance = 2.5;
/// A tool that has gone less than this part of `finest` since a mesh was made for it need not be
/// looked at again.
constexpr double kMinToolMotion = 1.5;
/// The next mesh is taken into use so long after it was asked for [s], or so many cycles if that is
/// longer.
constexpr double kBackgroundTime = 0.04;
constexpr int kMinBackgroundCycles = 2;
/// It is made for where the tools are so much later if they go on as they do [s], within
/// kFineDistance: not for all of the time, because hands turn back.
constexpr double kLookAheadTime = 0.03;
/// Tetrahedra that one change bisects, but for those that follow from these; more than a hand that
/// moves 0.1 m/s asks for. What is left is asked for again.
constexpr int kMaxBisections = 500;

}  // namespace palpate::tissue
