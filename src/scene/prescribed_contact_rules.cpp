// SPDX-License-Identifier: GPL-3.0-or-later
#include "prescribed_contact_rules.h"

#include <algorithm>
#include <variant>

#include "palpate/base/error.h"
#include "palpate/contact/contact_models.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::scene {
namespace {

std::vector<std::string> prescribingMethods() {
  std::vector<std::string> names;
  for (const std::string& name : tissue::methodNames()) {
    if (tissue::methodFacts(name).prescribes) names.push_back(name);
  }
  return names;
}

bool rubs(const FrictionConfig& friction) {
  return friction.any() || std::any_of(friction.pairs.begin(), friction.pairs.end(),
                                       [](const FrictionPairConfig& pair) { return pair.any(); });
}

// A refused setting and its key.
struct Refused {
  std::string key, text;
};

std::vector<Refused> refusedOf(const Scene& scene) {
  const std::string of = "contact.model prescribed takes ";
  std::vector<Refused> refused;
  const std::vector<std::string> methods = prescribingMethods();
  if (std::count(methods.begin(), methods.end(), scene.solver.method) == 0) {
    refused.push_back({"solver.method", scene.solver.method + ": " + of + joinNames(methods)});
  }
  if (scene.organs.size() > 1) {
    refused.push_back({"organs[1].name", scene.organs[1].name + ": " + of + "one organ"});
  }
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    const OrganConfig& organ = scene.organs[i];
    const std::string key = "organs[" + std::to_string(i) + "].";
    if (organ.model != "fem") {
      refused.push_back({key + "model", organ.model + ": " + of + "fem"});
    } else if (organ.element != "tet4" && organ.element != "anp") {
      refused.push_back({key + "element", organ.element + ": " + of + "tet4, anp"});
    }
    if (organ.adapt.on()) {
      refused.push_back({key + "adapt.finest", std::to_string(organ.adapt.finest) + ": " + of +
                                                   "a mesh that stays as it is: 0"});
    }
  }
  if (scene.instruments.size() > 1) {
    refused.push_back(
        {"instruments[1].name", scene.instruments[1].name + ": " + of + "one instrument"});
  }
  for (std::size_t i = 0; i < scene.instruments.size(); ++i) {
    const std::string& link = scene.instruments[i].needle.link;
    if (link.empty()) continue;
    refused.push_back({"instruments[" + std::to_string(i) + "].needle.link",
                       link + ": " + of + "no needle; leave it out"});
  }
  if (!scene.anatomy.empty()) {
    refused.push_back(
        {"anatomy[0].name", scene.anatomy[0].name + ": " + of + "no anatomy; leave it out"});
  }
  if (rubs(scene.contact.friction)) {
    refused.push_back({"contact.friction", of + "no friction: what is held sticks; leave it out"});
  }
  return refused;
}

}  // namespace

void checkPrescribedContact(keys::FieldVisitor& v, const Scene& scene) {
  v.rule(true, "contact.model",
         "contact.model prescribed takes method `newton_bicgstab`, one organ of model `fem` and "
         "element `tet4` or `anp` whose mesh does not adapt, one instrument with one collision "
         "shape, a cylinder, and neither anatomy, needles nor friction");
  if (!contact::isPrescribed(scene.contact)) return;
  for (const Refused& refused : refusedOf(scene)) v.rule(false, refused.key, refused.text);
}

void checkSegments(const Scene& scene, const SceneParts& parts) {
  if (!contact::isPrescribed(scene.contact)) return;
  for (std::size_t i = 0; i < parts.instruments.size(); ++i) {
    const std::vector<instrument::CollisionBody>& bodies = parts.instruments[i].bodies();
    const bool one = bodies.size() == 1;
    if (one && std::holds_alternative<instrument::Capsule>(bodies[0].geometry)) continue;
    if (one && std::holds_alternative<instrument::Cylinder>(bodies[0].geometry)) continue;
    std::vector<std::string> names;
    names.reserve(bodies.size());
    for (const instrument::CollisionBody& body : bodies) names.push_back(body.name);
    throw InputError(scene.file, "instruments[" + std::to_string(i) + "].urdf",
                     scene.instruments[i].urdf,
                     "has the collision shapes " + joinNames(names) +
                         "; with contact.model prescribed a tool must be one cylinder, whose axis "
                         "is the segment that touches");
  }
}

}  // namespace palpate::scene
