// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_displacements.h"

#include "palpate/contact/contact_models.h"
#include "prescribed_contact.h"
#include "segment_contact.h"

namespace palpate::tissue {

double PrescribedDisplacements::unbalanced(const Points& gradient) const {
  return gradient.cwiseProduct(free()).norm();
}

std::unique_ptr<PrescribedDisplacements> makePrescribedDisplacements(FemBody* body) {
  if (contact::isPrescribed(body->settings.contact)) return std::make_unique<SegmentContact>(body);
  return std::make_unique<PrescribedContact>(body);
}

}  // namespace palpate::tissue
