// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampled_body.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>

namespace palpate::tissue {
namespace {

// h^2 of a whole over that of its parts: by theirs alone, what was parted would be joined at once.
constexpr double kOfTheWhole = 4.0;

}  // namespace

SampledBody::SampledBody(const mesh::TetMesh& mesh, const Pose& X_WO, const Points& surface,
                         const std::vector<Umbrella::Anchor>& held, const material::Moduli& moduli,
                         double density, const SamplingSettings& settings)
    : tree_(mesh, X_WO, settings.coarsest, settings.levels),
      X_surface_(surface),
      held_(held),
      umbrella_(moduli, density, settings.weights),
      settings_(settings),
      density_(density),
      contact_stiffness_(Eigen::VectorXd::Zero(surface.cols())) {
  reset();
}

void SampledBody::setContactStiffness(const Eigen::VectorXd& stiffness) {
  contact_stiffness_ = stiffness;
  rebuild();
}

void SampledBody::reset() {
  tree_.reset();
  rebuild();
  d.setZero(3, static_cast<Eigen::Index>(leaves_.size()));
  v.setZero(3, d.cols());
}

// What follows from which particles are in use.
void SampledBody::rebuild() {
  leaves_ = tree_.leafList();
  at_.assign(tree_.particles().size(), -1);
  masses.resize(static_cast<Eigen::Index>(leaves_.size()));
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    at_[static_cast<std::size_t>(leaves_[k])] = static_cast<int>(k);
    masses[static_cast<Eigen::Index>(k)] =
        density_ * tree_.particles()[static_cast<std::size_t>(leaves_[k])].volume;
  }
  // A leaf is held by all that is held in its cube.
  std::map<int, Umbrella::Anchor> held;
  for (const Umbrella::Anchor& part : held_) {
    const int leaf = at_[static_cast<std::size_t>(tree_.leafAt(part.X))];
    Umbrella::Anchor& sum =
        held.emplace(leaf, Umbrella::Anchor{leaf, Vec3::Zero(), Vec3::Zero()}).first->second;
    const double before = sum.area.norm(), more = part.area.norm();
    sum.X = (before * sum.X + more * part.X) / (before + more);
    sum.area += part.area;
  }
  std::vector<Umbrella::Anchor> anchors;
  anchors.reserve(held.size());
  for (const auto& [leaf, anchor] : held) anchors.push_back(anchor);
  umbrella_.build(tree_, leaves_, anchors);
  links_.build(X_surface_, tree_, leaves_);
  Eigen::VectorXd beside = Eigen::VectorXd::Zero(masses.size());
  alone_ = umbrella_.longestSteps(masses, beside).minCoeff();
  links_.addStiffness(contact_stiffness_, &beside);
  longest_ = umbrella_.longestSteps(masses, beside);
}

// Of values of the leaves, by least squares over the neighbours.
Mat3 SampledBody::slope(int leaf, const Points& values) const {
  const auto& particles = tree_.particles();
  const int self = leaves_[static_cast<std::size_t>(leaf)];
  const Vec3 X = particles[static_cast<std::size_t>(self)].X;
  Mat3 moments = Mat3::Zero(), product = Mat3::Zero();
  for (const int n : tree_.neighbours(self)) {
    const int k = at_[static_cast<std::size_t>(n)];
    if (k < 0) continue;
    const Vec3 way = particles[static_cast<std::size_t>(n)].X - X;
    const double w = 1.0 / way.squaredNorm();
    moments += w * way * way.transpose();
    product += w * (values.col(k) - values.col(leaf)) * way.transpose();
  }
  moments.diagonal().array() += 1e-9 * moments.trace();
  return product * moments.inverse();
}

