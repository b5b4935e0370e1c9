// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/enrichment/response_samples.h"

namespace palpate::enrichment {

/// A multilayer perceptron for a matrix A(x), evaluated as y = A(x) d:
///
///     h_1 = tanh(W_1 x + b_1), ..., h_n = tanh(W_n h_(n-1) + b_n),  vec A = W h_n + b
///
/// vec A lists A row by row.
class Perceptron {
 public:
  /// `hidden`: widths of the layers between 6 inputs and q `outputs`; may be empty. Weights are
  /// uniform within +-sqrt(6/(n_in + n_out)) [Glorot, Bengio 2010, (16)], the last weights and all
  /// b are 0; the same seed gives the same bits on every machine.
  /// @throws std::invalid_argument for a width below 1.
  Perceptron(std::vector<int> hidden, Eigen::Index outputs, int seed);

  /// The first `rows` of y; does not allocate if y has that size.
  void evaluate(const Vec6& x, const Vec3& d, Eigen::Index rows, Eigen::VectorXd* y);

  /// Mean over samples of |y - values|^2 plus decay |weights|^2, with its gradient by parameters().
  double loss(const ResponseSamples& samples, double decay, Eigen::VectorXd* gradient) const;

  /// W_1, b_1, W_2, ...; matrices in column-major order.
  const Eigen::VectorXd& parameters() const { return parameters_; }
  /// @pre the same size.
  void setParameters(const Eigen::VectorXd& parameters) { parameters_ = parameters; }
  static Eigen::Index numParameters(const std::vector<int>& hidden, Eigen::Index outputs);

  const std::vector<int>& hidden() const { return hidden_; }
  Eigen::Index outputs() const { return outputs_; }

 private:
  struct Layer {
    Eigen::Index in, out, at;  // Offset of W in the parameters; b follows.
  };
  using Weights = Eigen::Map<const Eigen::MatrixXd>;
  using Offsets = Eigen::Map<const Eigen::VectorXd>;
  Weights weights(const Layer& layer) const {
    return {parameters_.data() + layer.at, layer.out, layer.in};
  }
  Offsets offsets(const Layer& layer) const {
    return {parameters_.data() + layer.at + layer.in * layer.out, layer.out};
  }

  std::vector<int> hidden_;
  Eigen::Index outputs_;
  std::vector<Layer> layers_;
  Eigen::VectorXd parameters_;
  std::vector<Eigen::VectorXd> h_;  // layers for evaluate()
};

}  // namespace palpate::enrichment
