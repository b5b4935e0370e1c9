// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>

namespace palpate::enrichment {

/// A function to minimise, with its gradient.
using SmoothFunction = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd* gradient)>;

/// L-BFGS [Nocedal, Wright 2006, alg. 7.4, 7.5] with Armijo steps by halving. Ends if none exists
/// or after `max_iterations`; calls `each(k, value)` in each iteration. Returns the value at x.
double minimizeByLbfgs(const SmoothFunction& function, int max_iterations, Eigen::VectorXd* x,
                       const std::function<void(int, double)>& each = {});

}  // namespace palpate::enrichment
