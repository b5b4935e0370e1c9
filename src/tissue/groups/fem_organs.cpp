// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem_organs.h"

#include <algorithm>

#include "body_groups.h"
#include "palpate/base/error.h"
#include "palpate/tissue/skips.h"

namespace palpate::tissue {
namespace {

std::vector<std::shared_ptr<const Interaction>> makeInteractions(const ModelSettings& settings) {
  std::vector<std::shared_ptr<const Interaction>> made;
  if (!settings.touching.organs) return made;
  made.reserve(settings.interactions.size());
  for (const InteractionEntry& entry : settings.interactions) made.push_back(entry.make(settings));
  return made;
}

class FemOrgans final : public TissueModel {
 public:
  FemOrgans(std::vector<NamedOrgan> organs, const ModelSettings& settings)
      : touching_(settings.touching),
        organs_(std::move(organs)),
        neighbours_(
            makeInteractions(settings),
            [this](const GroupBody& a, const GroupBody& b) { return mayInteract(a, b); },
            !settings.skip.apart_organs),
        reports_(organs_.size()) {
    for (std::size_t k = 0; k < organs_.size(); ++k) by_name_.push_back(k);
    std::sort(by_name_.begin(), by_name_.end(),
              [this](std::size_t a, std::size_t b) { return organs_[a].name < organs_[b].name; });
    takeBodies();
  }

  int numOrgans() const override { return static_cast<int>(organs_.size()); }
  SurfaceState surfaceState(int organ) const override { return at(organ).surfaceState(0); }
  mesh::CellMesh cells(int organ) const override { return at(organ).cells(0); }
  std::vector<std::string> methods(int organ) const override { return at(organ).methods(0); }
  const std::vector<TissueStep>* reports() const override { return &reports_; }

  std::vector<std::string> notes() const override {
    std::vector<std::string> all;
    for (const NamedOrgan& organ : organs_) {
      for (const std::string& note : organ.tissue->notes()) all.push_back(noteOn(organ.name, note));
    }
    if (!neighbours_.any()) return all;
    for (const GroupBody& b : bodies_) {
      if (b.body->motion()) continue;
      all.push_back(noteOn(*b.organ, "method " + b.body->body().method +
                                         " solves organs one by one: it touches no other organ, "
                                         "nor itself; an implicit method of another model would"));
    }
    return all;
  }

  void setInterrupt(const solver::Interrupt* interrupt) override {
    for (const NamedOrgan& organ : organs_) organ.tissue->setInterrupt(interrupt);
  }

  void setMeshPace(const MeshPace& pace) override {
    for (const NamedOrgan& organ : organs_) organ.tissue->setMeshPace(pace);
  }

  const TissueStep& step(const std::vector<contact::Obstacle>& obstacles, double dt) override {
    for (const NamedOrgan& organ : organs_) organ.tissue->beginCycle(obstacles, dt);
    takeBodies();
    for (const GroupBody& b : bodies_) b.body->begin(obstacles, dt);
    neighbours_.find(bodies_, dt, &apart_);
    groups_.step(bodies_, neighbours_, dt);
    startAnewWhatIsPutBack();
    report(obstacles, dt);
    return out_;
  }

  void reset() override {
    for (const NamedOrgan& organ : organs_) organ.tissue->reset();
    neighbours_.forget();
    groups_.forget();
  }

  void setPositions(int organ, const Points& positions, const Points& velocities) override {
    at(organ).setPositions(0, positions, velocities);
    takeBodies();
    for (const GroupBody& b : bodies_) {
      b.body->wake();
      b.body->reached();
    }
    neighbours_.forget();
    groups_.forget();
  }

  State state() const override {
    StateWriter out;
    for (const NamedOrgan& organ : organs_) {
      const State state = organ.tissue->state();
      out.put(state.kind);
      out.put(state.bytes);
    }
    neighbours_.save(&out);
    groups_.save(&out);
    return {kind(), out.bytes()};
  }

