// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/instrument/instrument.h"
#include "palpate/scene/organ_loader.h"
#include "palpate/scene/scene.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::scene {

/// What a scene's files hold.
struct LoadedScene {
  std::unique_ptr<ThreadPool> pool;  // first: outlives the tissues
  std::vector<instrument::Instrument> instruments;
  std::vector<int> control_links;  ///< Link index of each instrument's control frame.
  std::vector<std::unique_ptr<tissue::TissueModel>> tissues;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  ///< What the tissues decided, with the organ's name.
};

/// @throws InputError
LoadedScene loadScene(const Scene& scene, const LoadProgress& progress);

}  // namespace palpate::scene
