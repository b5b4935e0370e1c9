// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/io/csv_writer.h"
#include "palpate/scene/scene.h"
#include "palpate/sim/simulator.h"

namespace palpate::io {

/// Head of a replay's result table: t, per instrument the spatial wrench and the contact (with
/// "instrument/" before where the scene has several), the solver's numbers.
std::vector<std::string> replayColumns(const scene::Scene& scene);

/// A cycle at time `t` [s] as a row; all but `step_ms`, its wall time, depends on the inputs alone.
void writeReplayRow(double t, const sim::StepResult& result, double step_ms, CsvWriter* csv);

}  // namespace palpate::io
