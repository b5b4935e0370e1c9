// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/sample_maker.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace palpate::enrichment {
namespace {

bool solve(const PressedSurfaces& surfaces, PressedBody* body, Deformation* sample) {
  solver::StaticSettings settings;
  settings.tolerance = 1e-6;
  const Vec3 contact = surfaces.coarse.points.col(sample->contact);
  return body->press({contact, sample->force}, settings, &sample->fine).status ==
         solver::SolveStatus::kConverged;
}

}  // namespace

SampleMaker::SampleMaker(const std::string& folder, PressedSurfaces surfaces, int samples,
                         SharePart share)
    : surfaces_(std::move(surfaces)),
      folder_(folder, surfaces_.coarse, surfaces_.fine, surfaces_.made_by) {
  for (int i = share.part; i < samples; i += share.of) {
    ++wanted_;
    if (!folder_.has(i)) left_.push_back(i);
  }
}

void SampleMaker::run(int threads,
                      const std::function<void(const std::string&, double)>& progress) {
  if (left_.empty()) return;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // guards the members below
  int done = 0;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      const std::unique_ptr<PressedBody> body = surfaces_.make_body();
      for (;;) {
        const std::size_t mine = next++;
        if (mine >= left_.size()) return;
        const int index = left_[mine];
        Deformation sample = drawPress(surfaces_.plan, surfaces_.coarse, surfaces_.contacts, index);
        const bool solved = solve(surfaces_, body.get(), &sample);
        folder_.write(index, sample, solved);
        const std::lock_guard<std::mutex> lock(mutex);
        unsolved_ += !solved;
        ++done;
        if (progress) {
          progress("pressing, " + std::to_string(unsolved_) + " not solved",
                   static_cast<double>(done) / static_cast<double>(left_.size()));
        }
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!failure) failure = std::current_exception();
      next = left_.size();
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace palpate::enrichment
