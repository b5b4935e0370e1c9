// SPDX-License-Identifier: GPL-3.0-or-later
#include "fibre_frames.h"

#include <Eigen/Geometry>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/vector_text.h"

namespace palpate::scene {
namespace {

constexpr double kParallel = 1.0e-6;  // sine of the angle

Vec3 axisLeastAlong(const Vec3& f) {
  int axis = 0;
  f.cwiseAbs().minCoeff(&axis);
  return Vec3::Unit(axis);
}

}  // namespace

FibreFrames::FibreFrames(const FibreConfig& fibres, const mesh::TetMesh& mesh,
                         const std::string& file, const std::string& key)
    : config_(fibres), file_(file), key_(key) {
  if (!fibres.field.empty()) field_ = find(mesh, "field", fibres.field);
  if (!fibres.sheet_field.empty()) sheet_field_ = find(mesh, "sheet_field", fibres.sheet_field);
}

const Eigen::MatrixXd* FibreFrames::find(const mesh::TetMesh& mesh, const std::string& key,
                                         const std::string& name) const {
  const auto found = mesh.cell_data.find(name);
  if (found != mesh.cell_data.end() && found->second.rows() == 3) return &found->second;
  std::vector<std::string> known;
  for (const auto& [other, values] : mesh.cell_data) {
    if (values.rows() == 3) known.push_back(other);
  }
  throw InputError(file_, key_ + "." + key, name,
                   "must be cell data of three components in the mesh file (.vtk, .vtu); it has " +
                       (known.empty() ? "none" : joinNames(known)));
}

void FibreFrames::fail(const std::string& key, Eigen::Index tet, const Vec3& value,
                       const std::string& allowed) const {
  throw InputError(file_, key_ + "." + key, vectorText(value),
                   "of tetrahedron " + std::to_string(tet + 1) + " (counted from 1) " + allowed);
}

Mat3 FibreFrames::frame(Eigen::Index tet) const {
  const Vec3 f = field_ ? Vec3(field_->col(tet)) : config_.direction.value();
  const char* const fibre_key = field_ ? "field" : "direction";
  if (!f.allFinite() || !(f.norm() > 0.0)) fail(fibre_key, tet, f, "must be finite and not zero");
  Mat3 frame;
  frame.col(0) = f.normalized();
  Vec3 s = axisLeastAlong(frame.col(0));
  if (sheet_field_ || config_.sheet) {
    s = sheet_field_ ? Vec3(sheet_field_->col(tet)) : *config_.sheet;
    const char* const sheet_key = sheet_field_ ? "sheet_field" : "sheet";
    if (!s.allFinite() || !(s.norm() > 0.0)) fail(sheet_key, tet, s, "must be finite and not zero");
    if (!(frame.col(0).cross(s.normalized()).norm() > kParallel)) {
      fail(sheet_key, tet, s, "must not lie along the fibre " + vectorText(f));
    }
  }
  frame.col(1) = (s - s.dot(frame.col(0)) * frame.col(0)).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

}  // namespace palpate::scene
