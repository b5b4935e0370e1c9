// SPDX-License-Identifier: GPL-3.0-or-later
#include "hybrid_elasticity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "loop_step.h"
#include "tissue/models/tensor_mass/tensors.h"

namespace palpate::tissue {
namespace {

std::vector<int> others(const std::vector<int>& some, Eigen::Index count) {
  std::vector<int> all(static_cast<std::size_t>(count)), left;
  std::iota(all.begin(), all.end(), 0);
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(left));
  return left;
}

LinearPart::Load loadOf(const Vec3& gravity, const Eigen::VectorXd& masses,
                        const std::vector<char>& acted) {
  Points weights = gravity * masses.transpose();
  return {Eigen::Map<Eigen::VectorXd>(weights.data(), weights.size()), acted};
}

}  // namespace

HybridElasticity::HybridElasticity(const mesh::TetMesh& mesh, const fem::Composition& composition,
                                   const std::vector<int>& region, const fem::FreeMask& free,
                                   const Vec3& gravity, const std::vector<char>& acted)
    : CellElasticity(mesh, composition),
      region_(region),
      inertia_(kInertia * CellElasticity::masses()),
      loads_(Points::Zero(3, mesh.numPoints())) {
  const std::vector<int> rest = others(region, mesh.numTets());
  if (!rest.empty()) {
    rest_.emplace(mesh, composition, rest, volumes(), free,
                  loadOf(gravity, CellElasticity::masses(), acted));
    touched_.emplace(&*rest_);
    loads_ = rest_->weights();
    answered_ = Eigen::VectorXd::Zero(rest_->underWeights().size());
  }
  tensors_ = makeMatrix().blocks();
  std::vector<char> moves(static_cast<std::size_t>(mesh.numPoints()), 0);
  for (const int t : region) {
    addTensors(mesh, t, volumes()[t], composition.solid(t), &tensors_);
    const double quarter = 0.25 * composition.solid(t).density * volumes()[t];
    for (int k = 0; k < 4; ++k) {
      inertia_[mesh.tets(k, t)] += (1.0 - kInertia) * quarter;
      moves[static_cast<std::size_t>(mesh.tets(k, t))] = 1;
    }
  }
  together_ = tensors_;
  if (!rest_) return;
  const std::vector<int>& kept = rest_->kept();
  for (std::size_t a = 0; a < kept.size(); ++a) {
    num_border_ += moves[static_cast<std::size_t>(kept[a])];
    for (std::size_t b = 0; b < kept.size(); ++b) {
      together_.block(together_.find(kept[a], kept[b])) += rest_->stiffness().block<3, 3>(
          3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b));
    }
    moves[static_cast<std::size_t>(kept[a])] = 1;
  }
  for (int i = 0; i < numNodes(); ++i) {
    if (moves[static_cast<std::size_t>(i)]) unknowns_.push_back(i);
  }
  measureInertia();
}

void HybridElasticity::measureInertia() {
  floats_ = rest_->fixed().empty() && !unknowns_.empty();
  if (!floats_) return;
  for (const int i : unknowns_) middle_ += mesh().points.col(i);
  middle_ /= static_cast<double>(unknowns_.size());
  Mat3 inertia = Mat3::Zero();
  for (const int i : unknowns_) {
    const Vec3 arm = armOf(i);
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
  }
  inverse_inertia_ = inertia.inverse();
}

fem::Stiffness HybridElasticity::makeMatrix() const {
  std::vector<std::pair<int, int>> pairs;
  for (const int t : region_) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) pairs.emplace_back(mesh().tets(a, t), mesh().tets(b, t));
    }
  }
  if (rest_) {
    const std::vector<int>& kept = rest_->kept();
    for (std::size_t a = 0; a < kept.size(); ++a) {
      for (std::size_t b = a + 1; b < kept.size(); ++b) pairs.emplace_back(kept[a], kept[b]);
    }
  }
  return fem::Stiffness(fem::BlockMatrix(numNodes(), pairs));
}

void HybridElasticity::lookForTouches() {
  if (!contact_ || !touched_) return;
  contact_->candidateNodes(&candidates_);
  touched_->set(candidates_);
}

// Moved and turned a little as a whole it is not strained, but dense sums would round that.
void HybridElasticity::removeRigidMotion(Points* u) const {
  Vec3 way = Vec3::Zero(), moment = Vec3::Zero();
  for (const int i : unknowns_) way += u->col(i);
  way /= static_cast<double>(unknowns_.size());
  for (const int i : unknowns_) moment += armOf(i).cross(Vec3(u->col(i) - way));
  const Vec3 turn = inverse_inertia_ * moment;
  for (const int i : unknowns_) u->col(i) -= way + turn.cross(armOf(i));
}

