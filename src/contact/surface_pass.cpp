// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_pass.h"

#include <cmath>

namespace palpate::contact {
namespace {

// Nearer to each other at rest than so many mean edges, parts of one surface are neighbours.
constexpr double kNeighbours = 2.0;
// Nearer than that to an edge or a corner [m], the direction from there is that of the surface.
constexpr double kOnIt = 1e-9;
// So much farther than samples are found, in parts of that, they are looked for.
constexpr double kAhead = 0.5;
// Boxes and triangles round distances apart.
constexpr double kRounding = 1.0 + 1e-12;

TriangleTree::Box around(const Vec3& p) { return TriangleTree::Box(p, p); }

}  // namespace

SurfacePass::SurfacePass(const MovingSurface* feels, const MovingSurface* other)
    : feels_(feels), other_(other) {
  const std::vector<SurfaceSample>& samples = feels_->fixed->samples();
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (patches_.empty() || samples[s].nodes != patches_.back().nodes) {
      patches_.push_back({samples[s].nodes, static_cast<int>(s), 0});
    }
    patches_.back().end = static_cast<int>(s) + 1;
  }
  candidates_.reserve(samples.size());
  overlaps_.assign(samples.size(), 0.0);
  clear_.resize(samples.size());
  deepest_ = other_->fixed->depth();
  if (!self()) {
    findOverlaps();
  } else {
    // Far less than neighbours are apart: a body's own far side is not mistaken for a fold.
    deepest_ = std::min({deepest_, other_->fixed->radius(), other_->fixed->meanEdge()});
  }
}

// Of samples outside the other one's box there is none.
void SurfacePass::findOverlaps() {
  const ContactSurface& other = *other_->fixed;
  std::vector<TriangleTree::Box> boxes;
  other.tree().fit(other.atRest(), other.triangles(), &boxes);
  const std::vector<SurfaceSample>& samples = feels_->fixed->samples();
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Vec3 p = samples[s].position(feels_->fixed->atRest());
    if (!boxes[0].contains(p)) continue;
    SurfaceTouch touch;
    const Near any{std::numeric_limits<double>::infinity(), -1};
    touch.triangle = nearest(p, other.atRest(), boxes, {}, any, [](int) { return true; }).triangle;
    if (touch.triangle < 0) continue;
    signTouch(p, other.atRest(), &touch);
    overlaps_[s] = std::max(0.0, -touch.gap);
  }
}

double SurfacePass::distanceTo(int triangle, const Vec3& p,
                               const Eigen::Ref<const Points>& x) const {
  const Eigen::Vector3i corners = other_->fixed->triangles().col(triangle);
  const TrianglePoint near =
      nearestOnTriangle(p, x.col(corners[0]), x.col(corners[1]), x.col(corners[2]));
  return (near.point - p).norm();
}

// The nearest triangle, if it is nearer than `best`, in which case no triangle need be known. Boxes
// are of where no point was farther than `moved` from where it is.
template <class Allowed>
SurfacePass::Near SurfacePass::nearest(const Vec3& p, const Eigen::Ref<const Points>& x,
                                       const std::vector<TriangleTree::Box>& boxes,
                                       const Moved& moved, Near best,
                                       const Allowed& allowed) const {
  other_->fixed->tree().forNear(
      boxes, around(p - moved.shift), [&] { return (best.distance + moved.rest) * kRounding; },
      [&](int t) {
        if (t == best.triangle || !allowed(t)) return;
        const Near found{distanceTo(t, p, x), t};
        if (found < best) best = found;
      });
  return best;
}

// Fills all but the sample of a touch whose triangle is known.
void SurfacePass::signTouch(const Vec3& p, const Eigen::Ref<const Points>& x,
                            SurfaceTouch* touch) const {
  const ContactSurface& other = *other_->fixed;
  const Mat3 c = other.corners(x, touch->triangle);
  touch->near = nearestOnTriangle(p, c.col(0), c.col(1), c.col(2));
  const Vec3 way = p - touch->near.point;
  touch->normal = other.pseudonormal(x, touch->triangle, touch->near);
  touch->gap = way.dot(touch->normal);
  if (touch->near.feature == Feature::kFace) return;
  const double distance = way.norm(), side = touch->gap < 0.0 ? -1.0 : 1.0;
  touch->gap = side * distance;
  if (distance > kOnIt) touch->normal = way / touch->gap;
}

// Whether a sample, at P at rest, and a triangle of the same surface were apart there.
bool SurfacePass::mayFeel(const SurfaceSample& sample, const Vec3& P, int triangle) const {
  const ContactSurface& surface = *other_->fixed;
  const double least = kNeighbours * surface.meanEdge();
  const double middle = (surface.middle(triangle) - P).norm();
  if (middle < least) return false;
  for (int k = 0; k < 3; ++k) {
    if ((surface.triangles().col(triangle).array() == sample.nodes[k]).any()) return false;
  }
  return middle >= least + surface.size(triangle) ||
         distanceTo(triangle, P, surface.atRest()) >= least;
}

