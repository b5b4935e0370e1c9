// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::start {

/// Sets what the linear algebra libraries read before main() begins, then starts the program anew;
/// returns if nothing was to be set or that failed. What the user has set stays.
///
/// OMP_THREAD_LIMIT=1: CHOLMOD asks for four OpenMP threads of its own, OMP_NUM_THREADS
/// notwithstanding, which is slower on few cores. OPENBLAS_NUM_THREADS=1: its own threads spin
/// while they wait, and fight ours for the cores. OPENBLAS_CORETYPE=SKYLAKEX where the processor
/// has AVX-512: OpenBLAS 0.3.21 takes recent Intel models for a Prescott.
void restartWithSolverEnvironment(char** argv);

/// Has the allocator keep what is freed, instead of handing it back to the system and asking for
/// new pages, each of which costs a fault: of a mesh that adapts, all the time. What the user has
/// set by MALLOC_TRIM_THRESHOLD_ and its like stays.
void keepFreedMemory();

/// Has a write beyond the largest file that the system allows (ulimit -f) fail as one to a full
/// disk does. The signal that comes with it would end the program.
void letLargeWritesFail();

}  // namespace palpate::start
