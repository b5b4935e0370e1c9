// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_method.h"

#include "palpate/solver/pcg_or_factor.h"
#include "tissue/body/rest_matrix.h"

namespace palpate::tissue {

ImplicitMethod::ImplicitMethod(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer)
    : motion_(body), bodies_(&motion_), steps_(&bodies_, std::move(minimizer)) {
  solver::Minimizer& own = steps_.minimizer();
  if (auto* linear = dynamic_cast<solver::PcgOrFactor*>(own.linear())) motion_.pcg = linear->pcg();
  if (!own.learnsFromRest(body->settings.lasting)) return;
  own.learnFromRest([&](fem::Stiffness* A) { assembleAtRest(body, A); });
}

void ImplicitMethod::restart() {
  steps_.forget();
  motion_.restart();
}

void ImplicitMethod::goOnFrom(const StepMethod& old, const mesh::MeshChange& change) {
  motion_.goOnFrom(dynamic_cast<const ImplicitMethod&>(old).motion_, change);
  steps_.forgetCycle();
}

void ImplicitMethod::save(StateWriter* out) const {
  motion_.save(out);
  steps_.save(out);
}

void ImplicitMethod::restore(StateReader* in) {
  motion_.restore(in);
  steps_.restore(in);
}

}  // namespace palpate::tissue