bool SampledBody::adapt() {
  umbrella_.bend(d, &bends_);
  const auto& particles = tree_.particles();
  std::vector<int> parted, joined;
  std::vector<Mat3> slopes_d, slopes_v;  // before anything is parted
  if (bends_.maxCoeff() > settings_.refine_above) {
    for (int k = 0; k < static_cast<int>(leaves_.size()); ++k) {
      slopes_d.push_back(slope(k, d));
      slopes_v.push_back(slope(k, v));
    }
  }
  const std::vector<char> before = tree_.leaves();
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const auto& particle = particles[static_cast<std::size_t>(leaves_[k])];
    const bool still = tree_.leaves()[static_cast<std::size_t>(leaves_[k])] != 0;
    if (still && particle.num_children > 0 &&
        bends_[static_cast<Eigen::Index>(k)] > settings_.refine_above) {
      tree_.refine(leaves_[k], &parted);
    }
  }
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const int first = particles[p].first_child, count = particles[p].num_children;
    if (count == 0 || std::count(parted.begin(), parted.end(), static_cast<int>(p))) continue;
    bool calm = true;
    for (int c = first; c < first + count && calm; ++c) {
      calm = before[static_cast<std::size_t>(c)] &&
             kOfTheWhole * bends_[at_[static_cast<std::size_t>(c)]] < settings_.coarsen_below;
    }
    if (!calm || !tree_.canCoarsen(static_cast<int>(p))) continue;
    tree_.coarsen(static_cast<int>(p));
    joined.push_back(static_cast<int>(p));
  }
  if (parted.empty() && joined.empty()) return false;

  // By particle: leaves keep what they have, parts follow the slope around, wholes the mean.
  std::vector<Vec3> d_of(particles.size(), Vec3::Zero()), v_of(particles.size(), Vec3::Zero());
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    d_of[static_cast<std::size_t>(leaves_[k])] = d.col(static_cast<Eigen::Index>(k));
    v_of[static_cast<std::size_t>(leaves_[k])] = v.col(static_cast<Eigen::Index>(k));
  }
  part(parted, slopes_d, &d_of);
  part(parted, slopes_v, &v_of);
  for (const int p : joined) {
    const auto& whole = particles[static_cast<std::size_t>(p)];
    Vec3 sum_d = Vec3::Zero(), sum_v = Vec3::Zero();
    for (int c = whole.first_child; c < whole.first_child + whole.num_children; ++c) {
      const double volume = particles[static_cast<std::size_t>(c)].volume;
      sum_d += volume * d_of[static_cast<std::size_t>(c)];
      sum_v += volume * v_of[static_cast<std::size_t>(c)];
    }
    d_of[static_cast<std::size_t>(p)] = sum_d / whole.volume;
    v_of[static_cast<std::size_t>(p)] = sum_v / whole.volume;
  }
  rebuild();
  d.resize(3, static_cast<Eigen::Index>(leaves_.size()));
  v.resize(3, d.cols());
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    d.col(static_cast<Eigen::Index>(k)) = d_of[static_cast<std::size_t>(leaves_[k])];
    v.col(static_cast<Eigen::Index>(k)) = v_of[static_cast<std::size_t>(leaves_[k])];
  }
  return true;
}

// Coarser ones were parted first, so that what is a part itself has its value already; its slope is
// that of the whole.
void SampledBody::part(const std::vector<int>& parted, const std::vector<Mat3>& slopes,
                       std::vector<Vec3>* values) const {
  const auto& particles = tree_.particles();
  std::map<int, Mat3> of_parts;
  for (const int p : parted) {
    const int leaf = at_[static_cast<std::size_t>(p)];
    const Mat3 slope = leaf >= 0 ? slopes[static_cast<std::size_t>(leaf)] : of_parts.at(p);
    const auto& whole = particles[static_cast<std::size_t>(p)];
    for (int c = whole.first_child; c < whole.first_child + whole.num_children; ++c) {
      const Vec3 way = particles[static_cast<std::size_t>(c)].X - whole.X;
      (*values)[static_cast<std::size_t>(c)] = (*values)[static_cast<std::size_t>(p)] + slope * way;
      of_parts[c] = slope;
    }
  }
}

void SampledBody::save(StateWriter* out) const {
  out->put(tree_.leaves());
  out->put(d);
  out->put(v);
}

void SampledBody::restore(StateReader* in) {
  std::vector<char> leaves;
  in->get(&leaves);
  tree_.setLeaves(leaves);
  rebuild();
  d.resize(3, static_cast<Eigen::Index>(leaves_.size()));
  v.resize(3, d.cols());
  in->getSame(&d);
  in->getSame(&v);
}

}  // namespace palpate::tissue
