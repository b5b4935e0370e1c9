// SPDX-License-Identifier: GPL-3.0-or-later
#include "tled_or_implicit.h"

#include <utility>

namespace palpate::tissue {

TledOrImplicit::TledOrImplicit(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer)
    : body_(*body), explicit_(body), implicit_(body, std::move(minimizer)) {}

bool TledOrImplicit::advance(double dt, TissueStep* out) {
  failed_ = false;
  if (!implicit_active_ && explicit_.overran()) switchToImplicit();
  if (!implicit_active_) {
    if (explicit_.advance(dt, out)) return true;
    if (!body_.v.allFinite()) return false;
    if (solver::isInterrupted(body_.interrupt)) {
      out->status = solver::SolveStatus::kDeadline;  // without an attempt of implicit steps
      return false;
    }
    switchToImplicit();
  }
  out->recover(Recovery::kShorterSteps);
  failed_ = !implicit_.advance(dt, out);
  return !failed_;
}

void TledOrImplicit::switchToImplicit() {
  implicit_active_ = true;
  implicit_.restart();
}

void TledOrImplicit::restart() {
  implicit_active_ = failed_ = false;
  explicit_.restart();
}

// Returns to explicit steps at rest, unless the last cycle failed.
void TledOrImplicit::stop() {
  if (!implicit_active_) return explicit_.stop();
  if (failed_) return implicit_.stop();
  body_.guard.setActive(false);
  restart();
}

void TledOrImplicit::save(StateWriter* out) const {
  out->put(implicit_active_);
  out->put(failed_);
  explicit_.save(out);
  if (implicit_active_) implicit_.save(out);
}

void TledOrImplicit::restore(StateReader* in) {
  in->get(&implicit_active_);
  in->get(&failed_);
  explicit_.restore(in);
  if (implicit_active_) implicit_.restore(in);
}

}  // namespace palpate::tissue
