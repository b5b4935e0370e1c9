// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "draw_body.h"
#include "draw_learned.h"
#include "draw_mesh.h"
#include "draw_motion.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {
namespace {

constexpr double kG = 9.81;        // [m/s^2]
constexpr double kWeightOf = 0.1;  // bound of an organ's weight over its stiffness

// Mostly small: the largest take as long as a hundred others.
int drawSize(Draw* draw) {
  const double which = draw->between(0.0, 1.0);
  return static_cast<int>(draw->decades(50.0, which < 0.75 ? 1000.0 : which < 0.95 ? 5000.0 : 2e4));
}

// Limits the size by the model's cost.
int sizeFor(const TortureOrgan& organ, const std::string& method, int tets) {
  if (organ.model == "bem") return std::min(tets, 600);
  if (organ.model == "sampled_elasticity") return std::min(tets, 400);
  if (method == "newton_bicgstab") return std::min(tets, 800);
  if (method == "linear_precomputed") return std::min(tets, 3000);
  return tets;
}

TortureOrgan drawOrgan(const TortureScene& scene, Draw* draw) {
  TortureOrgan organ;
  organ.name = "organ";
  organ.size =
      Vec3(draw->between(0.03, 0.07), draw->between(0.03, 0.07), draw->between(0.02, 0.04));
  drawBody(draw, &organ);
  if (scene.category == "contrast") {
    organ.model = "fem";
    organ.young = draw->decades(1e2, 1e4);
    organ.constants = constantsOf(organ.law, organ.young, organ.poisson);
    organ.contrast = draw->decades(1e3, 1e6);
  }
  if (scene.category == "adapt" || scene.category == "start" || scene.category == "fall" ||
      scene.category == "sliver") {
    organ.model = "fem";
  }
  if (scene.category == "adapt") organ.adapt = draw->between(0.002, 0.005);
  return organ;
}

void drawMeshOf(const TortureScene& scene, Draw* draw, TortureOrgan* organ) {
  static const std::vector<std::string> kShapes = {"block", "block", "graded", "ball", "sliver"};
  const std::string shape = scene.category == "sliver" ? "sliver" : draw->oneOf(kShapes);
  const int tets = sizeFor(*organ, scene.method, drawSize(draw));
  const bool plain = scene.category == "press" || scene.category == "wander";
  if (plain && organ->model == "fem" && draw->chance(0.1)) {
    drawGeneratedOrgan(draw, organ);
  } else {
    drawMesh(organ->model == "honeycomb" || organ->model == "cloth" ? "block" : shape, tets, draw,
             organ);
  }
}

// Throws an organ from above at the first one, or a single organ at bone.
void throwOrgan(Draw* draw, TortureScene* scene) {
  scene->start = Start::kThrown;
  scene->thrown = draw->decades(0.05, 2.0);
  TortureOrgan& first = scene->organs.front();
  scene->bone = draw->chance(0.4);
  if (scene->bone) {
    first.held = false;
    first.low.z() = 0.002;
    first.mesh.points.row(2).array() += 0.002;
    return;
  }
  TortureOrgan second = first;
  second.name = "second";
  second.held = false;
  second.low.z() = first.size.z() + 0.002;
  second.mesh.points.row(2).array() += second.low.z();
  scene->organs.push_back(second);
}

void drawGravity(Draw* draw, TortureScene* scene) {
  const bool asked = scene->category == "gravity";
  if (scene->category == "fall" || scene->category == "adapt") return;
  if (!asked && !draw->chance(0.4)) return;
  const TortureOrgan& organ = scene->organs.front();
  const double weight = organ.density * kG * organ.size.z() / organ.young;
  scene->gravity = -kG * std::min(1.0, kWeightOf / weight) * Vec3::UnitZ();
  if (draw->chance(0.2)) scene->gravity = scene->gravity.norm() * draw->direction();
  if (asked) scene->start = Start::kTurnedGravity;
}

Start drawStart(Draw* draw) {
  static const std::vector<Start> kAll = {Start::kRandom, Start::kFlat, Start::kInverted,
                                          Start::kTwisted, Start::kScaled};
  return draw->oneOf(kAll);
}

}  // namespace

