// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/torture_report.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "palpate/torture/criteria.h"

namespace palpate::torture {
namespace {

constexpr double kSlow = 5e3;  // [ms]

struct Count {
  int scenes = 0, passed = 0, failed = 0, refused = 0, left = 0;
  double cycles = 0.0, unsolved = 0.0;
  std::map<std::string, int> by_criterion;

  void add(const ResultLine& line) {
    ++scenes;
    const std::string& verdict = line.cell("verdict");
    passed += verdict == "passed";
    failed += verdict == "failed";
    refused += verdict == "refused";
    left += verdict == "left";
    cycles += line.number("cycles");
    unsolved += line.number("unsolved");
    std::istringstream names(line.cell("criteria"));
    for (std::string name; names >> name;) ++by_criterion[name];
  }
};

std::string percent(double part, double whole) {
  std::ostringstream out;
  out.precision(3);
  out << (whole > 0.0 ? 100.0 * part / whole : 0.0);
  return out.str();
}

std::string table(const std::vector<ResultLine>& lines, const std::string& column) {
  std::map<std::string, Count> counts;
  for (const ResultLine& line : lines) counts[line.cell(column)].add(line);
  std::ostringstream out;
  out << "| " << column
      << " | scenes | passed | failed | refused | left off | cycles not solved [%] |";
  for (const std::string& name : criterionNames()) out << " " << name << " |";
  out << "\n|---|---|---|---|---|---|---|";
  for (std::size_t k = 0; k < criterionNames().size(); ++k) out << "---|";
  for (auto& [name, count] : counts) {
    out << "\n| `" << name << "` | " << count.scenes << " | " << count.passed << " | "
        << count.failed << " | " << count.refused << " | " << count.left << " | "
        << percent(count.unsolved, count.cycles) << " |";
    for (const std::string& criterion : criterionNames()) {
      const int many = count.by_criterion[criterion];
      out << " " << (many ? std::to_string(many) : "") << " |";
    }
  }
  return out.str() + "\n";
}

std::string scenery(const ResultLine& line) {
  const std::string element = line.cell("element") == "-" ? "" : " " + line.cell("element");
  return line.cell("model") + element + " " + line.cell("law") + ", nu " + line.cell("poisson") +
         ", E " + line.cell("young") + " Pa, " + line.cell("method") + " " +
         line.cell("integrator") + ", step " + line.cell("step") + " s, " +
         line.cell("tetrahedra") + " tetrahedra of " + line.cell("shape");
}

std::string commandOf(const ResultLine& line) {
  return "palpate torture --seed " + line.cell("seed") + " --only " + line.cell("number");
}

// Lines like "Commit abc: 3 scenes.", as scripts/checks/check_pages.py reads them.
std::string commits(const std::vector<ResultLine>& lines) {
  std::map<std::string, int> scenes;
  for (const ResultLine& line : lines) ++scenes[line.cell("commit")];
  std::string text;
  for (const auto& [commit, number] : scenes) {
    text += "Commit " + commit + ": " + std::to_string(number) + " scenes.\n";
  }
  return text;
}

int largest(const std::vector<ResultLine>& lines, const std::string& column) {
  double most = 0.0;
  for (const ResultLine& line : lines) most = std::max(most, line.number(column));
  return static_cast<int>(most);
}

// Number of scenes without a touch although tools were to touch.
std::ptrdiff_t numIdle(const std::vector<ResultLine>& lines) {
  return std::count_if(lines.begin(), lines.end(), [](const ResultLine& line) {
    const std::string& what = line.cell("category");
    const bool without_tools = what == "fall" || what == "start" || what == "gravity";
    return !without_tools && line.cell("verdict") == "passed" && line.number("touching") == 0.0;
  });
}

std::ptrdiff_t numCurled(const std::vector<ResultLine>& lines) {
  return std::count_if(lines.begin(), lines.end(),
                       [](const ResultLine& line) { return line.number("curled") > 0.0; });
}

std::ptrdiff_t numSlow(const std::vector<ResultLine>& lines) {
  return std::count_if(lines.begin(), lines.end(),
                       [](const ResultLine& line) { return line.number("longest_ms") > kSlow; });
}

std::string worst(const std::vector<ResultLine>& lines, const std::string& column,
                  const std::string& what) {
  const auto most =
      std::max_element(lines.begin(), lines.end(), [&](const ResultLine& a, const ResultLine& b) {
        return a.number(column) < b.number(column);
      });
  if (most == lines.end()) return "";
  return "| " + what + " | " + most->cell(column) + " | `" + commandOf(*most) + "` | " +
         scenery(*most) + " |\n";
}

}  // namespace

std::string summary(const std::vector<ResultLine>& lines) {
  Count all;
  for (const ResultLine& line : lines) all.add(line);
  return std::to_string(all.scenes) + " scenes: " + std::to_string(all.passed) + " passed, " +
         std::to_string(all.failed) + " failed, " + std::to_string(all.refused) +
         " refused while loading, " + std::to_string(all.left) + " left off";
}

std::string stabilityMarkdown(const std::vector<ResultLine>& lines) {
  std::ostringstream out;
  out << R"(# Stability

Random scenes, and whether anything blows up in them. This page is written by

    scripts/page.sh torture --count N --kept        # goes on from docs/results/stability.csv.xz
    palpate torture --report FOLDER > docs/results/stability.md
    palpate torture --table FOLDER | xz -9e > docs/results/stability.csv.xz

`palpate torture` draws each scene from a seed and a number, writes it as files of a user's own, replays these as
`palpate replay` does, and looks at every cycle from outside. A scene passes when none of these is broken:

| criterion | what must hold |
|---|---|
| `finite` | no number of points, wrenches, contacts and figures is NaN or infinite, and no status is `non_finite` |
| `bounded` | no point is farther from where organs rest and begin and tools go (and fly, where thrown) than ten times the size of the scene, or of an organ as it begins, and no force on a tool that is told to be converged is above 1e4 times that of the modulus on the size squared, plus that of all the mass within a step; laws whose stress rises faster than the cube of stretch have no such bound |
| `inverted` | no shape with a tetrahedron of det F <= 0, computed anew from the corners of linear ones and at the four integration points of quadratic ones, is `converged` |
| `truth` | `converged` has a residual below its tolerance, wrenches are the sums of their contacts, all forces of tools, supports, weight and inertia add up to what is told to be left at the points (and to 1e-4 of what touches, where there is friction), and for one organ of elements (all five, of any laws without memory, with a stiff half or fibres) by implicit steps of backward Euler or static ones all forces on its points, by the formulas of docs/theory.md once more, are as balanced as told; what `newton_bicgstab` holds is left out |
| `wrench` | a force has a contact, none stays when the tools are gone, no tissue is carried along farther than its size, and what the node's filter makes of it stays within the limits of force and rate |
| `energy` | without tools it does not grow beyond the integrator's bound: 1 by backward Euler and static, 2 by BDF2, 1 / (1 - 0.9^2) in explicit steps of nine tenths of the stable one, 4.74 and 6.64 by the forward and trapezoidal Euler steps of springs; that of motion not of quasi-static steps, which have none; of organs thrown at organs or bone it stays below that of their speed; forces that are told not to be balanced may have added as much again |
| `rest` | when the tools are gone, a damped organ that is held is back within 1e-4 of its size, and balanced, if its last cycle was not cut short by a live deadline; laws and springs with rest states that are inside out may stay in one, if told, and sheets may stay crumpled |
| `time` | no cycle of a replay takes 100 times as long as the median one in contact, and 20 ms |
| `crash` | the program does not end |
| `cycle` | no cycle takes a minute: it would be ended there |
| `deadline` | no cycle of a live run goes on for twice its deadline, which is two steps, or 20 ms if that is longer: the other half is for what an interrupt cannot end |
| `same` | two threads give the bits of one (every tenth scene) |
| `cut` | all but `time` holds as well when cycles are asked to end after a number of questions that is drawn for each, until half of the rest is over (every tenth scene) |

`time`, `cycle` and `deadline` are wall time, and fail more often on a machine that does something else as well; what they
cut short then goes on otherwise, and all other runs have the same bits. `deadline` is of the core's interrupt, which is asked as long before it as the last cycles took to come to an end; the node cuts no step short (docs/theory.md, Deadline). Live runs of meshes that adapt have two threads, and wait for their next period.

A scene that is refused while loading has a message and no cycle. One that takes longer than `--scene-limit`, 60 s if
nothing else is said, is left off, and is judged as far as it came. Forces are not summed anew where elements are flatter than a tenth of their volume, whose
guard against turning inside out is an energy beside their law's, and no energy is judged then. Energy is not judged of viscous organs, of elements with middle nodes and of `neural`
under gravity, and not across a cycle that put an organ back to rest; return to rest not of organs that fly, and not
where 700 rows of the time that the slowest motion is estimated to need would not do: all get three times that.

)";
  out << summary(lines) << ". Their numbers go up to " << largest(lines, "number")
      << ", their meshes to " << largest(lines, "tetrahedra") << " tetrahedra; " << numSlow(lines)
      << " had a cycle of more than 5 s. In " << numIdle(lines)
      << " that passed no tool touched anything; in " << numCurled(lines)
      << " a cycle told to be converged had a quadratic element with det F <= 0 at a corner, "
         "between "
         "its integration points.\n\n"
      << commits(lines) << "\n"
      << "## By what happens\n\n"
      << table(lines, "category");
  const std::pair<const char*, const char*> parts[] = {{"model", "By model"},
                                                       {"element", "By element"},
                                                       {"law", "By law"},
                                                       {"method", "By method"},
                                                       {"integrator", "By integrator"},
                                                       {"contact", "By contact"},
                                                       {"scheme", "By the scheme of springs"},
                                                       {"poisson", "By Poisson's ratio"},
                                                       {"start", "By the start"},
                                                       {"shape", "By mesh"},
                                                       {"pace", "By pace"}};
  for (const auto& [column, title] : parts) {
    out << "\n## " << title << "\n\n" << table(lines, column);
  }
  out << "\n## Worst cases\n\n| what | | scene | made of |\n|---|---|---|---|\n"
      << worst(lines, "longest_ms", "longest cycle [ms]")
      << worst(lines, "peak_force", "largest force on a tool, before limits [N]")
      << worst(lines, "unsolved", "most cycles not solved")
      << worst(lines, "inverted", "most cycles told inverted")
      << worst(lines, "put_back", "most cycles that put an organ back to rest or froze it")
      << worst(lines, "load_s", "longest loading [s]");
  out << "\n## What fails\n\n| scene | criteria | what | made of |\n|---|---|---|---|\n";
  for (const ResultLine& line : lines) {
    if (line.cell("verdict") != "failed") continue;
    std::string what = line.cell("what");
    std::replace(what.begin(), what.end(), '|', '/');
    out << "| `" << commandOf(line) << "` | " << line.cell("criteria") << " | " << what << " | "
        << line.cell("category") << ": " << scenery(line) << " |\n";
  }
  out << "\n## What is left off\n\n| scene | cycles | longest [ms] | made of "
         "|\n|---|---|---|---|\n";
  for (const ResultLine& line : lines) {
    if (line.cell("verdict") != "left") continue;
    out << "| `" << commandOf(line) << "` | " << line.cell("cycles") << " | "
        << line.cell("longest_ms") << " | " << line.cell("category") << ": " << scenery(line)
        << " |\n";
  }
  out << "\n## What is refused\n\n| scene | what | made of |\n|---|---|---|\n";
  for (const ResultLine& line : lines) {
    if (line.cell("verdict") != "refused") continue;
    out << "| `" << commandOf(line) << "` | " << line.cell("what") << " | " << line.cell("category")
        << ": " << scenery(line) << " |\n";
  }
  return out.str();
}

}  // namespace palpate::torture
