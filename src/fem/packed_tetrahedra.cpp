// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_tetrahedra.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "palpate/base/for_all.h"

namespace palpate::fem {
namespace {

std::optional<TetLaw> kernelLaw(const material::Material& material) {
  const std::string law = material::lawName(material);
  if (law == "neo_hookean") return TetLaw::kNeoHookean;
  if (law == "stable_neo_hookean") return TetLaw::kStableNeoHookean;
  return std::nullopt;
}

bool sameBits(const Points& a, const Points& b) {
  return a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

// Largest distance of a straight edge's mid-edge node from the midpoint, over the edge length [-].
constexpr double kStraight = 1e-9;

bool isStraight(const mesh::TetMesh& mesh) {
  for (Eigen::Index e = 0; e < mesh.midnodes.cols(); ++e) {
    for (int k = 0; k < 6; ++k) {
      const auto [i, j] = Tetrahedron<10>::kEdges[k];
      const Vec3 a = mesh.points.col(mesh.tets(i, e)), b = mesh.points.col(mesh.tets(j, e));
      const Vec3 off = mesh.points.col(mesh.midnodes(k, e)) - 0.5 * (a + b);
      if (off.norm() > kStraight * (b - a).norm()) return false;
    }
  }
  return true;
}

// Packed order of the element's nodes.
template <int N>
std::array<int, N> orderOf(const RestShape<N>& shape, int e) {
  std::array<int, N> order;
  std::iota(order.begin(), order.end(), 0);
  if (N == 4) {
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return shape.nodes(a, e) < shape.nodes(b, e); });
  }
  return order;
}

// Gradient of the barycentric coordinate of corner `k`. For quadratic elements it is grad N_k over
// d N_k/d w_k at the nearest integration point.
template <int N>
Vec3 weightGradient(const RestShape<N>& shape, int e, int k) {
  const int q = N == 4 ? 0 : k;
  const auto by_weight = Tetrahedron<N>::derivatives(Tetrahedron<N>::point(q));
  return shape.points[e][q].gradients.col(k) / by_weight(k, k);
}

}  // namespace

template <int N>
bool PackedTetrahedra<N>::fits(const mesh::TetMesh& mesh, const Composition& composition) {
  const auto hasKernels = [](const material::Solid& solid) {
    return kernelLaw(solid.law).has_value();
  };
  return std::all_of(composition.solids.begin(), composition.solids.end(), hasKernels) &&
         isStraight(mesh);
}

template <int N>
PackedTetrahedra<N>::PackedTetrahedra(const ElementSchedule& schedule, const RestShape<N>& shape,
                                      const Composition& composition,
                                      const std::vector<double>& element_kappa,
                                      NodalPressure* pressure, const PronyHistory* history,
                                      const BlockMatrix& pattern, ThreadPool* pool, Isa isa)
    : kernels_(tetKernels<N>(isa)),
      expand_row_(expandRow(isa)),
      pool_(pool),
      pressure_(pressure),
      history_(*history),
      upper_(pattern) {
  std::size_t num_batches = 0;
  for (const ElementRun& run : schedule.runs()) {
    num_batches += (run.elements.size() + kBatchSize - 1) / kBatchSize;
  }
  batches_.reserve(num_batches);
  blocks_.reserve(num_batches);
  if (pressure_) pressures_.reserve(num_batches);
  for (const std::vector<ElementSchedule::Part>& parts : schedule.phases) {
    phases_.emplace_back();
    for (const ElementSchedule::Part& part : parts) {
      phases_.back().emplace_back();
      for (const ElementRun& run : part) {
        const material::Material& law = composition.solids[run.solid].law;
        phases_.back().back().push_back(
            {*kernelLaw(law), material::moduli(law).mu, element_kappa[run.solid],
             static_cast<int>(batches_.size()), static_cast<int>(run.elements.size()), run.solid,
             history_.empty() ? -1 : history_.batchOf(run.elements.front())});
        pack(run.elements, shape, pattern);
      }
    }
  }
  J_.resize(kBatchSize * kTetPoints<N> * batches_.size());
  energy_.resize(batches_.size());
}

