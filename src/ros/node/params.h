// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/scene/scene.h"
#include "ros/pictures/cutaway_config.h"
#include "ros/program/param_tree.h"

namespace palpate::node {

inline constexpr char kSceneParam[] = "scene";
inline constexpr char kInitialStateParam[] = "initial_state";
inline constexpr char kStateDirectoryParam[] = "state_directory";
inline constexpr char kSaveAtEndParam[] = "save_state_at_end";
inline constexpr char kArrowScaleParam[] = "arrow_scale";
inline constexpr char kPublishLinksParam[] = "publish_links";
inline constexpr const char* kNodeParams[] = {kSceneParam,          kInitialStateParam,
                                              kStateDirectoryParam, kSaveAtEndParam,
                                              kArrowScaleParam,     kPublishLinksParam};

/// What libraries read below the node's name: diagnostic_updater.
inline constexpr const char* kLibraryParams[] = {"diagnostic_period", "diagnostic_updater_use_fqn"};

/// Sections of the scene whose keys are parameters as well, and the list of which each item is.
inline constexpr const char* kSceneSections[] = {"contact", "solver", "rates", "haptics"};
inline constexpr char kInstrumentsSection[] = "instruments";

/// Where ROS keeps a user's files.
std::string rosHome();

/// Private parameters of the node that are not keys of the scene, with their defaults.
struct NodeParams {
  std::string scene;  ///< ~scene: a file, or the name of a shipped scene.
  std::string state_directory =
      rosHome() + "/palpate";     ///< ~state_directory: where ~save_state writes.
  bool save_state_at_end = true;  ///< ~save_state_at_end: there, too, over that of the last time.
  std::string initial_state;  ///< ~initial_state: a file of ~save_state to start from; "": rest.
  double arrow_scale = 0.0;   ///< ~arrow_scale: length of the wrench arrow [m/N]; 0: View's.
  bool publish_links = true;  ///< ~publish_links: tf and robot descriptions of the instruments.
  CutawayConfig cutaway;      ///< ~cutaway/...
};

void describe(keys::FieldVisitor& v, NodeParams& params);

/// @throws InputError naming the parameters.
NodeParams readParams(const ParamTree& params);

/// Reads the scene, then lets parameters replace single keys: ~contact/..., ~solver/...,
/// ~rates/..., ~haptics/... and ~instruments/<name>/... mean the scene's keys of that name.
/// @throws InputError for the file, or for all parameters that are unknown or out of range.
scene::Scene readScene(const std::string& file, const ParamTree& params);

}  // namespace palpate::node