  void restore(const State& state) override {
    checkKind(state, kind());
    StateReader in(state.bytes);
    for (const NamedOrgan& organ : organs_) {
      State own;
      in.get(&own.kind);
      in.get(&own.bytes);
      try {
        organ.tissue->restore(own);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(noteOn(organ.name, error.what()));
      }
    }
    takeBodies();
    neighbours_.restore(bodies_, &in);
    groups_.restore(bodies_, &in);
    in.finish();
  }

 private:
  OrganBodies& at(int organ) const { return *organs_[static_cast<std::size_t>(organ)].tissue; }
  std::string kind() const { return "fem, " + std::to_string(organs_.size()) + " organs"; }
  // A single organ is named by the caller.
  std::string noteOn(const std::string& organ, const std::string& note) const {
    return (organs_.size() > 1 ? "organ " + organ + ": " : "") + note;
  }
  bool mayInteract(const GroupBody& a, const GroupBody& b) const {
    return a.body->motion() && b.body->motion() && touching_.mayTouch(*a.organ, *b.organ);
  }

  // Members that were reset to rest have invalid contact history with their neighbours.
  void startAnewWhatIsPutBack() {
    put_back_.clear();
    for (const GroupBody& b : bodies_) {
      put_back_.push_back(b.body->report().recovery == static_cast<int>(Recovery::kPutBack));
    }
    if (std::find(put_back_.begin(), put_back_.end(), 1) == put_back_.end()) return;
    for (const std::unique_ptr<InteractingPair>& m : neighbours_.all()) {
      if (!m->acts || (!put_back_[m->a] && !put_back_[m->b])) continue;
      bodies_[m->a].body->wake();
      bodies_[m->b].body->wake();
    }
    neighbours_.forgetOf(put_back_);
    groups_.forgetOf(put_back_);
  }

  void takeBodies() {
    bodies_.clear();
    for (const std::size_t k : by_name_) {
      found_.clear();
      organs_[k].tissue->addBodies(&found_);
      const std::uint64_t revision = organs_[k].tissue->surfaceState(0).revision;
      for (FemOrgan* body : found_) {
        bodies_.push_back({&organs_[k].name, static_cast<int>(k), body, revision});
      }
    }
  }

  void report(const std::vector<contact::Obstacle>& obstacles, double dt) {
    out_.clear();
    out_.slept = out_.satisfied = true;
    for (std::size_t k = 0; k < organs_.size(); ++k) {
      TissueStep& organ = reports_[k];
      organ = organs_[k].tissue->endCycle(obstacles, dt);
      for (TissueContact& contact : organ.contacts) contact.organ = static_cast<int>(k);
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        if (bodies_[b].number == static_cast<int>(k)) organ.apart_organs += apart_[b];
      }
      mergeFigures(Over::kOrgans, organ, &out_);
      mergeSkips(Over::kOrgans, organ, &out_);
      out_.contacts.insert(out_.contacts.end(), organ.contacts.begin(), organ.contacts.end());
      out_.support_force += organ.support_force;
      out_.gravity_force += organ.gravity_force;
      out_.inertia_force += organ.inertia_force;
      out_.interaction_force += organ.interaction_force;
    }
    if (out_.slept) out_.satisfied = false;
  }

  TouchingOrgans touching_;
  std::vector<NamedOrgan> organs_;
  std::vector<std::size_t> by_name_;
  std::vector<GroupBody> bodies_;
  std::vector<FemOrgan*> found_;
  NeighbourSearch neighbours_;
  BodyGroups groups_;
  std::vector<int> apart_;      // pairs without interaction, of each body
  std::vector<char> put_back_;  // whether each body was reset in this cycle
  std::vector<TissueStep> reports_;
  TissueStep out_;
};

}  // namespace

std::unique_ptr<TissueModel> makeFemOrgans(std::vector<NamedOrgan> organs,
                                           const ModelSettings& settings) {
  return std::make_unique<FemOrgans>(std::move(organs), settings);
}

}  // namespace palpate::tissue
