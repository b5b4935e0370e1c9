// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "command.h"
#include "commands.h"
#include "database_source.h"
#include "options.h"
#include "palpate/base/error.h"
#include "palpate/enrichment/database_folder.h"
#include "progress_line.h"

namespace palpate::cli {
namespace {

struct Options {
  DatabaseChoice choice;
  std::string out, part = "0/1";
  int samples = 60, threads = 1;
  double cone = 30.0;  // [degree]
};

/// Samples k, k + n, k + 2 n ... of all: "k/n".
struct Part {
  int k, n;

  explicit Part(const std::string& text) {
    char end = 0;
    std::istringstream in(text);
    char slash = 0;
    const bool read = static_cast<bool>(in >> k >> slash >> n) && slash == '/' && !(in >> end);
    if (!read || k < 0 || n < 1 || k >= n) {
      throw InputError("command line", "--part", text, "must be K/N with K from 0 to N-1");
    }
  }
};

/// Samples that several threads make, each with a body of its own.
class Work {
 public:
  Work(const Options& options, const DatabaseSource& source)
      : options_(options),
        source_(source),
        folder_(options.out, source.coarse, source.fine, source.made_by) {
    const Part part(options.part);
    for (int i = part.k; i < options.samples; i += part.n) {
      ++all_;
      if (!folder_.has(i)) left_.push_back(i);
    }
  }

  void run(start::ProgressLine* line) {
    std::vector<std::thread> threads;
    for (int t = 1; t < options_.threads; ++t) threads.emplace_back([this, line] { make(line); });
    make(line);
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  int all() const { return all_; }
  int made() const { return static_cast<int>(left_.size()); }
  int unsolved() const { return unsolved_; }

 private:
  void make(start::ProgressLine* line) {
    try {
      const std::unique_ptr<enrichment::PressedBody> body = source_.makeBody();
      for (;;) {
        const std::size_t next = next_++;
        if (next >= left_.size()) return;
        const int index = left_[next];
        enrichment::Deformation sample =
            enrichment::drawPress(options_.choice.plan, source_.coarse, source_.contacts, index);
        const bool solved = solve(body.get(), &sample);
        folder_.write(index, sample, solved);
        const std::lock_guard<std::mutex> lock(mutex_);
        unsolved_ += !solved;
        ++done_;
        line->show("pressing, " + std::to_string(unsolved_) + " not solved",
                   static_cast<double>(done_) / static_cast<double>(left_.size()));
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_ = left_.size();
    }
  }

  bool solve(enrichment::PressedBody* body, enrichment::Deformation* sample) const {
    solver::StaticSettings settings;
    settings.tolerance = 1e-6;
    const Vec3 contact = source_.coarse.points.col(sample->contact);
    return body->press({contact, sample->force}, settings, &sample->fine).status ==
           solver::SolveStatus::kConverged;
  }

  const Options& options_;
  const DatabaseSource& source_;
  enrichment::DatabaseFolder folder_;
  std::vector<int> left_;
  int all_ = 0;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;  // of what follows
  int done_ = 0, unsolved_ = 0;
  std::exception_ptr failure_;
};

void check(const Options& options) {
  Part{options.part};
  requirePositive("--force", options.choice.plan.force);
  requirePositive("--cone", options.cone);
  if (options.choice.edge_length) requirePositive("--edge-length", *options.choice.edge_length);
  if (options.choice.patch) requirePositive("--patch", *options.choice.patch);
}

int run(Options options) {
  check(options);
  options.choice.plan.cone = options.cone * std::acos(-1.0) / 180.0;
  start::ProgressLine line;
  const DatabaseSource source = readDatabaseSource(
      options.choice, [&](const std::string& what, double part) { line.show(what, part); });
  Work work(options, source);
  work.run(&line);
  line.finish();
  std::cout << options.out << "\n  surfaces         " << source.coarse.points.cols() << " points, "
            << source.coarse.triangles.cols() << " triangles; " << source.fine.points.cols()
            << " points, " << source.fine.triangles.cols() << " triangles\n"
            << "  body             " << source.mesh.numPoints() << " nodes, "
            << source.mesh.numTets() << " tetrahedra\n"
            << "  samples          " << work.all() << " of this part, " << work.made()
            << " made now, " << work.unsolved() << " of them not solved\n";
  return work.unsolved() > 0 ? kNotConverged : kOk;
}

}  // namespace

void addDatabase(CLI::App& app, Action& action) {
  Command command(app, "database",
                  "Press an organ again and again, for models that learn how it deforms; what is "
                  "there already is kept");
  const auto options = std::make_shared<Options>();
  DatabaseChoice& choice = options->choice;
  command.option("scene", &choice.scene, "Scene file (.yaml)").required();
  command.option("--organ", &choice.organ, "Its organ; may be left out where there is one only");
  command.option("--out", &options->out, "Folder, made if it is not there").required();
  command.option("--samples", &options->samples, "How many presses in all; 60 if not given")
      .between(1, 999999);
  command.option("--force", &choice.plan.force, "The largest [N]; the smallest is a quarter of it")
      .required();
  command.option("--cone", &options->cone,
                 "Largest angle to the inward normal [degree]; 30 if not given");
  command.option("--seed", &choice.plan.seed, "Of the presses; 1 if not given");
  command.option("--triangles", &choice.triangles, "Of the coarse surface; 276 if not given")
      .between(4, 1000000);
  command
      .option("--splits", &choice.splits,
              "How often each is cut in four, to the fine surface; 2 if not given")
      .between(0, 5);
  command.option("--edge-length", &choice.edge_length,
                 "Of the tetrahedra [m]; the fine surface's mean if not given");
  command.option("--patch", &choice.patch,
                 "Radius of what is pressed [m]; the coarse surface's mean edge if not given");
  command.option("--part", &options->part,
                 "K/N: samples K, K + N, K + 2 N ... only, for N programs at once");
  command.option("--threads", &options->threads, "Presses solved at once; 1 if not given")
      .between(1, 256);
  command.onUse([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace palpate::cli
