// SPDX-License-Identifier: GPL-3.0-or-later
#include "needles.h"

#include <Eigen/LU>
#include <algorithm>
#include <variant>

#include "palpate/contact/signed_distance.h"

namespace palpate::tissue {
namespace {

using contact::NeedleChannel;

// Spacing of tissue points along the needle [m].
constexpr double kSpacing = 1e-3;
// Tolerance of barycentric coordinates for a point in a tetrahedron [-].
constexpr double kOnFace = 1e-6;

struct Shaft {
  double length, radius;  // half length, radius [m]
};

// Sizes of a needle's shape; none for other shapes.
Shaft shaftOf(const instrument::Geometry& geometry) {
  if (const auto* capsule = std::get_if<instrument::Capsule>(&geometry)) {
    return {capsule->half_length + capsule->radius, capsule->radius};
  }
  const auto& cylinder = std::get<instrument::Cylinder>(geometry);
  return {cylinder.half_length, cylinder.radius};
}

}  // namespace

NeedleChannel Needles::channelOf(const contact::NeedleSettings& settings, double length,
                                 double radius, double stiffness) {
  // Stiffness of contact on the strip of each point.
  return {settings, length, stiffness * 2.0 * radius * kSpacing, kSpacing};
}

void Needles::put(double s, Inserted* needle) {
  const Pose X_WG = contact::interpolate(needle->now.X_WG_begin, needle->now.X_WG_end, s);
  needle->channel.setPose(X_WG.translation(), needle->end * X_WG.linear().col(2));
}

void Needles::begin(const std::vector<contact::Obstacle>& obstacles, const Points& x) {
  inside_.clear();
  for (Inserted& needle : needles_) {
    needle.there = false;
    const auto same = std::find_if(
        obstacles.begin(), obstacles.end(),
        [&](const contact::Obstacle& o) { return o.number == needle.number && o.needle; });
    if (same == obstacles.end()) continue;
    needle.now = *same;
    needle.there = true;
    put(0.0, &needle);
    NeedleChannel::MaterialPoint place;
    if (needle.channel.wantsTip(x) && find(x, needle.channel.tip(), &place)) {
      const Points at_rest = X_(Eigen::all, place.nodes);
      needle.channel.addTip(place, at_rest * place.weights, needle.channel.tipForce(x));
    }
  }
  // Removes needles that were withdrawn or are absent.
  needles_.erase(std::remove_if(needles_.begin(), needles_.end(),
                                [](const Inserted& n) { return !n.there || n.channel.empty(); }),
                 needles_.end());
  for (const Inserted& needle : needles_) inside_.push_back(needle.number);
  std::sort(inside_.begin(), inside_.end());
}

void Needles::moveTo(double s) {
  for (Inserted& needle : needles_) put(s, &needle);
}

void Needles::endStep(const Points& x) {
  for (Inserted& needle : needles_) needle.channel.endStep(x);
}

void Needles::puncture(const std::vector<contact::Obstacle>& obstacles,
                       const std::vector<contact::Contact>& contacts, const Points& x) {
  for (const contact::Obstacle& obstacle : obstacles) {
    if (!obstacle.needle || tets_.cols() == 0) continue;
    const Vec3 origin = obstacle.X_WG_end.translation(), z = obstacle.X_WG_end.linear().col(2);
    const contact::Contact* hardest = nullptr;
    double push = 0.0;  // axial force [N]
    for (const contact::Contact& c : contacts) {
      if (c.touch.number != obstacle.number) continue;
      push -= z.dot(c.force_W);
      if (!hardest || c.force_W.squaredNorm() > hardest->force_W.squaredNorm()) hardest = &c;
    }
    if (!hardest || std::abs(push) < obstacle.needle->puncture_force) continue;
    const double end = push > 0.0 ? 1.0 : -1.0;
    const contact::Touch& touch = hardest->touch;
    // Only contacts at the tip count.
    const Shaft shaft = shaftOf(*obstacle.geometry);
    if (end * z.dot(touch.p_W - origin) < shaft.length - 2.0 * shaft.radius - kSpacing) continue;
    needles_.push_back({obstacle.number, end, *obstacle.needle, shaft.length, shaft.radius,
                        channelOf(*obstacle.needle, shaft.length, shaft.radius, stiffness_),
                        obstacle, true});
    Inserted& needle = needles_.back();
    put(1.0, &needle);
    NeedleChannel::MaterialPoint place;
    place.nodes << touch.nodes, touch.nodes[0];
    place.weights << touch.weights, 0.0;
    needle.channel.addTip(place, X_(Eigen::all, place.nodes) * place.weights, std::abs(push));
    needle.channel.endStep(x);
  }
}

double Needles::value(const Points& x) const {
  double sum = 0.0;
  for (const Inserted& needle : needles_) sum += needle.channel.value(x);
  return sum;
}

double Needles::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  for (const Inserted& needle : needles_) sum += needle.channel.addGradient(x, g);
  return sum;
}

void Needles::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  for (const Inserted& needle : needles_) needle.channel.addHessian(x, tangent, K);
}

// Finds the tetrahedron with p.
bool Needles::find(const Points& x, const Vec3& p, NeedleChannel::MaterialPoint* place) const {
  for (Eigen::Index e = 0; e < tets_.cols(); ++e) {
    const Vec3 a = x.col(tets_(0, e));
    Mat3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = x.col(tets_(k + 1, e)) - a;
    const Vec3 r = p - a;
    if (r.squaredNorm() > edges.squaredNorm()) continue;
    const Vec3 w = edges.inverse() * r;
    const Eigen::Vector4d weights(1.0 - w.sum(), w[0], w[1], w[2]);
    if (!(weights.minCoeff() >= -kOnFace)) continue;
    place->nodes = tets_.col(e);
    place->weights = weights;
    return true;
  }
  return false;
}

void Needles::forget() {
  needles_.clear();
  inside_.clear();
}

void Needles::goOnFrom(const Needles& old) {
  needles_ = old.needles_;
  inside_ = old.inside_;
  for (Inserted& needle : needles_) {
    needle.channel.relocate(
        [&](const Vec3& X, NeedleChannel::MaterialPoint* place) { return find(X_, X, place); });
  }
}

void Needles::save(StateWriter* to) const {
  to->put(static_cast<int>(needles_.size()));
  for (const Inserted& n : needles_) {
    to->put(n.number);
    for (double value : {n.end, n.settings.puncture_force, n.settings.cutting_force,
                         n.settings.shaft_friction, n.length, n.radius}) {
      to->put(value);
    }
    n.channel.save(to);
  }
}

// Poses do not change within a cycle.
void Needles::restore(StateReader* from) {
  const std::vector<Inserted> before = std::move(needles_);
  needles_.clear();
  int size = 0;
  from->get(&size);
  for (int k = 0; k < size; ++k) {
    Inserted n{0, 1.0, {}, 0.0, 0.0, channelOf({}, 0.0, 0.0, 0.0), {}, false};
    from->get(&n.number);
    for (double* value : {&n.end, &n.settings.puncture_force, &n.settings.cutting_force,
                          &n.settings.shaft_friction, &n.length, &n.radius}) {
      from->get(value);
    }
    n.channel = channelOf(n.settings, n.length, n.radius, stiffness_);
    n.channel.restore(from, X_.cols());
    for (const Inserted& same : before) {
      if (same.number != n.number) continue;
      n.now = same.now;
      n.there = same.there;
    }
    needles_.push_back(n);
  }
}

}  // namespace palpate::tissue
