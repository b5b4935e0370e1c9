// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::tissue {

/// As makeFemTissue(), but where no node connects the parts of `mesh`, each of them is solved, and
/// sleeps, on its own; in reports, positions() and so on they are one body. Residual and tolerance
/// are root sums of squares, so that they bound the same norm as those of one piece. With
/// `settings.skip.islands` off, or where there is one part, it is makeFemTissue().
/// @throws as makeFemTissue(); the message says which part.
std::unique_ptr<TissueModel> makeIslands(const mesh::TetMesh& mesh,
                                         const fem::Composition& composition,
                                         const Surroundings& surroundings,
                                         const FemSettings& settings, ThreadPool* pool = nullptr);

}  // namespace palpate::tissue
