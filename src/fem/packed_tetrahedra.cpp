// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_tetrahedra.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "for_all.h"

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

}  // namespace

bool PackedTetrahedra::fits(const Composition& composition) {
  return std::all_of(composition.solids.begin(), composition.solids.end(),
                     [](const material::Solid& solid) { return kernelLaw(solid.law).has_value(); });
}

PackedTetrahedra::PackedTetrahedra(const ElementSchedule& schedule, const RestShape<4>& shape,
                                   const Composition& composition,
                                   const std::vector<double>& element_kappa,
                                   NodalPressure* pressure, const PronyHistory* history,
                                   const BlockMatrix& pattern, ThreadPool* pool, Isa isa)
    : kernels_(tetKernels(isa)),
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
  J_.resize(kBatchSize * batches_.size());
  energy_.resize(batches_.size());
}

void PackedTetrahedra::pack(const std::vector<int>& elements, const RestShape<4>& shape,
                            const BlockMatrix& pattern) {
  for (std::size_t at = 0; at < elements.size(); at += kBatchSize) {
    TetBatch batch;
    TetBlocks blocks;
    TetPressures pressures{};
    for (int lane = 0; lane < kBatchSize; ++lane) {
      const int e = elements[std::min(at + lane, elements.size() - 1)];
      const auto& point = shape.points[e][0];
      std::array<int, 4> order{0, 1, 2, 3};
      std::sort(order.begin(), order.end(),
                [&](int a, int b) { return shape.nodes(a, e) < shape.nodes(b, e); });
      batch.volume[lane] = point.volume;
      int block = 0;
      for (int a = 0; a < 4; ++a) {
        const int node = shape.nodes(order[a], e);
        batch.node[a][lane] = 3 * node;
        for (int c = 0; c < 3 && a > 0; ++c) {
          batch.gradient[a - 1][c][lane] = point.gradients(c, order[a]);
        }
        for (int b = a + 1; b < 4; ++b) {
          blocks.offset[block++][lane] = upper_.offset(pattern, node, shape.nodes(order[b], e));
        }
        if (!pressure_) continue;
        pressures.corner[a][lane] = pressure_->cornerPressure(e, order[a]);
        for (int b = 0; b < 4; ++b) {
          if (b == a) continue;
          pressures.row[3 * a + b - (b > a)][lane] = 3 * pressure_->rowEntry(e, order[a], order[b]);
        }
      }
    }
    batches_.push_back(batch);
    blocks_.push_back(blocks);
    if (pressure_) pressures_.push_back(pressures);
  }
}

template <class Visit>
void PackedTetrahedra::forRuns(const Visit& visit) const {
  for (const auto& parts : phases_) {
    forAll(pool_, parts.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t part = begin; part < end; ++part) {
        for (const TetRun& run : parts[part]) visit(run);
      }
    });
  }
}

TetArrays PackedTetrahedra::arrays() {
  return {batches_.data(),
          blocks_.data(),
          pressure_ ? pressures_.data() : nullptr,
          J_.data(),
          energy_.data(),
          history_.empty() ? nullptr : history_.stresses(),
          history_.factors().data()};
}

void PackedTetrahedra::moveTo(const Points& x) {
  if (at_x_ && sameBits(x, x_)) return;
  x_ = x;
  at_x_ = true;
  energy_at_x_ = gradient_at_x_ = false;
  if (!pressure_) return;
  double* c = pressure_->clearVolumeChanges();
  forRuns([&](const TetRun& run) { kernels_.deform(arrays(), run, x.data(), c); });
  pressure_->updatePressures();
}

double PackedTetrahedra::sumEnergies() const {
  return std::accumulate(energy_.begin(), energy_.end(), pressure_ ? pressure_->energy() : 0.0);
}

double PackedTetrahedra::energy(const Points& x) {
  moveTo(x);
  if (!energy_at_x_) {
    forRuns([&](const TetRun& run) { kernels_.energy(arrays(), run, x.data()); });
    energy_at_x_ = true;
  }
  return sumEnergies();
}

double PackedTetrahedra::gradient(const Points& x, Points* g) {
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

void PackedTetrahedra::hessian(const Points& x, Stiffness* K) {
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
  upper_.expand(kernels_, pool_, &K->blocks());
  if (pressure_) pressure_->completeRows(pool_, &K->volume());
}

void PackedTetrahedra::distortionalStresses(const Points& x, SymmetricBatch* S) {
  forRuns([&](const TetRun& run) {
    if (run.first_memory >= 0) kernels_.stress(arrays(), run, x.data(), S);
  });
}

double PackedTetrahedra::minJacobian(const Points& x) {
  moveTo(x);
  if (!pressure_ && !energy_at_x_) energy(x);
  double smallest = std::numeric_limits<double>::infinity();
  for (double J : J_) smallest = std::min(smallest, J);
  return smallest;
}

}  // namespace palpate::fem
