// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_tables.h"

#include "palpate/base/atomic_file.h"
#include "palpate/base/number.h"

namespace palpate::cli {
namespace {

std::string row(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + formatNumber(value);
  return text + "\n";
}

}  // namespace

void writeSweep(const std::string& file, const skin::TwoLayerBlock& block,
                const std::vector<skin::SweepPoint>& points) {
  std::string text =
      "set,nx,nz,layer1_rows,fraction,ratio,depth,published_error_mm,mean_square_mm2,rms_mm,max_mm,"
      "force,inversion_depth,bone_depth\n";
  for (std::size_t set = 0; set < skin::kProfileSets; ++set) {
    for (const skin::SweepPoint& p : points) {
      const skin::SetFit& fit = p.sets[set];
      text += row({static_cast<double>(set + 1), static_cast<double>(block.columns),
                   static_cast<double>(block.rows), static_cast<double>(p.upper_rows),
                   static_cast<double>(p.upper_rows) / block.rows, p.stiffness_ratio, fit.depth,
                   1e3 * fit.errors.published, 1e6 * fit.errors.mean_square, 1e3 * fit.errors.rms,
                   1e3 * fit.errors.largest, fit.force, p.inversion_depth, p.bone_depth});
    }
  }
  writeFileAtomically(file, text);
}

void writeProfiles(const std::string& file, const skin::UnitIndentation& unit,
                   const std::vector<double>& depths) {
  std::string text = "set,radius,measured,model\n";
  for (std::size_t set = 0; set < depths.size(); ++set) {
    const skin::MeasuredProfile& profile = skin::measuredProfile(static_cast<int>(set) + 1);
    for (int k = 0; k < profile.size(); ++k) {
      text += row({static_cast<double>(set + 1), profile.radius(k), profile.depth(k),
                   skin::surfaceDepth(unit, depths[set], profile.radius(k))});
    }
  }
  writeFileAtomically(file, text);
}

void writeBlock(const std::string& nodes, const std::string& triangles,
                const skin::UnitIndentation& unit) {
  std::string text = "x,z,ux_by_depth,uz_by_depth\n";
  for (Eigen::Index i = 0; i < unit.mesh.points.cols(); ++i) {
    text += row({unit.mesh.points(0, i), unit.mesh.points(1, i), unit.displacement(0, i),
                 unit.displacement(1, i)});
  }
  writeFileAtomically(nodes, text);
  text = "a,b,c,layer\n";
  for (std::size_t t = 0; t < unit.mesh.triangles.size(); ++t) {
    for (const int node : unit.mesh.triangles[t]) text += std::to_string(node) + ",";
    text += std::to_string(unit.mesh.materials[t] + 1) + "\n";
  }
  writeFileAtomically(triangles, text);
}

void writePublished(const std::string& file, const std::vector<skin::PublishedFigure>& figures) {
  std::string text = "table,set,nx,nz,layer1_rows,el_f,printed,ours\n";
  for (const skin::PublishedFigure& f : figures) {
    text += f.table + "," +
            row({static_cast<double>(f.set), static_cast<double>(f.columns),
                 static_cast<double>(f.rows), static_cast<double>(f.upper_rows), f.stiffness_ratio,
                 f.printed, f.ours});
  }
  writeFileAtomically(file, text);
}

}  // namespace palpate::cli
