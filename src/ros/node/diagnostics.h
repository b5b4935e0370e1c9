// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <mutex>
#include <string>
#include <vector>

#include "ros/haptics/haptic_loop.h"
#include "ros/input/input.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// /diagnostics: "simulation", "input" and "haptic loop". Only the publishing thread calls
/// update(), and only it may once running() was called.
class Diagnostics {
 public:
  Diagnostics();

  /// While the scene loads: what is being done.
  void loading(const std::string& what);
  /// What to warn of in every report on the simulation; "" for nothing.
  void setBlasWarning(const std::string& warning) { blas_warning_ = warning; }
  /// What loading decided, such as the method that auto took, for every report on the simulation.
  void setNotes(const std::vector<std::string>& notes) { notes_ = notes; }
  /// Where meshes are too coarse for the tools, for every report on the simulation.
  void setMeshAdvice(const std::vector<std::string>& advice) { mesh_advice_ = advice; }
  /// Whether the system let us: said with the force loop's own priority.
  struct Realtime {
    bool sends = false;   ///< Of the threads that send what it publishes.
    bool memory = false;  ///< Memory is locked.
  };
  void setRealtime(const Realtime& realtime) { realtime_ = realtime; }
  /// From now on there is a simulation to report on; `names`: of the instruments.
  void running(const Inputs* inputs, HapticLoop* haptic, const std::vector<std::string>& names);

  void update(const ReportFrame& frame, const Statistics& statistics);

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  void simulation(Status& status);
  void input(Status& status);
  void haptic(Status& status);

  diagnostic_updater::Updater updater_;
  std::string loading_, blas_warning_;
  std::vector<std::string> notes_, mesh_advice_, names_;
  const Inputs* inputs_ = nullptr;
  HapticLoop* haptic_ = nullptr;
  Realtime realtime_;
  ReportFrame frame_;
  Statistics statistics_;
  long haptic_cycles_ = 0;
  Steady::time_point haptic_since_ = Steady::now();
};

}  // namespace palpate::node