double TortureOrgan::waveModulus() const {
  return contrast * young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

double TortureOrgan::heldTo() const {
  if (model == "cloth") return low.y() + 0.1 * size.y();
  return low.z() + (shape == "kidney" || shape == "gallbladder" ? 0.2 * size.z() : 1e-6);
}

const char* toString(Start start) {
  switch (start) {
    case Start::kRest:
      return "rest";
    case Start::kRandom:
      return "random";
    case Start::kFlat:
      return "flat";
    case Start::kInverted:
      return "inverted";
    case Start::kTwisted:
      return "twisted";
    case Start::kScaled:
      return "scaled";
    case Start::kTurnedGravity:
      return "turned_gravity";
    case Start::kThrown:
      return "thrown";
  }
  return "";
}

double TortureScene::size() const {
  Vec3 low = organs.front().low, high = low + organs.front().size;
  for (const TortureOrgan& organ : organs) {
    low = low.cwiseMin(organ.low);
    high = high.cwiseMax(Vec3(organ.low + organ.size));
  }
  return (high - low).norm();
}

const std::vector<std::string>& categories() {
  static const std::vector<std::string> kAll = {"press",    "stroke", "jump", "inside", "pinch",
                                                "tear",     "wander", "fall", "start",  "gravity",
                                                "contrast", "sliver", "adapt"};
  return kAll;
}

const std::vector<std::string>& toolShapes() {
  static const std::vector<std::string> kAll = {"ball",  "capsule", "cylinder", "box",
                                                "blade", "needle",  "hull",     "hook"};
  return kAll;
}

TortureScene drawScene(std::uint64_t seed, int number) {
  Draw draw(seed, static_cast<std::uint64_t>(number));
  TortureScene scene;
  scene.seed = seed;
  scene.number = number;
  scene.category = categories()[static_cast<std::size_t>(number) % categories().size()];
  scene.friction = draw.chance(0.4) ? draw.between(0.0, 2.0) : 0.0;
  if (scene.category == "tear") scene.friction = 2.0;
  if (scene.category == "start") scene.start = drawStart(&draw);
  scene.organs.push_back(drawOrgan(scene, &draw));
  if (scene.category == "fall") scene.organs.front().held = true;
  drawMethod(&draw, &scene);
  TortureOrgan& organ = scene.organs.front();
  if (scene.category == "fall" || scene.category == "start") {
    // Free motion needs inertia, and organs interact only by implicit methods.
    if (scene.method == "linear_precomputed" || scene.method == "newton_bicgstab" ||
        (scene.category == "fall" && scene.method == "tled")) {
      scene.method = "implicit_pcg";
    }
    if (scene.category == "fall" || scene.integrator == "static") {
      scene.integrator = "backward_euler";
    }
  }
  drawDamping(&draw, scene, &organ);
  drawMeshOf(scene, &draw, &organ);
  if (scene.category == "fall") throwOrgan(&draw, &scene);
  drawGravity(&draw, &scene);
  drawLearning(&scene);
  drawTools(&draw, &scene);
  drawPrescribed(&scene);
  drawPenalty(&scene);
  drawMotion(draw.decades(1e-4, 0.05), &draw, &scene);
  scene.live = number % 6 == 5;
  return scene;
}

std::string describe(const TortureScene& scene) {
  const TortureOrgan& o = scene.organs.front();
  const std::string usual = contact::ResponseSettings().model;
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: %s%s%s %s E=%.3g nu=%g rho=%.3g, %s of %td tetrahedra (%.3g deg), %s %s, step "
                "%.3g s, %zu tools, friction %.2g, start %s%s",
                scene.category.c_str(), o.model.c_str(), o.model == "fem" ? " " : "",
                o.model == "fem" ? o.element.c_str() : "", o.law.c_str(), o.young, o.poisson,
                o.density, o.shape.c_str(), o.mesh.numTets(), o.min_dihedral, scene.method.c_str(),
                scene.integrator.c_str(), scene.step, scene.tools.size(), scene.friction,
                toString(scene.start),
                scene.contact == usual ? "" : (", " + scene.contact).c_str());
  return text;
}

}  // namespace palpate::torture