template <int N>
void PackedTetrahedra<N>::pack(const std::vector<int>& elements, const RestShape<N>& shape,
                               const BlockMatrix& pattern) {
  for (std::size_t at = 0; at < elements.size(); at += kBatchSize) {
    TetBatch<N> batch;
    TetBlocks<N> blocks;
    TetPressures<N> pressures{};
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const int e = elements[std::min(at + lane, elements.size() - 1)];
      const std::array<int, N> order = orderOf(shape, e);
      batch.volume[lane] = shape.volumes[e];
      for (int k = 1; k < 4; ++k) {
        const Vec3 gradient = weightGradient(shape, e, order[k]);
        for (int c = 0; c < 3; ++c) batch.gradient[k - 1][c][lane] = gradient[c];
      }
      int block = 0;
      for (int a = 0; a < N; ++a) {
        const int node = shape.nodes(order[a], e);
        batch.node[a][lane] = 3 * node;
        for (int b = a + 1; b < N; ++b) {
          const int other = shape.nodes(order[b], e), offset = upper_.offset(pattern, node, other);
          blocks.offset[block++][lane] = node < other ? offset : ~offset;
        }
      }
      if (pressure_) packPressures(e, order, lane, &pressures);
    }
    batches_.push_back(batch);
    blocks_.push_back(blocks);
    if (pressure_) pressures_.push_back(pressures);
  }
}

template <int N>
void PackedTetrahedra<N>::packPressures(int e, const std::array<int, N>& order, int lane,
                                        TetPressures<N>* packed) {
  for (int k = 0; k < 4; ++k) {
    packed->corner[k][lane] = pressure_->cornerPressure(e, order[k]);
    for (int b = 0; b < N; ++b) {
      if (b == k) continue;
      packed->row[(N - 1) * k + b - (b > k)][lane] = 3 * pressure_->rowEntry(e, order[k], order[b]);
    }
  }
}

template <int N>
template <class Visit>
void PackedTetrahedra<N>::forRuns(const Visit& visit) const {
  for (const auto& parts : phases_) {
    forAll(pool_, parts.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t part = begin; part < end; ++part) {
        for (const TetRun& run : parts[part]) visit(run);
      }
    });
  }
}

template <int N>
TetArrays<N> PackedTetrahedra<N>::arrays() {
  return {batches_.data(),
          blocks_.data(),
          pressure_ ? pressures_.data() : nullptr,
          J_.data(),
          energy_.data(),
          history_.empty() ? nullptr : history_.stresses(),
          history_.factors().data()};
}

template <int N>
void PackedTetrahedra<N>::moveTo(const Points& x) {
  if (at_x_ && sameBits(x, x_)) return;
  x_ = x;
  at_x_ = true;
  energy_at_x_ = gradient_at_x_ = false;
  if (!pressure_) return;
  double* c = pressure_->clearVolumeChanges();
  forRuns([&](const TetRun& run) { kernels_.deform(arrays(), run, x.data(), c); });
  pressure_->updatePressures();
}

template <int N>
double PackedTetrahedra<N>::sumEnergies() const {
  return std::accumulate(energy_.begin(), energy_.end(), pressure_ ? pressure_->energy() : 0.0);
}

template <int N>
double PackedTetrahedra<N>::energy(const Points& x) {
  moveTo(x);
  if (!energy_at_x_) {
    forRuns([&](const TetRun& run) { kernels_.energy(arrays(), run, x.data()); });
    energy_at_x_ = true;
  }
  return sumEnergies();
}

template <int N>
double PackedTetrahedra<N>::gradient(const Points& x, Points* g) {
  moveTo(x);
  if (!gradient_at_x_) {
    gradient_.setZero(3, x.cols());
    const double* pressures = pressure_ ? pressure_->pressures().data() : nullptr;
    forRuns([&](const TetRun& run) {
      kernels_.gradient(arrays(), run, x.data(), pressures, gradient_.data());
    });
    energy_at_x_ = gradient_at_x_ = true;
  }
  *g = gradient_;
  return sumEnergies();
}

template <int N>
void PackedTetrahedra<N>::hessian(const Points& x, Stiffness* K) {
  moveTo(x);
  double* blocks = upper_.clear();
  double* rows = nullptr;
  if (pressure_) {
    K->volume().factor = 1.0;
    K->volume().rows.setZero();
    rows = K->volume().rows.data();
  }
  const double* pressures = pressure_ ? pressure_->pressures().data() : nullptr;
  forRuns([&](const TetRun& run) {
    kernels_.hessian(arrays(), run, x.data(), pressures, blocks, rows);
  });
  upper_.expand(expand_row_, pool_, &K->blocks());
  if (pressure_) pressure_->completeRows(pool_, &K->volume());
}

template <int N>
void PackedTetrahedra<N>::distortionalStresses(const Points& x, SymmetricBatch* S) {
  forRuns([&](const TetRun& run) {
    if (run.first_memory >= 0) kernels_.stress(arrays(), run, x.data(), S);
  });
}

template <int N>
double PackedTetrahedra<N>::minJacobian(const Points& x) {
  moveTo(x);
  if (!pressure_ && !energy_at_x_) energy(x);
  double smallest = std::numeric_limits<double>::infinity();
  for (double J : J_) smallest = std::min(smallest, J);
  return smallest;
}

template class PackedTetrahedra<4>;
template class PackedTetrahedra<10>;

}  // namespace palpate::fem
