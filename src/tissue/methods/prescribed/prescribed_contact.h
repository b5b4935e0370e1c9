// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "prescribed_displacements.h"

namespace palpate::tissue {

/// Contact as prescribed displacement [Castillo Leon 2011, sec. 7.5, for a segment as tool]: a
/// surface sample inside a tool is moved to the tool's surface along the normal and held. A sample
/// on an edge or triangle moves its nodes alike, unless one is held. Samples in tension are
/// released.
class PrescribedContact final : public PrescribedDisplacements {
 public:
  explicit PrescribedContact(FemBody* body) : body_(*body), held_(body->free) {}

  void clear() override;
  void keep() override { kept_ = holds_; }
  void goBack() override;
  void save(StateWriter* to) const override;
  void restore(StateReader* from) override;

  double nextStage(const Points& x, double s, double end) override;
  /// Maps holds to the present obstacles; holds by absent ones are released.
  void beginStage(const Points& x, double s, double end) override;
  bool holdWhatPenetrates(const Points& x) override;
  bool release(const Points& x, const Points& gradient) override;
  void moves(const Points& x, Points* move) const override;

  bool holds() const override { return !holds_.empty(); }
  const fem::FreeMask& free() const override { return held_; }
  double nodalNorm(const Points& gradient) const override;
  void report(const Points& x, const Points& gradient, TissueStep* out) const override;

 private:
  struct Hold {
    int sample;
    int number;         // Obstacle::number
    int obstacle = -1;  // index among the present obstacles
  };
  Vec3 force(const Hold& hold, const Points& gradient) const;
  bool free(int sample) const;
  void hold(const contact::Touch& touch);
  void updateMask();

  FemBody& body_;
  std::vector<Hold> holds_, kept_;
  std::vector<contact::Touch> touches_;
  fem::FreeMask held_;
};

}  // namespace palpate::tissue
