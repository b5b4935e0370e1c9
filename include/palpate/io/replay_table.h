// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/io/csv_writer.h"
#include "palpate/scene/scene.h"
#include "palpate/sim/simulator.h"

namespace palpate::io {

/// Header of a replay's result table: t, spatial wrench and contact of each instrument (prefix
/// "instrument/" if there are several), solver figures.
std::vector<std::string> replayColumns(const scene::Scene& scene);

/// Writes a cycle at time `t` [s] as a row; all but the wall time `step_ms` is reproducible.
void writeReplayRow(double t, const sim::StepResult& result, double step_ms, CsvWriter* csv);

}  // namespace palpate::io
