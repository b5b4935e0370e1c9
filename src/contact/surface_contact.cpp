// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "surface_pass.h"
#include "touch_sum.h"

namespace palpate::contact {

struct SurfaceContact::Parts {
  struct Pressing {
    SurfaceTouch touch;
    std::size_t pass;
    double penetration;
  };

  Parts(std::shared_ptr<const ContactSurface> of_a, std::shared_ptr<const ContactSurface> of_b,
        const Penalty& penalty)
      : law(penalty), a{std::move(of_a), 0, {}}, b{nullptr, 0, {}} {
    if (of_b) {
      b = {std::move(of_b), static_cast<int>(a.fixed->atRest().cols()), {}};
      passes.emplace_back(&a, &b);
      passes.emplace_back(&b, &a);
    } else {
      passes.emplace_back(&a, &a);
    }
    std::size_t most = 0, corners = 0;
    for (const SurfacePass& pass : passes) {
      most += pass.feels().fixed->samples().size();
      corners += static_cast<std::size_t>(pass.other().fixed->triangles().size());
    }
    pressing.reserve(most);  // no cycle takes memory
    nodes.reserve(3 * most + corners);
  }

  // The farthest that a point is from where it was searched.
  double farthest(const Points& x) const {
    return std::sqrt((x - searched_at).colwise().squaredNorm().maxCoeff());
  }
  // Of the nodes that gaps depend on: the middle of their ways, and the farthest from it.
  Moved moved(const Points& x) const {
    return movedOf(nodes.size(), x, [&](std::size_t k) { return nodes[k]; });
  }
  // Of all of them [m].
  double movedAtAll(const Points& x) const {
    if (searched_at.cols() != x.cols()) return std::numeric_limits<double>::infinity();
    const auto count = static_cast<std::size_t>(x.cols());
    return movedOf(count, x, [](std::size_t k) { return static_cast<int>(k); }).rest;
  }
  template <class NodeOf>
  Moved movedOf(std::size_t count, const Points& x, const NodeOf& node) const {
    const auto went = [&](std::size_t k) {
      return Vec3(x.col(node(k)) - searched_at.col(node(k)));
    };
    Eigen::AlignedBox3d ways;
    for (std::size_t k = 0; k < count; ++k) ways.extend(went(k));
    Moved all{ways.center(), 0.0};
    for (std::size_t k = 0; k < count; ++k) {
      all.rest = std::max(all.rest, (went(k) - all.shift).squaredNorm());
    }
    all.rest = std::sqrt(all.rest);
    return all;
  }
  void search(const Points& x, double far) {
    known = known && measured_at == x && farthest(x) <= way;  // where the last cycle ended
    const double since = movedAtAll(x);
    searched_at = x;
    way = far;
    for (MovingSurface* surface : {&a, &b}) {
      if (!surface->fixed) continue;
      surface->fixed->tree().fit(surface->part(x), surface->fixed->triangles(), &surface->boxes);
    }
    nodes.clear();
    for (SurfacePass& pass : passes) {
      pass.search(x, way, since);
      pass.addNodes(way, &nodes);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  // Finds those that press at x: energy, forces and stiffness are asked for one after another.
  void measure(const Points& x) {
    if (known && measured_at == x) return;
    known = true;
    measured_at = x;
    pressing.clear();
    const Moved all = moved(x);
    for (std::size_t k = 0; k < passes.size(); ++k) {
      const SurfacePass& pass = passes[k];
      pass.forTouches(x, all, 0.0, [&](const SurfaceTouch& touch, const SurfaceSample&) {
        const double penetration = -touch.gap - pass.overlap(touch.sample);
        if (penetration > 0.0) pressing.push_back({touch, k, penetration});
      });
    }
    // Those of one triangle's samples follow one another; of these, those with one other triangle.
    for (auto begin = pressing.begin(); begin != pressing.end();) {
      const auto end = std::find_if(begin, pressing.end(), [&](const Pressing& p) {
        return p.pass != begin->pass || nodesOf(p) != nodesOf(*begin);
      });
      std::sort(begin, end, [](const Pressing& p, const Pressing& q) {
        return std::make_pair(p.touch.triangle, p.touch.sample) <
               std::make_pair(q.touch.triangle, q.touch.sample);
      });
      begin = end;
    }
  }
  const SurfaceSample& sampleOf(const Pressing& p) const {
    return passes[p.pass].feels().fixed->samples()[static_cast<std::size_t>(p.touch.sample)];
  }
  const Eigen::Vector3i& nodesOf(const Pressing& p) const { return sampleOf(p).nodes; }
  // visit(pass, touch, sample, penetration) of all that press at x.
  template <class Visit>
  void forPressing(const Points& x, const Visit& visit) {
    if (!any()) return;
    measure(x);
    for (const Pressing& p : pressing) {
      visit(passes[p.pass], p.touch, sampleOf(p), p.penetration);
    }
  }
  bool any() const {
    return std::any_of(passes.begin(), passes.end(),
                       [](const SurfacePass& pass) { return pass.numCandidates() > 0; });
  }

  Penalty law;
  MovingSurface a, b;
  std::vector<SurfacePass> passes;
  Points searched_at, measured_at;
  double way = 0.0;
  std::vector<int> nodes;
  std::vector<Pressing> pressing;
  bool known = false;  // what presses at measured_at
};

namespace {

// Of what overlaps at rest, the way to the middle is no less than this part of the radius.
constexpr double kLeastMiddle = 0.25;

}  // namespace

SurfaceContact::SurfaceContact(std::shared_ptr<const ContactSurface> a,
                               std::shared_ptr<const ContactSurface> b, const Penalty& law)
    : parts_(std::make_unique<Parts>(std::move(a), std::move(b), law)) {}

SurfaceContact::~SurfaceContact() = default;

void SurfaceContact::search(const Points& x, double way) { parts_->search(x, way); }

bool SurfaceContact::holds(const Points& x) const { return parts_->farthest(x) <= parts_->way; }

int SurfaceContact::numCandidates() const {
  int sum = 0;
  for (const SurfacePass& pass : parts_->passes) sum += pass.numCandidates();
  return sum;
}

int SurfaceContact::numTouches(const Points& x, double* deepest) const {
  int count = 0;
  *deepest = 0.0;
  parts_->forPressing(
      x, [&](const SurfacePass&, const SurfaceTouch&, const SurfaceSample&, double penetration) {
        ++count;
        *deepest = std::max(*deepest, penetration);
      });
  return count;
}

double SurfaceContact::value(const Points& x) const {
  double sum = 0.0;
  parts_->forPressing(x, [&](const SurfacePass& pass, const SurfaceTouch&,
                             const SurfaceSample& sample, double penetration) {
    sum += 0.5 * sample.area * parts_->law.energy(penetration, pass.other().fixed->radius());
  });
  return sum;
}

double SurfaceContact::addGradient(const Points& x, Points* g) const {
  double sum = 0.0;
  parts_->forPressing(x, [&](const SurfacePass& pass, const SurfaceTouch& touch,
                             const SurfaceSample& sample, double penetration) {
    const double radius = pass.other().fixed->radius(), half = 0.5 * sample.area;
    const Vec3 force = half * parts_->law.pressure(penetration, radius) * touch.normal;
    const auto corners = pass.other().fixed->triangles().col(touch.triangle);
    for (int k = 0; k < 3; ++k) {
      g->col(pass.feels().first + sample.nodes[k]) -= sample.weights[k] * force;
      g->col(pass.other().first + corners[k]) += touch.near.weights[k] * force;
    }
    sum += half * parts_->law.energy(penetration, radius);
  });
  return sum;
}

void SurfaceContact::addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const {
  TouchSum sum(K);
  parts_->forPressing(x, [&](const SurfacePass& pass, const SurfaceTouch& touch,
                             const SurfaceSample& sample, double penetration) {
    const double radius = pass.other().fixed->radius(), half = 0.5 * sample.area;
    const Vec12 g = gapGradient(touch);
    Mat12 H = half * parts_->law.slope(penetration, radius) * g * g.transpose();
    if (tangent == fem::Tangent::kExact) {
      const Mat3 corners = pass.other().fixed->corners(pass.other().part(x), touch.triangle);
      H -= half * parts_->law.pressure(penetration, radius) * gapHessian(touch, corners);
    }
    sum.add(pass, touch, sample, H);
  });
}

double SurfaceContact::maxStep(const Points& x, const Points& d) const {
  const Parts& parts = *parts_;
  if (!parts.any()) return 1.0;
  const double farthest = std::sqrt(d.colwise().squaredNorm().maxCoeff());
  double largest = farthest > parts.way && parts.way > 0.0 ? parts.way / farthest : 1.0;
  const auto limit = [&](const SurfacePass& pass, const SurfaceTouch& touch,
                         const SurfaceSample& sample) {
    Vec3 way = pass.position(sample, d);
    const auto corners = pass.other().fixed->triangles().col(touch.triangle);
    for (int k = 0; k < 3; ++k) {
      way -= touch.near.weights[k] * d.col(pass.other().first + corners[k]);
    }
    const double radius = pass.other().fixed->radius(), inside = pass.overlap(touch.sample);
    const double gap = touch.gap + inside;
    const double middle = std::max(radius - inside, kLeastMiddle * radius);
    const double allowed = gap >= 0.0 ? gap + 0.5 * middle : 0.5 * std::max(gap + middle, 0.0);
    const double approach = -touch.normal.dot(way);
    if (approach * largest > allowed) largest = allowed / approach;
  };
  parts_->forPressing(x, [&](const SurfacePass& pass, const SurfaceTouch& touch,
                             const SurfaceSample& sample, double) { limit(pass, touch, sample); });
  const Moved moved = parts.moved(x);
  for (const SurfacePass& pass : parts.passes) {
    // Those outside may go half of what is left to the middle in, whatever their gap.
    const double reach = 2.0 * farthest * largest;
    if (reach <= 0.5 * kLeastMiddle * pass.other().fixed->radius()) continue;
    pass.forTouches(x, moved, reach, [&](const SurfaceTouch& touch, const SurfaceSample& sample) {
      limit(pass, touch, sample);
    });
  }
  // A sample that is already in the middle must not bring the solve to a stand.
  return std::max(largest, 1e-3);
}

}  // namespace palpate::contact
