// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::tissue {
namespace {

constexpr double kPi = 3.14159265358979323846;

double sine(double cycles) { return std::sin(2.0 * kPi * cycles); }

double cos4(double cycles) {
  const double c = std::cos(kPi * (cycles - 0.5));
  return c * c * c * c;
}

// To add one: its function, a line here.
struct Form {
  const char* name;
  double (*value)(double cycles);
};
constexpr Form kForms[] = {{"sine", sine}, {"cos4", cos4}};

const Form& formNamed(const std::string& name) {
  for (const Form& form : kForms) {
    if (name == form.name) return form;
  }
  throw std::invalid_argument("waveform = " + name + ": must be one of " +
                              joinNames(waveFormNames()));
}

// Smooth step from 0 to 1 with continuous velocity.
double grown(double s) { return s < 1.0 ? s * s * (3.0 - 2.0 * s) : 1.0; }

void check(const MotionTable& table) {
  const auto rows = table.t.size();
  if (rows < 2 || static_cast<Eigen::Index>(rows) != table.at.cols()) {
    throw std::invalid_argument("must have two rows at least");
  }
  if (table.t.front() != 0.0) throw std::invalid_argument("must begin at t = 0");
  for (std::size_t k = 1; k < rows; ++k) {
    if (!(table.t[k] > table.t[k - 1])) throw std::invalid_argument("times must increase");
  }
  if (!table.at.allFinite()) throw std::invalid_argument("must be finite numbers");
  if (table.periodic && table.at.col(0) != table.at.col(table.at.cols() - 1)) {
    throw std::invalid_argument("must end where it begins to be periodic");
  }
}

MotionTable fromItsFirstRow(MotionTable table) {
  check(table);
  table.at.colwise() -= Vec3(table.at.col(0));
  return table;
}

// Slope of the parabola through three rows, `before` and `after` apart [s].
Vec3 slope(const Vec3& from, const Vec3& at, const Vec3& to, double before, double after) {
  return (after / before * (at - from) + before / after * (to - at)) / (before + after);
}

Points slopesOf(const MotionTable& table) {
  const Eigen::Index last = table.at.cols() - 1;
  const std::vector<double>& t = table.t;
  Points slopes = Points::Zero(3, last + 1);
  for (Eigen::Index k = 1; k < last; ++k) {
    const auto i = static_cast<std::size_t>(k);
    slopes.col(k) = slope(table.at.col(k - 1), table.at.col(k), table.at.col(k + 1),
                          t[i] - t[i - 1], t[i + 1] - t[i]);
  }
  if (!table.periodic) return slopes;
  const auto end = static_cast<std::size_t>(last);
  slopes.col(0) = slopes.col(last) =
      slope(table.at.col(last - 1), table.at.col(0), table.at.col(1), t[end] - t[end - 1], t[1]);
  return slopes;
}

Vec3 interpolated(const MotionTable& table, const Points& slopes, double t) {
  const auto upper = std::upper_bound(table.t.begin(), table.t.end(), t);
  const auto last = static_cast<Eigen::Index>(table.t.size()) - 1;
  const auto k = std::clamp<Eigen::Index>(upper - table.t.begin(), 1, last);
  const double begin = table.t[static_cast<std::size_t>(k) - 1];
  const double h = table.t[static_cast<std::size_t>(k)] - begin;
  const double s = std::min((t - begin) / h, 1.0), r = 1.0 - s;
  return r * r * (1.0 + 2.0 * s) * table.at.col(k - 1) + s * s * (1.0 + 2.0 * r) * table.at.col(k) +
         h * s * r * (r * slopes.col(k - 1) - s * slopes.col(k));
}

}  // namespace

std::vector<std::string> waveFormNames() {
  std::vector<std::string> names;
  for (const Form& form : kForms) names.emplace_back(form.name);
  return names;
}

Motion::Motion(const Wave& wave) : way_(wave) { formNamed(wave.form); }

Motion::Motion(MotionTable table)
    : way_(fromItsFirstRow(std::move(table))), slopes_(slopesOf(std::get<MotionTable>(way_))) {}

Vec3 Motion::at(double t) const {
  if (const auto* wave = std::get_if<Wave>(&way_)) {
    const double cycles = t / wave->period;
    return grown(cycles) * formNamed(wave->form).value(cycles + wave->phase) * wave->amplitude;
  }
  const MotionTable& table = std::get<MotionTable>(way_);
  const double end = table.t.back();
  if (!table.periodic) return interpolated(table, slopes_, std::min(t, end));
  return grown(t / end) * interpolated(table, slopes_, std::fmod(t, end));
}

}  // namespace palpate::tissue
