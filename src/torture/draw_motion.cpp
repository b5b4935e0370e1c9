// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw_body.h"
#include "palpate/tissue/enriched/enriched_settings.h"
#include "palpate/tissue/neural/neural_settings.h"

namespace palpate::torture {
namespace {

constexpr double kFastest = 2.0;                                   // [m/s]
constexpr double kJump = std::numeric_limits<double>::infinity();  // speed of a leg within one row
constexpr int kMostRows = 90, kLeavingRows = 10, kLeastRestRows = 100, kMostRestRows = 700;
constexpr int kTimesToRest = 3;    // safety factor on the estimated time to rest
constexpr double kLongest = 0.05;  // longest row [s]

struct Leg {
  Vec3 to;
  double speed;  // [m/s]
};

struct Way {
  Vec3 at, turn;  // initial position; constant angles
  std::vector<Leg> legs;
  double spin = 0.0;  // of yaw [rad/s]
};

struct Box {
  Vec3 low, size;
  Vec3 at(double x, double y, double z) const { return low + size.cwiseProduct(Vec3(x, y, z)); }
};

Box boxOf(const TortureScene& scene) {
  return {scene.organs.front().low, scene.organs.front().size};
}

double drawSpeed(Draw* draw) { return draw->decades(0.02, kFastest); }

// Initial distance of a tool, travelled in a few rows [m].
double awayOf(double speed, double dt) { return std::min(0.002, 10.0 * speed * dt); }

Way press(const Box& box, const TortureTool& tool, double speed, double dt, Draw* draw) {
  const double x = draw->between(0.2, 0.8), y = draw->between(0.2, 0.8);
  const double away = awayOf(speed, dt), depth = draw->between(0.05, 0.5) * box.size.z();
  const Vec3 top = box.at(x, y, 1.0), up = Vec3::UnitZ();
  const Vec3 low = top + (tool.radius() - depth) * up;
  return {top + (tool.radius() + away) * up,
          0.3 * draw->direction(),
          {{low, speed}, {low, speed}},
          0.0};
}

Way stroke(const Box& box, const TortureTool& tool, double dt, Draw* draw) {
  const double speed = draw->decades(0.2, kFastest), depth = draw->between(0.1, 0.4);
  const double z = box.size.z() * (1.0 - depth) + 0.7 * tool.radius();
  const Vec3 from = box.low + Vec3(-tool.radius() - awayOf(speed, dt), 0.5 * box.size.y(), z);
  const Vec3 to = box.low + Vec3(1.2 * box.size.x() + tool.radius(), 0.5 * box.size.y(), z);
  return {from, draw->direction(), {{to, speed}, {from, speed}}, 0.0};
}

// Presses within a third of the rows, if kFastest suffices.
Way pressSoon(const Box& box, const TortureTool& tool, double dt, Draw* draw) {
  const double speed = drawSpeed(draw);
  const double soon = 3.0 * (0.5 * box.size.z() + 0.002) / (kMostRows * dt);
  return press(box, tool, std::min(std::max(speed, soon), kFastest), dt, draw);
}

Way jump(const Box& box, const TortureTool& tool, double dt, Draw* draw) {
  Way way = pressSoon(box, tool, dt, draw);
  way.legs.push_back(
      {box.at(0.5, 0.5, 0.5) + draw->direction() * 0.3 * box.size.minCoeff(), kJump});
  way.legs.push_back({way.legs.back().to + 0.1 * draw->direction(), kJump});
  way.legs.push_back({box.at(0.5, 0.5, 0.9), kJump});
  return way;
}

Way inside(const Box& box, Draw* draw) {
  const Vec3 at = box.at(0.5, 0.5, draw->between(0.3, 0.9));
  return {at, draw->direction(), {{at + 0.01 * draw->direction(), drawSpeed(draw)}}, 0.0};
}

// Tools are upright, so their half width is between axis and organ.
Way pinch(const Box& box, const TortureTool& tool, int side, double dt, Draw* draw) {
  const double sign = side % 2 ? 1.0 : -1.0, thick = draw->between(0.2, 0.7);
  const Vec3 middle = box.at(0.5, 0.5, 0.7);
  const double speed = drawSpeed(draw), tilt = 0.1, half = tool.size.x() + tilt * tool.size.z();
  const double away = half + awayOf(speed, dt);
  const Vec3 from = middle + sign * (0.5 * box.size.x() + away) * Vec3::UnitX();
  const Vec3 to = middle + sign * (0.5 * thick * box.size.x() + half) * Vec3::UnitX();
  return {from, tilt * draw->direction(), {{to, speed}, {to, speed}, {from, speed}}, 0.0};
}

Way tear(const Box& box, const TortureTool& tool, double dt, Draw* draw) {
  Way way = pressSoon(box, tool, dt, draw);
  Vec3 out = draw->direction();
  out.z() = std::abs(out.z());
  way.legs.push_back({way.legs.back().to + 0.1 * out, kFastest});
  return way;
}

Way wander(const Box& box, const TortureTool& tool, double dt, Draw* draw) {
  Way way = pressSoon(box, tool, dt, draw);
  for (int k = 0; k < 4; ++k) {
    way.legs.push_back({box.low + draw->within(Vec3::Zero(), 1.3 * box.size), drawSpeed(draw)});
  }
  way.spin = draw->between(-5.0, 5.0);
  return way;
}

Way far(int tool) {
  const Vec3 at(0.3 * tool, 0.0, 1.0);
  return {at, Vec3::Zero(), {}, 0.0};
}

Way wayOf(const TortureScene& scene, int k, double dt, Draw* draw) {
  const Box box = boxOf(scene);
  const TortureTool& tool = scene.tools[static_cast<std::size_t>(k)];
  const std::string& what = scene.category;
  if (what == "stroke") return stroke(box, tool, dt, draw);
  if (what == "jump") return jump(box, tool, dt, draw);
  if (what == "inside" && k == 0) return inside(box, draw);
  if (what == "pinch") return pinch(box, tool, k, dt, draw);
  if (what == "tear") return tear(box, tool, dt, draw);
  if (what == "wander") return wander(box, tool, dt, draw);
  if (what == "fall") return far(k);
  if ((what == "start" || what == "gravity") && draw->chance(0.6)) return far(k);
  return press(box, tool, drawSpeed(draw), dt, draw);
}

// Advances by one row; false at the end.
bool advance(double dt, Way* way) {
  if (way->legs.empty()) return false;
  way->turn.z() += way->spin * dt;
  double left = way->legs.front().speed * dt;
  while (!way->legs.empty()) {
    const Vec3 rest = way->legs.front().to - way->at;
    if (rest.norm() > left) {
      way->at += left * rest.normalized();
      return true;
    }
    left -= rest.norm();
    way->at = way->legs.front().to;
    const bool jumped = way->legs.front().speed == kJump;
    way->legs.erase(way->legs.begin());
    if (jumped || rest.norm() == 0.0) return true;
  }
  return true;
}

class Rows {
 public:
  explicit Rows(const TortureScene& scene) {
    for (const TortureTool& tool : scene.tools) {
      for (const char* joint : {"x", "y", "z", "roll", "pitch", "yaw"}) {
        const std::string prefix = scene.tools.size() > 1 ? tool.name + "/" : "";
        table_.columns.push_back(prefix + joint);
      }
    }
  }
  void add(double dt, const std::vector<Way>& ways) {
    t_ += table_.t.empty() ? 0.0 : dt;
    table_.t.push_back(t_);
    for (const Way& way : ways) {
      for (int c = 0; c < 3; ++c) values_.push_back(way.at[c]);
      for (int c = 0; c < 3; ++c) values_.push_back(way.turn[c]);
    }
  }
  std::size_t count() const { return table_.t.size(); }
  formats::Trajectory table() {
    table_.values = Eigen::Map<const Eigen::MatrixXd>(
        values_.data(), static_cast<Eigen::Index>(table_.columns.size()),
        static_cast<Eigen::Index>(count()));
    return table_;
  }

