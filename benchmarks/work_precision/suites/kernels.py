# SPDX-License-Identifier: GPL-3.0-or-later
"""The kernels of a step one by one, by palpate_micro."""

import json
import subprocess

from accuracy.rows import Section, table
from accuracy.solve import Failed, build_folder

QUICK = False


def micro_program():
    """The built program, or None: without google-benchmark there is none."""
    found = [p for p in build_folder().rglob("palpate_micro") if p.is_file()]
    return found[0] if found else None


def measure(context, seconds=0.02):
    """{name: fields} of all micro-benchmarks; times in nanoseconds. Run once, then kept."""
    file = context.work / "runs" / "micro.json"
    if not file.exists():
        program = micro_program()
        if program is None:
            raise Failed("palpate_micro is not built: install libbenchmark-dev, run scripts/build.sh "
                         "palpate_micro")
        file.parent.mkdir(parents=True, exist_ok=True)
        context.progress("palpate_micro")
        # p1p1 factors its pressures' compliance for every one of its figures, which takes minutes.
        done = subprocess.run([str(program), "--benchmark_filter=-p1p1", f"--benchmark_min_time={seconds}", f"--benchmark_out={file}",
                               "--benchmark_repetitions=3", "--benchmark_out_format=json"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            file.unlink(missing_ok=True)
            raise Failed(f"palpate_micro: {done.stderr.strip()[-300:]}")
    return fastest(json.loads(file.read_text())["benchmarks"])


def fastest(benchmarks):
    """Of the repetitions of each name the fastest one, as a dictionary by name."""
    unit = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    found = {}
    for entry in benchmarks:
        if entry.get("run_type") == "aggregate":
            continue
        name = entry["name"].replace("/real_time", "")
        entry = {**entry, "ns": entry["real_time"] * unit[entry["time_unit"]]}
        if name not in found or entry["ns"] < found[name]["ns"]:
            found[name] = entry
    return found


def _duration(ns):
    for size, unit in ((1e6, "ms"), (1e3, "us")):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def _note(entry):
    notes = []
    if "per_tet" in entry:
        notes.append(f"{1e9 * entry['per_tet']:.3g} ns a tetrahedron")
    if "per_iteration" in entry:
        notes.append(f"{1e6 * entry['per_iteration']:.3g} us an iteration")
    if "per_sample" in entry:
        notes.append(f"{1e9 * entry['per_sample']:.3g} ns a sample")
    if "bytes_per_second" in entry:
        notes.append(f"{entry['bytes_per_second'] / 1e9:.1f} GB/s")
    return ", ".join(notes)


def run(context):
    found = measure(context)
    lines = [[f"`{name}`", _duration(entry["ns"]), _note(entry)] for name, entry in found.items()]
    return Section("Kernels", TEXT, [], [], [table(["kernel", "time", ""], lines)])


TEXT = """The parts of a step one by one (`palpate_micro`, fastest of three): elasticity by element and law,
matrix times vector (`multiply`, and `product` as conjugate gradients do it, in single precision) beside a
loop that only reads as many bytes (`read`, `read_as_product`), linear solves of
a step of 10 ms, contact with a ball in a cube's top, and the hand-over of a loop to the threads. Laws
other than the neo-Hookean ones show what the generic path costs."""
