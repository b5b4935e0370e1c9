// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/result_table.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::torture {
namespace {

std::string plain(std::string text) {
  for (char& c : text) {
    if (c == ',') c = ';';
    if (c == '\n' || c == '\r' || c == '"') c = ' ';
  }
  return text;
}

std::string rounded(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

std::string joined(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
  return line + "\n";
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<std::string> headCells(const TortureScene& scene) {
  const TortureOrgan& o = scene.organs.front();
  const bool fem = o.model == "fem";
  return {std::to_string(scene.seed),
          std::to_string(scene.number),
          scene.category,
          o.model,
          fem ? o.element : "-",
          o.law,
          scene.method,
          scene.integrator,
          toString(scene.start),
          o.shape,
          std::to_string(o.mesh.numTets()),
          rounded(o.min_dihedral),
          rounded(o.young),
          rounded(o.poisson),
          rounded(o.density),
          rounded(o.contrast),
          rounded(scene.step),
          rounded(scene.friction),
          std::to_string(scene.tools.size()),
          scene.contact,
          o.model == "mass_spring" || o.model == "cloth" ? o.scheme : "-",
          scene.live ? "live" : "replay"};
}

}  // namespace

const std::vector<std::string>& ResultLine::columns() {
  static const std::vector<std::string> kAll = {
      "seed",       "number",   "category", "model",      "element",   "law",        "method",
      "integrator", "start",    "shape",    "tetrahedra", "dihedral",  "young",      "poisson",
      "density",    "contrast", "step",     "friction",   "tools",     "contact",    "scheme",
      "pace",       "verdict",  "criteria", "row",        "what",      "cycles",     "unsolved",
      "inverted",   "touching", "put_back", "curled",     "median_ms", "longest_ms", "peak_force",
      "load_s",     "run_s",    "commit",   "end"};
  return kAll;
}

const std::string& ResultLine::cell(const std::string& column) const {
  const auto found = std::find(columns().begin(), columns().end(), column);
  return cells.at(static_cast<std::size_t>(found - columns().begin()));
}

double ResultLine::number(const std::string& column) const {
  return parseNumber(cell(column)).value_or(0.0);
}

ResultLine resultLine(const TortureScene& scene, const Outcome& outcome,
                      const std::string& commit) {
  ResultLine line{headCells(scene)};
  std::string verdict = "passed", criteria, what;
  if (!outcome.whole) verdict = "left";
  if (!outcome.failures.empty()) verdict = "failed";
  if (!outcome.refused.empty()) verdict = "refused";
  for (const Failure& failure : outcome.failures) {
    criteria += (criteria.empty() ? "" : " ") + failure.criterion;
    what += (what.empty() ? "" : " | ") + failure.criterion + ": " + plain(failure.what);
  }
  if (!outcome.refused.empty()) what = plain(outcome.refused);
  const std::size_t row = outcome.failures.empty() ? 0 : outcome.failures.front().row;
  for (const std::string& cell :
       {verdict, criteria, std::to_string(row), what, std::to_string(outcome.cycles),
        std::to_string(outcome.unsolved), std::to_string(outcome.inverted),
        std::to_string(outcome.touching), std::to_string(outcome.put_back),
        std::to_string(outcome.curled), rounded(outcome.median_ms), rounded(outcome.longest_ms),
        rounded(outcome.peak_force), rounded(outcome.load_s), rounded(outcome.run_s), plain(commit),
        std::string("end")}) {
    line.cells.push_back(cell);
  }
  return line;
}

ResultLine crashLine(const TortureScene& scene, const std::string& commit) {
  Outcome outcome;
  outcome.failures.push_back({"crash", 0, "the program ended"});
  return resultLine(scene, outcome, commit);
}

void appendResult(const std::string& file, const ResultLine& line) {
  const bool anew = !std::filesystem::exists(file);
  std::ofstream out(file, std::ios::app);
  if (anew) out << joined(ResultLine::columns());
  out << joined(line.cells) << std::flush;
  if (!out) throw InputError(file, "", "", "cannot be written");
}

std::vector<ResultLine> readResults(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("results", 0) == 0 && entry.path().extension() == ".csv") {
      files.push_back(entry.path().string());
    }
  }
  if (error) throw InputError(folder, "", "", "cannot be read: " + error.message());
  std::sort(files.begin(), files.end());
  std::map<std::pair<double, double>, ResultLine> lines;
  for (const std::string& file : files) {
    std::ifstream in(file);
    for (std::string text; std::getline(in, text);) {
      ResultLine line{split(text)};
      if (line.cells.size() != ResultLine::columns().size() || line.cells.back() != "end" ||
          line.cells.front() == ResultLine::columns().front()) {
        continue;
      }
      lines.insert_or_assign(std::make_pair(line.number("seed"), line.number("number")), line);
    }
  }
  std::vector<ResultLine> all;
  all.reserve(lines.size());
  for (auto& [key, line] : lines) all.push_back(std::move(line));
  return all;
}

std::string resultTable(const std::vector<ResultLine>& lines) {
  std::string table = joined(ResultLine::columns());
  for (const ResultLine& line : lines) table += joined(line.cells);
  return table;
}

std::set<int> numbersDone(const std::vector<ResultLine>& lines, std::uint64_t seed) {
  std::set<int> done;
  for (const ResultLine& line : lines) {
    if (line.cell("seed") == std::to_string(seed)) {
      done.insert(static_cast<int>(line.number("number")));
    }
  }
  return done;
}

std::set<int> numbersAgain(const std::vector<ResultLine>& lines, std::uint64_t seed,
                           const std::string& commit) {
  std::set<int> again;
  for (const ResultLine& line : lines) {
    const std::string& verdict = line.cell("verdict");
    const bool open = verdict == "failed" || verdict == "left";
    if (open && line.cell("seed") == std::to_string(seed) && line.cell("commit") != commit) {
      again.insert(static_cast<int>(line.number("number")));
    }
  }
  return again;
}

}  // namespace palpate::torture
