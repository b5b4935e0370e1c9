// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/perceptron.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

namespace palpate::enrichment {

Eigen::Index Perceptron::numParameters(const std::vector<int>& hidden, Eigen::Index outputs) {
  Eigen::Index in = 6, number = 0;
  for (const int width : hidden) {
    number += (in + 1) * width;
    in = width;
  }
  return number + (in + 1) * 3 * outputs;
}

Perceptron::Perceptron(std::vector<int> hidden, Eigen::Index outputs, int seed)
    : hidden_(std::move(hidden)), outputs_(outputs) {
  Eigen::Index in = 6, at = 0;
  const auto add = [&](Eigen::Index out) {
    if (out < 1) throw std::invalid_argument("a layer needs at least one unit");
    layers_.push_back({in, out, at});
    h_.emplace_back(Eigen::VectorXd::Zero(out));
    at += (in + 1) * out;
    in = out;
  };
  for (const int width : hidden_) add(width);
  add(3 * outputs);
  parameters_.setZero(at);
  std::mt19937_64 random(static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)));
  for (std::size_t l = 0; l + 1 < layers_.size(); ++l) {
    const Layer& layer = layers_[l];
    const double most = std::sqrt(6.0 / static_cast<double>(layer.in + layer.out));
    for (Eigen::Index k = 0; k < layer.in * layer.out; ++k) {
      parameters_[layer.at + k] = most * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
    }
  }
}

void Perceptron::evaluate(const Vec6& x, const Vec3& d, Eigen::Index rows, Eigen::VectorXd* y) {
  for (std::size_t l = 0; l + 1 < layers_.size(); ++l) {
    Eigen::VectorXd& h = h_[l];
    h = offsets(layers_[l]);
    if (l == 0) {
      h.noalias() += weights(layers_[l]).lazyProduct(x);
    } else {
      h.noalias() += weights(layers_[l]).lazyProduct(h_[l - 1]);
    }
    h = h.array().tanh();
  }
  const Layer& last = layers_.back();
  auto a = h_.back().head(3 * rows);
  a = offsets(last).head(3 * rows);
  if (layers_.size() == 1) {
    a.noalias() += weights(last).topRows(3 * rows).lazyProduct(x);
  } else {
    a.noalias() += weights(last).topRows(3 * rows).lazyProduct(h_[layers_.size() - 2]);
  }
  y->resize(rows);
  for (Eigen::Index r = 0; r < rows; ++r) (*y)[r] = a.segment<3>(3 * r).dot(d);
}

double Perceptron::loss(const ResponseSamples& samples, double decay,
                        Eigen::VectorXd* gradient) const {
  const Eigen::Index n = samples.size();
  const double part = 1.0 / static_cast<double>(n);
  std::vector<Eigen::MatrixXd> h{samples.inputs};
  for (const Layer& layer : layers_) {
    h.emplace_back((weights(layer) * h.back()).colwise() + offsets(layer));
    if (&layer != &layers_.back()) h.back() = h.back().array().tanh();
  }
  Eigen::MatrixXd back(3 * outputs_, n);  // derivative of the loss by a layer's outputs before tanh
  double value = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Vec3 d = samples.displacements.col(k);
    for (Eigen::Index r = 0; r < outputs_; ++r) {
      const double error = h.back().block<3, 1>(3 * r, k).dot(d) - samples.values(r, k);
      value += part * error * error;
      back.block<3, 1>(3 * r, k) = 2.0 * part * error * d;
    }
  }
  gradient->resize(parameters_.size());
  for (std::size_t l = layers_.size(); l-- > 0;) {
    const Layer& layer = layers_[l];
    const Eigen::Index size = layer.in * layer.out;
    Eigen::Map<Eigen::MatrixXd> by_weights(gradient->data() + layer.at, layer.out, layer.in);
    by_weights.noalias() = back * h[l].transpose();
    by_weights += 2.0 * decay * weights(layer);
    gradient->segment(layer.at + size, layer.out) = back.rowwise().sum();
    value += decay * weights(layer).squaredNorm();
    if (l == 0) break;
    back = ((weights(layer).transpose() * back).array() * (1.0 - h[l].array().square())).eval();
  }
  return value;
}

}  // namespace palpate::enrichment