// Whether samples of a patch may feel a triangle within reach of its box, as far as one sees at
// once: none that is nearer at rest than it would have to be, wherever on both one looks.
bool SurfacePass::mayFeelAny(const Patch& patch, const TriangleTree::Box& box, double reach) const {
  const ContactSurface& other = *other_->fixed;
  bool any = false;
  const Points& X = feels_->fixed->atRest();
  const Vec3 a = X.col(patch.nodes[0]), b = X.col(patch.nodes[1]), c = X.col(patch.nodes[2]);
  const double least = kNeighbours * other.meanEdge();
  other.tree().forNear(
      other_->boxes, box, [&] { return any ? -1.0 : reach; },
      [&](int t) {
        const Vec3 there = other.middle(t);
        any = any || !self() ||
              std::max({(a - there).norm(), (b - there).norm(), (c - there).norm()}) >= least;
      });
  return any;
}

// Whether a triangle around the nearest point is excluded from self-contact: the side of the
// surface is unknown there.
bool SurfacePass::isAtExcludedTriangle(const SurfaceSample& sample,
                                       const SurfaceTouch& touch) const {
  bool border = false;
  const Vec3 P = sample.position(feels_->fixed->atRest());
  other_->fixed->forAround(touch.triangle, touch.near,
                           [&](int t) { border = border || !mayFeel(sample, P, t); });
  return border;
}

bool SurfacePass::allClear(const Patch& patch, double gap, double depth) const {
  return std::all_of(clear_.begin() + patch.begin, clear_.begin() + patch.end,
                     [&](const Clear& clear) { return clear.holds(gap, depth); });
}

void SurfacePass::search(const Points& x, double way, double moved) {
  candidates_.clear();
  region_.setEmpty();
  const double deepest = deepest_ + 2.0 * way;
  const Eigen::Ref<const Points> own = feels_->part(x);
  for (Clear& clear : clear_) clear.distance -= 2.0 * kRounding * moved;
  for (const Patch& patch : patches_) {
    if (allClear(patch, 2.0 * way, deepest)) continue;
    TriangleTree::Box box = around(own.col(patch.nodes[0]));
    for (int k = 1; k < 3; ++k) box.extend(Vec3(own.col(patch.nodes[k])));
    if (!mayFeelAny(patch, box, deepest)) continue;
    for (int s = patch.begin; s < patch.end; ++s) {
      const Clear& clear = clear_[static_cast<std::size_t>(s)];
      if (!clear.holds(2.0 * way, deepest)) searchSample(s, x, way, deepest);
    }
  }
}

// While it is searched for, a gap changes by two ways at most.
void SurfacePass::searchSample(int s, const Points& x, double way, double deepest) {
  const SurfaceSample& sample = feels_->fixed->samples()[static_cast<std::size_t>(s)];
  const Vec3 p = position(sample, x), P = sample.position(feels_->fixed->atRest());
  const Eigen::Ref<const Points> there = other_->part(x);
  // Farther than is asked for, so that it need not be done again soon.
  Near near{deepest + kAhead * deepest_, -1};
  Clear& clear = clear_[static_cast<std::size_t>(s)];
  if (clear.triangle >= 0) {
    near = std::min(near, {distanceTo(clear.triangle, p, there), clear.triangle});
  }
  near = nearest(p, there, other_->boxes, {}, near,
                 [&](int t) { return !self() || mayFeel(sample, P, t); });
  clear = {near.distance, false, near.triangle};
  if (near.distance >= deepest) return;
  SurfaceTouch touch;
  touch.triangle = near.triangle;
  signTouch(p, there, &touch);
  clear.outside = touch.gap > 0.0;
  if (touch.gap > 2.0 * way) return;
  candidates_.push_back({s, near.triangle, touch.gap});
  region_.extend(p);
}

// A nearest triangle is not farther than deepest_ and two ways, and may become it while it comes
// nearer by four.
void SurfacePass::addNodes(double way, std::vector<int>* nodes) const {
  if (candidates_.empty()) return;
  const std::vector<SurfaceSample>& samples = feels_->fixed->samples();
  for (const Candidate& c : candidates_) {
    for (int k = 0; k < 3; ++k) {
      nodes->push_back(feels_->first + samples[static_cast<std::size_t>(c.sample)].nodes[k]);
    }
  }
  other_->fixed->tree().forNear(
      other_->boxes, region_, [&] { return deepest_ + 6.0 * way; },
      [&](int t) {
        for (int k = 0; k < 3; ++k) {
          nodes->push_back(other_->first + other_->fixed->triangles()(k, t));
        }
      });
}

bool SurfacePass::measure(const Candidate& c, const Points& x, const Moved& moved,
                          SurfaceTouch* touch) const {
  const Eigen::Ref<const Points> there = other_->part(x);
  touch->sample = c.sample;
  const SurfaceSample& sample = feels_->fixed->samples()[static_cast<std::size_t>(c.sample)];
  const Vec3 p = position(sample, x), P = sample.position(feels_->fixed->atRest());
  const Near before{distanceTo(c.triangle, p, there), c.triangle};
  touch->triangle = nearest(p, there, other_->boxes, moved, before, [&](int t) {
                      return !self() || mayFeel(sample, P, t);
                    }).triangle;
  signTouch(p, there, touch);
  if (!self() || touch->gap >= 0.0) return true;
  return touch->gap > -deepest_ && !isAtExcludedTriangle(sample, *touch);
}

}  // namespace palpate::contact
