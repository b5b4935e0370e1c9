// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/result_json.h"

#include <cmath>

#include "palpate/base/number.h"
#include "palpate/io/output_file.h"

namespace palpate::io {
namespace {

std::string quoted(const std::string& text) {
  static const char kHex[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20) {
      result += "\\u00";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string json(double value) { return std::isfinite(value) ? formatNumber(value) : "null"; }

template <int n>
std::string json(const Eigen::Matrix<double, n, 1>& values) {
  std::string text;
  for (int i = 0; i < n; ++i) text += (i ? ", " : "") + json(values(i));
  return "[" + text + "]";
}

/// Members of an object, one after the other.
class Members {
 public:
  void add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : separator_) + quoted(key) + ": " + value;
  }
  template <class T>
  void add(const std::string& key, const std::optional<T>& value) {
    if (value) add(key, json(*value));
  }
  explicit Members(const std::string& separator = ", ") : separator_(separator) {}
  const std::string& text() const { return text_; }

 private:
  std::string separator_, text_;
};

}  // namespace

std::string resultJson(const SolveResult& result) {
  Members seconds, energies, probes(",\n    ");
  for (const auto& [region, energy] : result.energy_by_region) energies.add(region, json(energy));
  for (const auto& [part, time] : result.seconds) seconds.add(part, json(time));
  for (const ProbeResult& p : result.probes) {
    Members probe;
    probe.add("displacement", p.displacement);
    probe.add("cauchy_stress", p.cauchy_stress);
    probe.add("von_mises", p.von_mises);
    probe.add("principal_stretches", p.principal_stretches);
    probe.add("force", p.force);
    probe.add("moment", p.moment);
    probes.add(p.name, "{" + probe.text() + "}");
  }
  Members all(",\n  ");
  all.add("status", quoted(result.status));
  all.add("load_steps", std::to_string(result.load_steps));
  if (result.rejected_steps > 0) {
    all.add("rejected_steps", std::to_string(result.rejected_steps));
  }
  all.add("newton_iterations", std::to_string(result.newton_iterations));
  all.add("residual", json(result.residual));
  all.add("strain_energy", json(result.strain_energy));
  if (!result.energy_by_region.empty()) {
    all.add("strain_energy_by_region", "{" + energies.text() + "}");
  }
  all.add("min_jacobian", json(result.min_jacobian));
  all.add("seconds", "{" + seconds.text() + "}");
  all.add("probes", result.probes.empty() ? "{}" : "{\n    " + probes.text() + "\n  }");
  return "{\n  " + all.text() + "\n}\n";
}

void writeResultJson(const std::string& file, const SolveResult& result) {
  OutputFile output(file);
  output.write(resultJson(result));
  output.close();
}

}  // namespace palpate::io
