// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_contact.h"

#include <algorithm>
#include <utility>

#include "palpate/contact/surface_contact.h"
#include "palpate/tissue/model_settings.h"

namespace palpate::tissue {
namespace {

using contact::ContactSurface;

class OrganContactTerm final : public InteractionTerm {
 public:
  OrganContactTerm(std::shared_ptr<const ContactSurface> a, std::shared_ptr<const ContactSurface> b,
                   const contact::Penalty& law)
      : contact_(std::move(a), std::move(b), law) {}

  void search(const Points& x, double way) override { contact_.search(x, way); }
  bool holds(const Points& x) const override { return contact_.holds(x); }
  double value(const Points& x) const override { return contact_.value(x); }
  double addGradient(const Points& x, Points* g) const override {
    return contact_.addGradient(x, g);
  }
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override {
    contact_.addHessian(x, tangent, K);
  }
  double maxStep(const Points& x, const Points& d) const override { return contact_.maxStep(x, d); }

 private:
  contact::SurfaceContact contact_;
};

class OrganContact final : public Interaction {
 public:
  OrganContact(const contact::Penalty& law, bool self) : law_(law), self_(self) {}

  bool possible(const InteractingBody& a, const InteractingBody& b) const override {
    return &a == &b ? self_ : boxesOverlap(a, b, 0.0);
  }
  std::unique_ptr<InteractionTerm> make(const InteractingBody& a,
                                        const InteractingBody& b) const override {
    std::shared_ptr<const ContactSurface> of_b;
    if (&a != &b) of_b = surface(b);
    return std::make_unique<OrganContactTerm>(surface(a), std::move(of_b), law_);
  }

 private:
  // Contact surfaces of bodies are cached.
  std::shared_ptr<const ContactSurface> surface(const InteractingBody& body) const {
    for (const std::shared_ptr<const ContactSurface>& known : known_) {
      if (contact::isOf(*known, body.X, body.triangles)) return known;
    }
    if (known_.size() >= kMostKept) {
      const auto unused = std::find_if(known_.begin(), known_.end(),
                                       [](const auto& known) { return known.use_count() == 1; });
      if (unused != known_.end()) known_.erase(unused);
    }
    known_.push_back(contact::makeContactSurface(body.X, body.triangles));
    return known_.back();
  }

  static constexpr std::size_t kMostKept = 32;
  contact::Penalty law_;
  bool self_;
  mutable std::vector<std::shared_ptr<const ContactSurface>>
      known_;  // cache without effect on results
};

}  // namespace

std::shared_ptr<const Interaction> makeOrganContact(const ModelSettings& settings) {
  return std::make_shared<OrganContact>(
      contact::Penalty{settings.contact.stiffness, settings.contact.smoothing},
      settings.touching.self);
}

}  // namespace palpate::tissue
