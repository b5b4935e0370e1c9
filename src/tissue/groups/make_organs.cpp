// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_organs.h"

#include <stdexcept>
#include <utility>

#include "fem_organs.h"
#include "palpate/base/error.h"

namespace palpate::tissue {

FemSettings settingsOf(const OrganDescription& organ, const ModelDescription& description) {
  FemSettings settings{description.settings};
  settings.contact.friction_with = organ.friction;
  settings.mass_damping = organ.damping.mass;
  settings.stiffness_damping = organ.damping.stiffness;
  return settings;
}

std::unique_ptr<TissueModel> makeOrgans(
    const ModelDescription& description,
    const std::function<std::unique_ptr<OrganBodies>(const OrganDescription&)>& make) {
  const ModelSettings& settings = description.settings;
  const bool acting = settings.touching.organs && !settings.interactions.empty();
  if (description.organs.size() == 1 && !acting) return make(description.organs.front());
  std::vector<NamedOrgan> organs;
  for (const OrganDescription& organ : description.organs) {
    const std::string of = description.organs.size() > 1 ? "organ " + organ.name + ": " : "";
    try {
      organs.push_back({organ.name, make(organ)});
    } catch (const InputError&) {
      throw;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(of + error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(of + error.what());
    }
  }
  return makeFemOrgans(std::move(organs), settings);
}

}  // namespace palpate::tissue