 private:
  formats::Trajectory table_;
  std::vector<double> values_;
  double t_ = 0.0;
};

// Whether organs move without inertia and damping; damping slows `static` steps of other methods.
bool movesWithoutInertia(const TortureScene& scene) {
  const std::string& model = scene.organs.front().model;
  if (model == "fem" || model == "enriched" || model == "neural") {
    return scene.method == "linear_precomputed" || scene.method == "newton_bicgstab";
  }
  return model == "bem" || model == "honeycomb";
}

constexpr double kTimes = 14.0;  // time constants until 1e-6 remains

// Time until 1e-5 of the slowest motion remains. With damping of 0.8 to 1.6 of its frequency, the
// decay rate exceeds 0.4 of the frequency. Prony series must relax, and surrogates switch off,
// within this time.
double timeToRest(const TortureScene& scene) {
  double longest = 0.0;
  for (const TortureOrgan& organ : scene.organs) {
    if (!movesWithoutInertia(scene)) longest = std::max(longest, 30.0 / slowestFrequency(organ));
    double slowest = organ.prony_g > 0.0 ? organ.prony_tau : 0.0;
    if (organ.model == "enriched") slowest = tissue::EnrichedSettings().time;
    if (organ.model == "neural") slowest = tissue::NeuralSettings().switch_time;
    longest = std::max(longest, kTimes * slowest);
  }
  return longest;
}

}  // namespace

void drawTools(Draw* draw, TortureScene* scene) {
  const bool none =
      scene->category == "fall" || scene->category == "start" || scene->category == "gravity";
  int count = draw->chance(0.7) ? 1 : 2 + draw->whole(3);
  if (scene->category == "pinch") count = 2;
  if (none) count = 1;
  for (int k = 0; k < count; ++k) {
    TortureTool tool;
    tool.name = "tool_" + std::to_string(k + 1);
    tool.shape = draw->oneOf(toolShapes());
    const double r = draw->between(0.0015, 0.008), length = draw->between(0.005, 0.02);
    if (tool.shape == "ball") tool.size = Vec3(draw->chance(0.2) ? 6.0 * r : r, 0.0, 0.0);
    if (tool.shape == "capsule" || tool.shape == "cylinder") tool.size = Vec3(r, 0.0, length + r);
    if (tool.shape == "needle") tool.size = Vec3(2.5e-4, 0.0, length);
    if (tool.shape == "box" || tool.shape == "hull" || tool.shape == "hook") {
      tool.size = Vec3(r, draw->between(0.002, 0.008), length);
    }
    if (tool.shape == "blade") tool.size = Vec3(1e-4, draw->between(0.003, 0.008), length);
    scene->tools.push_back(tool);
  }
}

void drawMotion(double dt, Draw* draw, TortureScene* scene) {
  std::vector<Way> ways;
  ways.reserve(scene->tools.size());
  for (int k = 0; k < static_cast<int>(scene->tools.size()); ++k) {
    ways.push_back(wayOf(*scene, k, dt, draw));
  }
  const double jitter = draw->chance(0.3) ? 0.5 : 0.0;
  Rows rows(*scene);
  rows.add(dt, ways);
  scene->step = dt;
  for (bool goes = true; goes && rows.count() < kMostRows;) {
    const double now = dt * (1.0 + draw->between(-jitter, jitter));
    goes = false;
    for (Way& way : ways) goes = advance(now, &way) || goes;
    if (goes) rows.add(now, ways);
    scene->step = std::max(scene->step, now);
  }
  // Moves tools up at kFastest at most until all are clear, then far away.
  const Box box = boxOf(*scene);
  double most = 0.0;
  std::vector<double> up;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const double clear = box.low.z() + 1.5 * box.size.z() + 2.0 * scene->tools[k].radius() + 0.01;
    up.push_back(std::max(clear - ways[k].at.z(), 0.0));
    most = std::max(most, up.back());
  }
  const double leaving = std::clamp(most / kLeavingRows / kFastest, dt, kLongest);
  for (int row = 0; row < kLeavingRows && most > 0.0; ++row) {
    for (std::size_t k = 0; k < ways.size(); ++k) ways[k].at.z() += up[k] / kLeavingRows;
    rows.add(leaving, ways);
    scene->step = std::max(scene->step, leaving);
  }
  for (std::size_t k = 0; k < ways.size(); ++k) ways[k] = far(static_cast<int>(k));
  scene->leave = rows.count();
  const double time = timeToRest(*scene);
  const double longest = std::clamp(time / 100.0, dt, kLongest);
  const int count =
      std::max(static_cast<int>(std::ceil(std::min(time / longest, 1e6))), kLeastRestRows);
  // Organs at rest sleep, at no cost.
  for (int row = 0; row < kTimesToRest * std::min(count, kMostRestRows); ++row) {
    rows.add(longest, ways);
  }
  scene->step = std::max(scene->step, longest);
  const bool all_held = std::all_of(scene->organs.begin(), scene->organs.end(),
                                    [](const TortureOrgan& organ) { return organ.held; });
  scene->rests = count <= kMostRestRows && all_held;
  scene->trajectory = rows.table();
}

}  // namespace palpate::torture
