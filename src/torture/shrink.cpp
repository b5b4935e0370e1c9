// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/shrink.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "draw_body.h"
#include "palpate/base/phase_times.h"

namespace palpate::torture {
namespace {

constexpr Eigen::Index kJoints = 6;

// Simplifies a scene; false if that is done already.
using Edit = std::function<bool(TortureScene*)>;

bool keepRows(std::size_t begin, std::size_t end, TortureScene* scene) {
  formats::Trajectory& all = scene->trajectory;
  end = std::min(end, all.t.size());
  if (begin + 2 > end || end - begin == all.t.size()) return false;
  all.t = std::vector<double>(all.t.begin() + static_cast<std::ptrdiff_t>(begin),
                              all.t.begin() + static_cast<std::ptrdiff_t>(end));
  all.values = Eigen::MatrixXd(all.values.middleCols(static_cast<Eigen::Index>(begin),
                                                     static_cast<Eigen::Index>(end - begin)));
  scene->leave = scene->leave > begin ? scene->leave - begin : 0;
  return true;
}

bool dropTool(std::size_t k, TortureScene* scene) {
  if (scene->tools.size() < 2 || k >= scene->tools.size()) return false;
  formats::Trajectory& all = scene->trajectory;
  const auto first = kJoints * static_cast<Eigen::Index>(k);
  const Eigen::Index after = all.values.rows() - first - kJoints;
  Eigen::MatrixXd values(all.values.rows() - kJoints, all.values.cols());
  values << all.values.topRows(first), all.values.bottomRows(after);
  all.values = values;
  all.columns.erase(all.columns.begin() + first, all.columns.begin() + first + kJoints);
  scene->tools.erase(scene->tools.begin() + static_cast<std::ptrdiff_t>(k));
  return true;
}

template <class Value>
Edit become(Value TortureScene::*member, Value plain) {
  return [=](TortureScene* scene) {
    if (scene->*member == plain) return false;
    scene->*member = plain;
    return true;
  };
}

template <class Value>
Edit organsBecome(Value TortureOrgan::*member, Value plain) {
  return [=](TortureScene* scene) {
    bool changed = false;
    for (TortureOrgan& organ : scene->organs) {
      changed = changed || organ.*member != plain;
      organ.*member = plain;
      organ.constants = constantsOf(organ.law, organ.young, organ.poisson);
    }
    return changed;
  };
}

std::vector<Edit> edits(const TortureScene& scene, const Failure& failure) {
  std::vector<Edit> all;
  const bool at_once = failure.criterion != "rest" && failure.criterion != "time";
  if (at_once) {
    all.push_back([=](TortureScene* s) { return keepRows(0, failure.row + 1, s); });
  }
  for (std::size_t k = scene.tools.size(); k-- > 0;) {
    all.push_back([=](TortureScene* s) { return dropTool(k, s); });
  }
  if (scene.start != Start::kThrown) {
    all.push_back([](TortureScene* s) {
      if (s->organs.size() < 2) return false;
      s->organs.pop_back();
      return true;
    });
  }
  if (scene.start == Start::kRest) {
    // Only rows before a touch can be removed, since a tool that begins inside exerts no force.
    for (const std::size_t part : {2, 4, 8, 16}) {
      all.push_back([part](TortureScene* s) {
        const std::size_t before = std::min(s->leave, s->trajectory.t.size());
        return keepRows(before / part, s->trajectory.t.size(), s);
      });
    }
  }
  if (scene.start != Start::kTurnedGravity) {
    all.push_back(become(&TortureScene::gravity, Vec3(Vec3::Zero())));
  }
  all.push_back(become(&TortureScene::friction, 0.0));
  all.push_back(become(&TortureScene::integrator, std::string("backward_euler")));
  all.push_back(become(&TortureScene::method, std::string("implicit_pcg")));
  all.push_back(organsBecome(&TortureOrgan::prony_g, 0.0));
  all.push_back(organsBecome(&TortureOrgan::stiffness_damping, 0.0));
  all.push_back(organsBecome(&TortureOrgan::adapt, 0.0));
  all.push_back(organsBecome(&TortureOrgan::contrast, 1.0));
  all.push_back(organsBecome(&TortureOrgan::law, std::string("stable_neo_hookean")));
  all.push_back(organsBecome(&TortureOrgan::element, std::string("tet4")));
  all.push_back(organsBecome(&TortureOrgan::poisson, 0.3));
  all.push_back(organsBecome(&TortureOrgan::density, 1000.0));
  return all;
}

// Where `outcome` fails the criterion; null if it does not.
const Failure* failureOf(const Outcome& outcome, const std::string& criterion) {
  for (const Failure& failure : outcome.failures) {
    if (failure.criterion == criterion) return &failure;
  }
  return nullptr;
}

}  // namespace

TortureScene shrunk(const TortureScene& scene, const Failure& failure, const std::string& folder,
                    const RunLimits& limits, double seconds) {
  TortureScene best = scene;
  Failure of_best = failure;
  const double begin = steadySeconds();
  // An edit may become possible after another one, so all are repeated.
  for (bool plainer = true; plainer;) {
    plainer = false;
    for (const Edit& edit : edits(best, of_best)) {
      TortureScene tried = best;
      if (steadySeconds() - begin > seconds) return best;
      if (!edit(&tried)) continue;
      const Outcome outcome = run(tried, folder, limits);
      if (const Failure* still = failureOf(outcome, failure.criterion)) {
        best = tried;
        of_best = *still;
        plainer = true;
      }
    }
  }
  return best;
}

}  // namespace palpate::torture
