// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_learned.h"

#include <algorithm>

namespace palpate::torture {
namespace {

constexpr Eigen::Index kMostTets = 600;  // each press of a database solves for all

bool isPressed(const TortureScene& scene) {
  return scene.start == Start::kRest && scene.organs.size() == 1 && scene.category != "contrast" &&
         scene.category != "adapt";
}

bool canLearn(const TortureScene& scene) {
  const TortureOrgan& organ = scene.organs.front();
  return isPressed(scene) && organ.model == "fem" && organ.mesh.numTets() > 0 &&
         organ.mesh.numTets() <= kMostTets;
}

// Separate random streams, so that other scenes do not change.
Draw ownDraw(const TortureScene& scene, std::uint64_t which) {
  return {scene.seed ^ which, static_cast<std::uint64_t>(scene.number)};
}

}  // namespace

void drawLearning(TortureScene* scene) {
  Draw draw = ownDraw(*scene, 0x1ea24edULL);
  if (!draw.chance(0.2) || !canLearn(*scene)) return;
  TortureOrgan& organ = scene->organs.front();
  organ.adapt = organ.prony_g = 0.0;
  organ.model = draw.chance(0.5) ? "enriched" : "neural";
  if (organ.model == "enriched") return;
  organ.element = "anp";
  scene->friction = 0.0;
}

void drawPrescribed(TortureScene* scene) {
  Draw draw = ownDraw(*scene, 0x5e93e27ULL);
  TortureOrgan& organ = scene->organs.front();
  if (!draw.chance(0.3) || !isPressed(*scene) || scene->method != "newton_bicgstab" ||
      scene->bone || scene->tools.size() != 1 || organ.model != "fem") {
    return;
  }
  scene->contact = "prescribed";
  scene->friction = 0.0;
  organ.adapt = 0.0;
  if (organ.element != "tet4") organ.element = "anp";
  TortureTool& tool = scene->tools.front();
  const double length = std::max(0.005, tool.size.maxCoeff());
  tool.shape = "cylinder";
  tool.size = Vec3(std::min(0.001, tool.size.x()), 0.0, length);
}

void drawPenalty(TortureScene* scene) {
  Draw draw = ownDraw(*scene, 0x9e2a17fULL);
  if (draw.chance(0.15) && scene->contact != "prescribed") scene->contact = "penalty";
}

}  // namespace palpate::torture