const Eigen::VectorXd& HybridElasticity::displacementsOfRest(const Points& x) {
  if (loops_) return imposed_;
  rest_->keptOf(x, &u_c_);
  return u_c_;
}

double HybridElasticity::energy(const Points& x) { return gradient(x, &f_); }

double HybridElasticity::gradient(const Points& x, Points* g) {
  lookForTouches();
  u_ = x - mesh().points;
  double energy = loads_.cwiseProduct(u_).sum();
  if (floats_) removeRigidMotion(&u_);
  (loops_ ? tensors_ : together_).multiply(u_, g);
  energy += 0.5 * g->cwiseProduct(u_).sum();
  *g += loads_;
  if (!rest_) return energy;
  energy += (loops_ ? imposed_energy_ : 0.0) - rest_->energyOfWeights();
  return energy + touched_->addGradient(x, displacementsOfRest(x), !loops_, g);
}

void HybridElasticity::hessian(const Points&, fem::Tangent, fem::Stiffness* K) {
  const fem::BlockMatrix& from = loops_ ? tensors_ : together_;
  K->setZero();
  std::copy_n(from.values(), 9 * static_cast<std::ptrdiff_t>(from.numBlocks()),
              K->blocks().values());
  if (touched_) touched_->addPins(&K->blocks());
}

void HybridElasticity::Couplings::addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const {
  if (!all_.touched_) return;
  all_.lookForTouches();
  all_.touched_->addHessian(!all_.loops_, K);
}

double HybridElasticity::minJacobian(const Points& x) {
  x_ = x;
  if (rest_) {
    const Eigen::VectorXd& u = displacementsOfRest(x_);
    rest_->recover(u, touched_->places(), touched_->forces(x_, u), &x_);
  }
  return CellElasticity::minJacobian(x_);
}

Mat3 HybridElasticity::cauchyStress(const Points&, int t, const Mat3& F) {
  return hookeStress(composition().solid(t), F);
}

double HybridElasticity::energyOf(const Points& x, int t) {
  const Mat3 F = deformation(x, t);
  const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
  return 0.5 * volumes()[t] * hookeStress(composition().solid(t), F).cwiseProduct(strain).sum();
}

void HybridElasticity::recover(Points* x) {
  if (!rest_) return;
  const Eigen::VectorXd& u = displacementsOfRest(*x);
  const Eigen::Ref<const Eigen::VectorXd> e = touched_->forces(*x, u);
  answered_.setZero();
  for (std::size_t a = 0; a < touched_->places().size(); ++a) {
    answered_.segment<3>(3 * static_cast<Eigen::Index>(touched_->places()[a])) =
        e.segment<3>(3 * static_cast<Eigen::Index>(a));
  }
  rest_->recover(u, touched_->places(), e, x);
  touched_->pin(*x);
}

void HybridElasticity::recoverUntouched(Points* x) {
  if (!rest_) return;
  touched_->set({});
  recover(x);
}

void HybridElasticity::beginCycle(const Points& x) {
  if (!rest_) return;
  touched_->pin(x);
  if (!loops_) return;
  rest_->keptOf(x, &imposed_);
  exchange();
}

// The rest has the border's displacements, and the contact forces that it had.
void HybridElasticity::exchange() {
  loads_ = rest_->weights();
  of_border_.noalias() = rest_->stiffness() * imposed_;
  imposed_energy_ = 0.5 * of_border_.dot(imposed_);
  of_border_.noalias() -= rest_->transfer().transpose() * answered_;
  imposed_energy_ -= of_border_.dot(imposed_);  // what it is where the border is there
  const std::vector<int>& kept = rest_->kept();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    loads_.col(kept[k]) += of_border_.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
}

void HybridElasticity::beginLoop(const Points& x) {
  loops_ = rest_ && !rest_->kept().empty();
  relax(x);
}

double HybridElasticity::longestStepOfLoop(const fem::FreeMask& free, double damping) const {
  fem::FreeMask moves = fem::FreeMask::Zero(3, numNodes());
  for (const int t : region_) {
    for (int k = 0; k < 4; ++k) moves.col(mesh().tets(k, t)) = free.col(mesh().tets(k, t));
  }
  return longestLoopStep(together_, tensors_, inertia_, moves, damping);
}

void HybridElasticity::relax(const Points& x) {
  if (!loops_) return;
  answered_.setZero();
  rest_->keptOf(x, &imposed_);
  exchange();
}

void HybridElasticity::save(StateWriter* out) const {
  if (!loops_) return;
  out->put(imposed_);
  out->put(answered_);
}

void HybridElasticity::restore(StateReader* in) {
  if (!loops_) return;
  in->getSame(&imposed_);
  in->getSame(&answered_);
  exchange();
}

}  // namespace palpate::tissue
