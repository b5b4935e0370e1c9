// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/SVD>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <vector>

#include "cloth_springs.h"
#include "palpate/contact/layer_contact.h"
#include "palpate/io/json.h"
#include "palpate/material/material.h"
#include "palpate/springs/springs_file.h"
#include "palpate/tissue/model_list.h"
#include "parts.h"

namespace palpate::models {
namespace {

// Flat: no point farther from the plane nearest to all of them than this part of the length.
constexpr double kFlat = 0.02;
constexpr double kPoisson = 0.3;

struct Roll {
  tissue::ClothSettings cloth;
  double step;                                      // [s]
  double young_modulus, density, drag;              // [Pa], [kg/m^3], [1/s]
  const springs::SpringNetwork* springs = nullptr;  // null: as the model has them
  Eigen::Matrix3Xi triangles;
  int side = 0;
};

double outOfPlane(const Points& x) {
  const Points from_middle = x.colwise() - x.rowwise().mean();
  const Eigen::JacobiSVD<Mat3> svd(Mat3(from_middle * from_middle.transpose()),
                                   Eigen::ComputeFullU);
  return (svd.matrixU().col(2).transpose() * from_middle).cwiseAbs().maxCoeff();
}

std::unique_ptr<tissue::TissueModel> makeRoll(const Roll& roll) {
  tissue::OrganDescription organ;
  organ.name = "roll";
  organ.cloth = roll.cloth;
  organ.damping = {roll.drag, 0.0};
  const material::Solid solid{
      material::makeMaterial(
          "neo_hookean", {{"young_modulus", {roll.young_modulus}}, {"poisson_ratio", {kPoisson}}}),
      roll.density,
      {}};
  organ.composition = [&](const mesh::TetMesh&) { return fem::Composition{{solid}, {}, {}}; };
  organ.surroundings = [](const mesh::TetMesh& mesh) {
    return tissue::Surroundings(fem::FreeMask::Ones(3, mesh.numPoints()));
  };
  const std::string file =
      (std::filesystem::temp_directory_path() / "palpate_models_unrolling.csv").string();
  if (roll.springs != nullptr) {
    organ.sheet = [&] { return mesh::SurfaceMesh{roll.springs->points, roll.triangles}; };
    springs::writeSprings(file, *roll.springs);
    organ.springs.constants = "file";
    organ.springs.file = file;
  }
  tissue::ModelDescription description;
  description.organs.push_back(organ);
  description.settings.max_newton_iterations = 100;
  auto model = tissue::makeModel("cloth", description);
  std::filesystem::remove(file);
  return model;
}

// The middle line of the sheet, y and z [m].
std::string profile(const Points& x, const Points& rest) {
  const double middle = 0.5 * (rest.row(0).minCoeff() + rest.row(0).maxCoeff());
  std::vector<double> y, z;
  double row = -1.0, nearest = 0.0;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double off = std::abs(rest(0, i) - middle);
    if (rest(1, i) > row + 1e-9) {
      row = rest(1, i);
      nearest = 1e9;
      y.push_back(0.0);
      z.push_back(0.0);
    }
    if (off < nearest) nearest = off, y.back() = x(1, i), z.back() = x(2, i);
  }
  const auto list = [](const std::vector<double>& v) {
    return io::json(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  return "[" + list(y) + ", " + list(z) + "]";
}

// Lets it go for `longest` [s]; flat is from when it stays so.
std::string letGo(const Roll& roll, double longest, const std::vector<double>& looks) {
  const auto model = makeRoll(roll);
  Roll flat = roll;
  flat.cloth.rolled.reset();
  const Points rest = makeRoll(flat)->positions();
  const mesh::CellMesh at_rest = model->cells(0);
  const Points& X = at_rest.points;
  const contact::LayerContact gaps(X, model->surfaceState(0).triangles,
                                   Eigen::VectorXd::Ones(X.cols()),
                                   {0.0, roll.cloth.rolled->gap_most, 1.0});
  const double length = rest.row(1).maxCoeff() - rest.row(1).minCoeff();
  const double row = X(1, X.cols() - 1) - 1e-9;
  const auto open = [&](const Points& x) {  // from the first row to the last one
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    int firsts = 0, lasts = 0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (X(1, i) < X(1, 0) + 1e-9) first += x.col(i), ++firsts;
      if (X(1, i) > row) last += x.col(i), ++lasts;
    }
    return (last / lasts - first / firsts).norm();
  };
  const double whole = open(rest);
  std::vector<double> t, extents;
  std::string profiles;
  std::size_t look = 0;
  double flat_at = -1.0, computing = 0.0, computing_flat = 0.0, least = 1e9;
  int failed = 0;
  for (int k = 0; k * roll.step <= longest + 1e-9; ++k) {
    const Points& x = model->positions();
    if (k % 4 == 0) t.push_back(k * roll.step), extents.push_back(open(x) / whole);
    if (look < looks.size() && k * roll.step >= looks[look] - 1e-9) {
      profiles += (profiles.empty() ? "" : ", ") + profile(x, X);
      ++look;
    }
    if (outOfPlane(x) > kFlat * length) {
      flat_at = -1.0;
    } else if (flat_at < 0.0) {
      flat_at = k * roll.step;
      computing_flat = computing;
    }
    least = std::min(least, gaps.leastGap(x));
    const auto begin = std::chrono::steady_clock::now();
    failed += !model->step({}, roll.step).ok();
    computing += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  const auto list = [](const std::vector<double>& v) {
    return io::json(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  io::JsonMembers out;
  out.add("masses", static_cast<double>(X.cols()));
  out.add("t", list(t));
  out.add("open", list(extents));
  out.add("profiles", "[" + profiles + "]");
  out.add("flat_at", flat_at);
  out.add("computing_flat", computing_flat);
  out.add("computing", computing);
  out.add("out_of_plane", outOfPlane(model->positions()) / length);
  out.add("least_gap", least);
  out.add("failed", failed);
  return out.object();
}

Eigen::Matrix3Xi gridTriangles(int side, bool shifted) {
  Eigen::Matrix3Xi all(3, 2 * (side - 1) * (side - 1));
  Eigen::Index t = 0;
  for (int j = 0; j + 1 < side; ++j) {
    for (int i = 0; i + 1 < side; ++i) {
      const int a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      const bool odd = shifted && j % 2 == 1;
      all.col(t++) << a, b, odd ? d : c;
      all.col(t++) << (odd ? a : b), d, c;
    }
  }
  return all;
}

std::string both(const Roll& a, const Roll& b, double longest, const std::vector<double>& looks) {
  io::JsonMembers out;
  out.add("without", letGo(a, longest, looks));
  out.add("with", letGo(b, longest, looks));
  out.add("looks",
          io::json(Eigen::Map<const Eigen::VectorXd>(looks.data(), Eigen::Index(looks.size()))));
  out.add("flat", kFlat);
  out.add("drag", a.drag);
  out.add("gap_least", a.cloth.rolled->gap_least);
  return out.object();
}

// 15 x 15 masses, 1 cm apart, of 200 g/m^2; 4.0 being newtons a metre. The plate as which the newer
// ones bend, for what keeps layers apart.
std::string demonstration(bool quick) {
  constexpr double kSpacing = 0.01, kArea = 0.2, kThickness = 5e-4;
  const int side = quick ? 11 : 15;
  const auto older = olderSheet(kSpacing, side, kArea), newer = newerSheet(kSpacing, side, kArea);
  Roll roll;
  roll.step = 1e-3;
  roll.cloth.thickness = kThickness;
  roll.cloth.rolled = tissue::RolledSettings{0.022, 0.05, 1e-3, 5e-3};
  roll.young_modulus = newerBending(kSpacing) * 12.0 * (1.0 - kPoisson) / std::pow(kThickness, 3);
  roll.density = kArea / kThickness;
  roll.drag = 20.0;
  roll.side = side;
  Roll with = roll;
  roll.springs = &older;
  roll.triangles = gridTriangles(side, false);
  with.springs = &newer;
  with.triangles = gridTriangles(side, true);
  return both(roll, with, quick ? 0.4 : 3.0, {0.0, 0.02, 0.05, 0.1, 0.2});
}

// Polypropylene of 90 g/m^2, rolled into a tube of 16 mm.
std::string polypropylene(bool quick) {
  Roll roll;
  roll.step = 2.5e-4;
  roll.cloth.thickness = 5e-4;
  roll.cloth.width = quick ? 0.02 : 0.04;
  roll.cloth.length = quick ? 0.05 : 0.1;
  roll.cloth.spacing = 2.5e-3;
  roll.cloth.rolled = tissue::RolledSettings{8e-3, 0.03, 5e-4, 1.2e-3};
  roll.young_modulus = 1e7;
  roll.density = 180.0;
  roll.drag = 200.0;
  Roll with = roll;
  roll.cloth.preload = false;
  return both(roll, with, quick ? 0.05 : 0.2, {0.0, 0.005, 0.01, 0.02, 0.06});
}

}  // namespace

std::string unrolling(bool quick) {
  io::JsonMembers out;
  out.add("demonstration", demonstration(quick));
  out.add("polypropylene", polypropylene(quick));
  return out.object();
}

}  // namespace palpate::models
