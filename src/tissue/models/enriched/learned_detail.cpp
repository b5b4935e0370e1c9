// SPDX-License-Identifier: GPL-3.0-or-later
#include "learned_detail.h"

namespace palpate::tissue {
namespace {

// Sigma of residuals has no unit, that of displacements is in metres; spreads serve both.
enrichment::EnrichedShape learn(const EnrichedSettings& settings,
                                const enrichment::DeformationDatabase& database) {
  enrichment::FeatureSettings feature;
  feature.residual = settings.detail == "residual";
  feature.proportional = true;
  const double spread = enrichment::EnrichedShape(database, feature, 1.0).spread();
  return {database, feature, settings.sigma * (spread > 0.0 ? spread : 1.0)};
}

}  // namespace

LearnedDetail::LearnedDetail(const EnrichedSettings& settings,
                             const enrichment::DeformationDatabase& database, const Pose& X_WO,
                             const mesh::SurfaceMesh& body)
    : residual_(settings.detail == "residual"),
      R_WO_(X_WO.linear()),
      coarse_(X_WO * database.coarse.points.colwise().homogeneous()),
      coarse_places_(mesh::nearestSurfacePoints(body, coarse_)) {
  if (settings.detail != "none") shape_.emplace(learn(settings, database));
}

void LearnedDetail::gatherTools(const std::vector<TissueContact>& contacts) {
  for (Tool& tool : tools_) tool = {};
  for (const TissueContact& contact : contacts) {
    if (!contact.owner.isInstrument()) continue;
    const auto k = static_cast<std::size_t>(contact.owner.index);
    if (tools_.size() <= k) tools_.resize(k + 1);
    const double force = contact.force_W.norm();
    tools_[k].force += force;
    tools_[k].sum += force * contact.p_W;
  }
}

int LearnedDetail::nearestPoint(const Vec3& p_W) const {
  Eigen::Index nearest = 0;
  (coarse_ + moved_W_).colwise().operator-(p_W).colwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

void LearnedDetail::find(const std::vector<TissueContact>& contacts, const Points& u,
                         const FineSurface& fine, Points* detail) {
  detail->setZero(3, fine.numPoints());
  if (!shape_) return;
  gatherTools(contacts);
  bool touched = false;
  for (const Tool& tool : tools_) {
    if (!(tool.force > 0.0)) continue;
    if (!touched) {
      mesh::interpolate(coarse_places_, u, &moved_W_);
      moved_O_ = R_WO_.transpose().lazyProduct(moved_W_);
    }
    touched = true;
    shape_->predictDetail(nearestPoint(tool.sum / tool.force), moved_O_, &learned_);
    *detail += learned_;
  }
  if (!touched) return;
  learned_ = *detail;
  *detail = R_WO_.lazyProduct(learned_);
  if (residual_) return;
  // Displacements replace those of the coarse surface, which may differ from the interpolation of
  // the samples' coarse points.
  shape_->interpolate(moved_O_, &learned_);
  *detail += R_WO_.lazyProduct(learned_);
  fine.carried(u, &carried_);
  *detail -= carried_;
}

}  // namespace palpate::tissue
