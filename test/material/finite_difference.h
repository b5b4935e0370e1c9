// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::test {

/// f'(0) to fourth order, for f(h) a number or a matrix: its error is about h^4 f^(5)/30.
template <class Function>
auto slopeAtZero(const Function& f, double h = 1e-4) {
  using Value = decltype(f(h));
  const Value near = f(h) - f(-h), far = f(2.0 * h) - f(-2.0 * h);
  return Value((8.0 * near - far) / (12.0 * h));
}

}  // namespace palpate::test
