// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "palpate/fem/elasticity.h"

namespace palpate::micro {

/// A gel cube of 100 mm and n^3 cells of six tetrahedra, bent and pressed by some ten per cent.
struct Body {
  Body(int n, const std::string& element, const std::string& law, ThreadPool* pool = nullptr,
       const std::vector<material::PronyTerm>& prony = {});

  mesh::TetMesh mesh;
  std::unique_ptr<fem::Elasticity> elasticity;
  Points x;  ///< Deformed, 3 x nodes [m].
};

/// Of a step of 10 ms: stiffness at `x` plus mass/h^2 on the diagonal.
fem::Stiffness stepMatrix(const Body& body);

/// Nodal forces that push a patch of the top, 3 x nodes [N].
Points pushOnTop(const Body& body);

/// Time a tetrahedron, "per_tet" [s].
void countTets(benchmark::State& state, const Body& body);

}  // namespace palpate::micro
