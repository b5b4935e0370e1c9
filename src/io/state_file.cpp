// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/state_file.h"

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "csv_cells.h"
#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::io {
namespace {

constexpr char kMagic[] = "# palpate state 1";
constexpr char kTime[] = "# time = ";
constexpr char kHeader[] = "organ,node,x,y,z,vx,vy,vz";
constexpr char kEnd[] = "# end";

void writeTo(std::ostream& out, const std::vector<std::string>& organs,
             const sim::SimulatorState& state) {
  out << kMagic << '\n' << kTime << formatNumber(state.time) << '\n' << kHeader << '\n';
  for (std::size_t i = 0; i < organs.size(); ++i) {
    const Points& x = state.positions[i];
    const Points& v = state.velocities[i];
    for (Eigen::Index n = 0; n < x.cols(); ++n) {
      out << organs[i] << ',' << n;
      for (int k = 0; k < 3; ++k) out << ',' << formatNumber(x(k, n));
      for (int k = 0; k < 3; ++k) out << ',' << formatNumber(v(k, n));
      out << '\n';
    }
  }
  out << kEnd << '\n';
}

bool toNumber(std::string_view text, double* value) {
  const std::optional<double> number = parseNumber(text);
  if (number) *value = *number;
  return number.has_value();
}

struct Row {
  std::string organ;
  std::string node;
  double values[6];
};

bool parseRow(const std::string& line, Row* row) {
  const std::vector<std::string_view> cells = csvCells(line);
  if (cells.size() != 8) return false;
  row->organ = cells[0];
  row->node = cells[1];
  for (std::size_t i = 0; i < 6; ++i) {
    if (!toNumber(cells[2 + i], &row->values[i])) return false;
  }
  return true;
}

Points toPoints(const std::vector<Row>& rows, int first) {
  Points p(3, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t n = 0; n < rows.size(); ++n) {
    for (int k = 0; k < 3; ++k) p(k, static_cast<Eigen::Index>(n)) = rows[n].values[first + k];
  }
  return p;
}

}  // namespace

void writeState(const std::string& file, const std::vector<std::string>& organs,
                const sim::SimulatorState& state) {
  if (state.positions.size() != organs.size() || state.velocities.size() != organs.size()) {
    throw std::runtime_error(file + ": the state has another number of organs than names");
  }
  for (std::size_t i = 0; i < organs.size(); ++i) {
    if (!state.positions[i].allFinite() || !state.velocities[i].allFinite() ||
        state.positions[i].cols() != state.velocities[i].cols()) {
      throw std::runtime_error(file + ": the state of " + organs[i] + " is not finite");
    }
  }
  std::ostringstream out;
  writeTo(out, organs, state);
  writeFileAtomically(file, out.str());
}

sim::SimulatorState readState(const std::string& file, const std::vector<std::string>& organs) {
  std::ifstream in(file);
  if (!in) throw InputError(file, "", "", "cannot be opened");
  int number = 0;
  std::string line;
  const auto next = [&] { return ++number, static_cast<bool>(std::getline(in, line)); };
  const auto fail = [&](const std::string& allowed) {
    throw InputError(file, "line " + std::to_string(number), line.substr(0, 60), allowed);
  };

  sim::SimulatorState state;
  if (!next() || line != kMagic) fail(std::string("must be '") + kMagic + "'");
  if (!next() || line.rfind(kTime, 0) != 0 ||
      !toNumber(line.substr(sizeof(kTime) - 1), &state.time) || state.time < 0.0) {
    fail(std::string("must be '") + kTime + "<seconds, >= 0>'");
  }
  if (!next() || line != kHeader) fail(std::string("must be '") + kHeader + "'");

  std::vector<std::vector<Row>> rows(organs.size());
  std::size_t organ = 0;
  bool ended = false;
  while (!ended && next()) {
    ended = line == kEnd;
    if (ended) break;
    Row row;
    if (!parseRow(line, &row)) fail("must be an organ, a node number and six finite numbers");
    while (organ < organs.size() && row.organ != organs[organ]) ++organ;
    if (organ == organs.size()) {
      fail("the organs must be those of the scene, in its order: " + joinNames(organs));
    }
    if (row.node != std::to_string(rows[organ].size())) {
      fail("node numbers must count from 0; expected " + std::to_string(rows[organ].size()));
    }
    rows[organ].push_back(std::move(row));
  }
  if (!ended) fail(std::string("the file is cut off: the last line must be '") + kEnd + "'");
  for (const std::vector<Row>& organ_rows : rows) {
    state.positions.push_back(toPoints(organ_rows, 0));
    state.velocities.push_back(toPoints(organ_rows, 3));
  }
  return state;
}

}  // namespace palpate::io
