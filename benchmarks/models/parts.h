// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

// Each gives the figures of one part of docs/results/models.md as a JSON object; `quick`: of small
// versions. Lengths are in cm, forces in N, as in [Wang 2005],
// unless a part says otherwise.
namespace palpate::models {

/// Clamped beams under a force in the middle, over 192 E I/L^3 [Wang 2005, 5.2.3 and appendix A].
std::string beams(bool quick);
/// Boundary elements: the plate of [Castillo Leon 2011, ch. 5], and bodies with closed forms,
/// without units.
std::string boundary(bool quick);
/// What the ends of free beams and the edges of free sheets do (5.2.4, 5.3.3, appendix B).
std::string ends(bool quick);
/// Stretch and bending of infinite regular sheets in every direction (5.3.1).
std::string directions(bool quick);
/// 21 x 21 masses of a free sheet of triangles (4.3.4).
std::string freeSheet(bool quick);
/// Clamped discs under a force in the middle, over 16 pi D/a^2 (4.3.5, 5.3.4).
std::string discs(bool quick);
/// Cloth that hangs from two corners (4.4), with and without preload.
std::string hungCloth(bool quick);
/// Sheets that unroll: of 15 x 15 masses (4.4), and of polypropylene from a tube (6.4.2).
std::string unrolling(bool quick);
/// Square errors of straight lines for the ideal springs (4.2.2, 4.3.2).
std::string ideal(bool quick);
/// Fitted plates that are clamped at an end (6.4.1), and triangles to compute them otherwise.
std::string plates(bool quick);
/// Cubes and shafts in tension and torsion (7.4), and motions of lattices without energy.
std::string solids(bool quick);
/// Fine shapes from coarse ones after samples, on two bodies [Bounik, Shamsi, Sedaaghi 2020]; SI.
std::string enriched(bool quick);
/// Seconds to find where a tool meets surfaces, and to follow it [Castillo Leon 2011, 7.4].
std::string tracking(bool quick);

}  // namespace palpate::models
