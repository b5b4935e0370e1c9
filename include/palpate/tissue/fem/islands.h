// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::tissue {

/// As makeFemTissue(), but each island of `mesh` is solved and sleeps separately; reports and
/// positions() are those of the whole. Residual and tolerance are root sums of squares, so they
/// bound the norm of the whole. Equal to makeFemTissue() for one island or without
/// `settings.skip.islands`.
/// @throws as makeFemTissue(); the message names the island.
std::unique_ptr<TissueModel> makeIslands(const mesh::TetMesh& mesh,
                                         const fem::Composition& composition,
                                         const Surroundings& surroundings,
                                         const FemSettings& settings, ThreadPool* pool = nullptr);

}  // namespace palpate::tissue
