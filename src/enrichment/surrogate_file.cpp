// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/surrogate_file.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/state_bytes.h"
#include "palpate/base/text_file.h"

namespace palpate::enrichment {
namespace {

constexpr std::string_view kHead = "palpate surrogate 1\n";
constexpr std::size_t kMaxSurrogateBytes = std::size_t{1} << 26;
constexpr int kMostLayers = 16, kWidest = 4096;
constexpr std::uint8_t kKernel = 0, kNetwork = 1;

// FNV-1a, 64 bits.
std::uint64_t surrogateMark(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037U;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return h;
}

void put(const KernelMap& map, StateWriter* out) {
  out->put(kKernel);
  out->put(map.inputs());
  out->put(map.displacements());
  out->put(map.weights());
}

void put(const Perceptron& map, StateWriter* out) {
  out->put(kNetwork);
  out->put(map.hidden());
  out->put(map.parameters());
}

// Bound of all numbers: far above learned values, small enough that results cannot overflow.
constexpr double kLargest = 1e12;

template <class Values>
bool moderate(const Values& values) {
  return (values.array().abs() <= static_cast<typename Values::Scalar>(kLargest))
      .all();  // false for NaN
}
bool moderateScale(double scale) { return scale >= 1.0 / kLargest && scale <= kLargest; }
bool moderateScale(const Vec6& scale) {
  return std::all_of(scale.data(), scale.data() + scale.size(),
                     [](double one) { return moderateScale(one); });
}

KernelMap readKernel(StateReader* in, Eigen::Index outputs) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> inputs;
  Points displacements;
  Eigen::MatrixXd weights;
  in->get(&inputs);
  in->get(&displacements);
  in->get(&weights);
  if (weights.rows() != outputs || !moderate(inputs) || !moderate(displacements) ||
      !moderate(weights)) {
    StateReader::fail();
  }
  return {inputs, displacements, weights};
}

Perceptron readNetwork(StateReader* in, Eigen::Index outputs) {
  std::vector<int> hidden;
  Eigen::VectorXd parameters;
  in->get(&hidden);
  in->get(&parameters);
  bool fits = hidden.size() <= static_cast<std::size_t>(kMostLayers) && moderate(parameters);
  for (const int width : hidden) fits &= width >= 1 && width <= kWidest;
  if (!fits || Perceptron::numParameters(hidden, outputs) != parameters.size()) StateReader::fail();
  Perceptron network(hidden, outputs, 0);
  network.setParameters(parameters);
  return network;
}

bool isSound(const Surrogate& s) {
  const Eigen::Index n = s.surface.points.cols();
  const auto& t = s.surface.triangles;
  return n > 0 && moderate(s.surface.points) && t.size() > 0 && t.minCoeff() >= 0 &&
         t.maxCoeff() < n && s.modes.rows() == 3 * n && s.modes.cols() > 0 && moderate(s.modes) &&
         moderateScale(s.patch) && moderate(s.middle) && moderateScale(s.scale) &&
         moderateScale(s.seen_scale) && moderateScale(s.displacement_scale) &&
         moderateScale(s.force_scale) && moderateScale(s.mode_scale) && moderateScale(s.longest) &&
         s.plain.rows() == 3 + s.modes.cols() && s.plain.cols() == 3 && moderate(s.plain) &&
         s.seen.samples.cols() > 0 && moderate(s.seen.samples) && moderateScale(s.seen.threshold);
}

// Calls visit for each plain member, in the file's order.
template <class Of, class Visit>
void forMembers(Of& s, const Visit& visit) {
  visit(s.surface.points);
  visit(s.surface.triangles);
  visit(s.modes);
  visit(s.patch);
  visit(s.middle);
  visit(s.scale);
  visit(s.displacement_scale);
  visit(s.force_scale);
  visit(s.mode_scale);
  visit(s.longest);
  visit(s.plain);
  visit(s.seen.samples);
  visit(s.seen.threshold);
  visit(s.seen_scale);
}

}  // namespace

void writeSurrogate(const std::string& file, const Surrogate& surrogate) {
  StateWriter out;
  out.put(std::string_view(surrogate.made_by));
  forMembers(surrogate, [&](const auto& member) { out.put(member); });
  std::visit([&](const auto& map) { put(map, &out); }, surrogate.map);
  StateWriter mark;
  mark.put(surrogateMark(out.bytes()));
  writeFileAtomically(file, std::string(kHead) + mark.bytes() + out.bytes());
}

Surrogate readSurrogate(const std::string& file) {
  const std::string bytes = readTextFile(file, kMaxSurrogateBytes);
  const std::string_view all(bytes);
  if (all.substr(0, kHead.size()) != kHead) {
    throw InputError(file, "", "", "is no surrogate of this version; `palpate train` makes one");
  }
  Surrogate surrogate;
  try {
    StateReader in(all.substr(kHead.size()));
    std::uint64_t mark = 0;
    in.get(&mark);
    if (mark != surrogateMark(all.substr(kHead.size() + sizeof mark))) StateReader::fail();
    in.get(&surrogate.made_by);
    forMembers(surrogate, [&](auto& member) { in.get(&member); });
    if (!isSound(surrogate)) StateReader::fail();
    std::uint8_t kind = 0;
    in.get(&kind);
    const Eigen::Index outputs = 3 + surrogate.numModes();
    if (kind == kKernel) {
      surrogate.map = readKernel(&in, outputs);
    } else if (kind == kNetwork) {
      surrogate.map = readNetwork(&in, outputs);
    } else {
      StateReader::fail();
    }
    in.finish();
  } catch (const std::invalid_argument&) {
    throw InputError(file, "", "", "is cut off, or was changed");
  }
  return surrogate;
}

}  // namespace palpate::enrichment
