// SPDX-License-Identifier: GPL-3.0-or-later
#include "tortures.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <thread>

#include "files.h"
#include "palpate/base/error.h"
#include "palpate/base/phase_times.h"
#include "palpate/torture/shrink.h"

namespace palpate::cli {
namespace {

constexpr int kAgain = 10;  // every so manieth scene runs again by two threads,
constexpr int kCut = 2;     // and those with this remainder, of which none is live, with cuts

}  // namespace

Part readPart(const std::string& text) {
  Part part;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d/%d%c", &part.number, &part.of, &rest);
  if (read != 2 || part.of < 1 || part.number < 1 || part.number > part.of) {
    throw InputError("command line", "--part", text, "must be i/n, 1 <= i <= n: 2/4");
  }
  return part;
}

Tortures::Tortures(const TortureOptions& options, const Part& part)
    : options_(options),
      folder_(makeFolder(options.out)),
      table_((folder_ / ("results_" + part.name() + ".csv")).string()),
      running_((folder_ / ("running_" + part.name())).string()) {
  limits_.cycle = options.cycle_limit;
  limits_.scene = options.scene_limit;
  limits_.sleep_until = [](double time) {
    std::this_thread::sleep_for(std::chrono::duration<double>(time - steadySeconds()));
  };
}

void Tortures::noteCrash() {
  std::ifstream in(running_);
  int number = -1;
  if (!(in >> number)) return;
  in.close();
  torture::appendResult(table_, torture::crashLine(drawn(number), options_.commit));
  std::filesystem::remove(running_);
}

torture::ResultLine Tortures::runOne(const torture::TortureScene& scene) {
  std::ofstream(running_) << scene.number << "\n";
  const std::string folder =
      makeFolder((folder_ / ("scene_" + std::to_string(scene.number))).string());
  torture::Outcome outcome = torture::run(scene, folder, limits_);
  if (scene.number % kAgain == 0 && hasOtherBitsByTwoThreads(scene, folder, outcome)) {
    outcome.failures.push_back({"same", 0, "two threads give other bits"});
  }
  if (scene.number % kAgain == kCut) runCut(scene, folder, &outcome);
  // What is made plainer is run without cuts.
  const bool shrinks = !outcome.failures.empty() && outcome.failures.front().criterion != "cut";
  if (shrinks && options_.shrink > 0.0) {
    const torture::Failure& failure = outcome.failures.front();
    const torture::TortureScene small =
        torture::shrunk(scene, failure, folder, limits_, options_.shrink);
    torture::run(small, folder, limits_);  // so that the files are those of the last that failed
  }
  const torture::ResultLine line = torture::resultLine(scene, outcome, options_.commit);
  torture::appendResult(table_, line);
  if (outcome.failures.empty() && !options_.keep) std::filesystem::remove_all(folder);
  std::filesystem::remove(running_);
  return line;
}

bool Tortures::hasOtherBitsByTwoThreads(const torture::TortureScene& scene,
                                        const std::string& folder,
                                        const torture::Outcome& outcome) const {
  if (!outcome.passed() || !outcome.whole || scene.live) return false;
  torture::RunLimits two = limits_;
  two.threads = 2;
  const torture::Outcome again = torture::run(scene, folder, two);
  // What was ended for its time goes on otherwise.
  const bool ended = !again.whole || again.fails("cycle");
  return !ended && again.hashes != outcome.hashes;
}

void Tortures::runCut(const torture::TortureScene& scene, const std::string& folder,
                      torture::Outcome* outcome) const {
  if (!outcome->passed() || !outcome->whole || scene.live) return;
  torture::RunLimits cut = limits_;
  cut.cuts = 1;
  for (const torture::Failure& failure : torture::run(scene, folder, cut).failures) {
    if (failure.criterion == "cycle") continue;  // by the clock
    outcome->failures.push_back({"cut", failure.row, failure.criterion + ": " + failure.what});
  }
}

torture::TortureScene Tortures::drawn(int number) const {
  torture::TortureScene scene =
      torture::drawScene(static_cast<std::uint64_t>(options_.seed), number);
  if (!options_.method.empty()) scene.method = options_.method;
  return scene;
}

std::string Tortures::commandOf(const torture::TortureScene& scene) const {
  const std::string folder = (folder_ / ("scene_" + std::to_string(scene.number))).string();
  torture::SceneFiles files{folder + "/scene.yaml", folder + "/trajectory.csv", ""};
  if (scene.start != torture::Start::kRest) files.state = folder + "/start.state";
  return files.command();
}

}  // namespace palpate::cli
