// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "palpate/contact/segment_tracker.h"
#include "palpate/io/json.h"
#include "palpate/organs/organs.h"
#include "parts.h"

namespace palpate::models {
namespace {

constexpr double kDepth = 0.008, kLength = 0.2;   // below the top, and of the tool [m]
constexpr double kCircle = 0.015, kWay = 2.5e-4;  // radius, and way in a cycle [m]

struct Place {
  Vec3 handle, tip;
};

// Around the right lobe's top, upright.
std::vector<Place> circle(const Points& X) {
  Eigen::Index top = 0;
  X.row(2).maxCoeff(&top);
  const Vec3 middle = X.col(top) - kDepth * Vec3::UnitZ();
  const int count = static_cast<int>(2.0 * M_PI * kCircle / kWay);
  std::vector<Place> places;
  for (int k = 0; k < count; ++k) {
    const double a = 2.0 * M_PI * k / count;
    const Vec3 tip = middle + kCircle * Vec3(std::cos(a), std::sin(a), 0.0);
    places.push_back({tip + kLength * Vec3::UnitZ(), tip});
  }
  return places;
}

// Of one go, of the quickest of several [s].
double quickest(bool quick, const std::function<void()>& go) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < (quick ? 2 : 20); ++k) {
    const auto begin = std::chrono::steady_clock::now();
    go();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    least = std::min(least, took.count());
  }
  return least;
}

std::string trackedAt(double edge, bool quick) {
  const mesh::SurfaceMesh surface = organs::makeOrgan("liver", edge);
  const Points& X = surface.points;
  contact::SegmentTracker tracker(X, surface.triangles);
  const std::vector<Place> places = circle(X);
  const auto count = static_cast<double>(places.size());
  std::vector<contact::SegmentHit> hits;
  std::vector<int> found;
  const double query = quickest(quick, [&] {
    found.clear();
    for (const Place& p : places) {
      tracker.find(X, p.handle, p.tip, &hits);
      found.push_back(hits.empty() ? -1 : hits.back().triangle);
    }
  });
  const double fit = quickest(quick, [&] { tracker.fit(X); });
  const contact::SegmentTracker::Counts before = tracker.counts();
  int other = 0;  // than the tree says
  const double walk = quickest(quick, [&] {
    int last = found.front();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto hit = tracker.walk(X, places[k].handle, places[k].tip, last);
      if (!hit) throw std::runtime_error("a walk over the liver is lost");
      last = hit->triangle;
      other += last == found[k] ? 0 : 1;
    }
  });
  const contact::SegmentTracker::Counts after = tracker.counts();
  io::JsonMembers members;
  members.add("triangles", static_cast<double>(surface.triangles.cols()));
  members.add("query", query / count);
  members.add("fit", fit);
  members.add("walk", walk / count);
  members.add("steps", static_cast<double>(after.steps - before.steps) /
                           static_cast<double>(after.walks - before.walks));
  members.add("other", static_cast<double>(other));
  return members.object();
}

}  // namespace

std::string tracking(bool quick) {
  std::string rows;
  for (const double edge : {0.03, 0.02, 0.01, 0.005, 0.0025}) {
    if (quick && edge < 0.01) break;
    rows += (rows.empty() ? "" : ", ") + trackedAt(edge, quick);
  }
  io::JsonMembers members;
  members.add("surfaces", "[" + rows + "]");
  return members.object();
}

}  // namespace palpate::models
