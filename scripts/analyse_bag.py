#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, CSV and plot of a bag that recorded palpate's outputs: of a node, or of palpate_replay_bag.

    scripts/analyse_bag.py BAG [--csv FILE] [--plot FILE]

Finds the wrenches of all instruments (geometry_msgs/WrenchStamped on .../spatial/measured_cf, or on
.../body/measured_cf of instruments that were recorded without it) and the step reports (palpate/StepReport), which
may be missing. Of nodes in several namespaces, each is looked at by itself.
"""
import argparse
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import rosbag  # noqa: E402

SKIP = "skipped_"  # what the counters of skipped work begin with
REAL_TIME = 0.9  # the share of it that has to be simulated, or forces are those of a faster hand
BLUE, RED, GREEN, GREY = "#1f4e79", "#b5322a", "#3a7d44", "#777777"
SPATIAL, BODY, REPORT = "/spatial/measured_cf", "/body/measured_cf", "/step_report"


class Run:
    """What one node said. Time stamps are the recorder's [s]: the same clock for all topics."""

    def __init__(self, namespace):
        self.namespace = namespace
        self.topics = {}  # instrument: topic
        self.wrenches = {}  # instrument: (n, 7), t and force and torque
        self.reports = []  # (t, message)

    def window(self):
        """From the first input that was simulated to the last one; of wrenches alone, all of it."""
        running = [t for t, message in self.reports if message.state == "RUNNING"]
        if self.reports and not running:
            sys.exit("%s: the simulation never ran; its last state is %s" %
                     (self.namespace + REPORT, self.reports[-1][1].state))
        return (running[0], running[-1] + 0.5) if running else (-np.inf, np.inf)

    def cut(self):
        first, last = self.window()
        self.reports = [r for r in self.reports if first <= r[0] <= last]
        for name, wrench in self.wrenches.items():
            wrench = np.array(wrench, dtype=float).reshape(-1, 7)
            wrench = wrench[(wrench[:, 0] >= first) & (wrench[:, 0] <= last)]
            if len(wrench) < 2:
                sys.exit("%s: fewer than two wrenches were recorded while the simulation ran" % self.topics[name])
            if not np.isfinite(wrench).all():
                sys.exit("%s: a wrench is not finite" % self.topics[name])
            self.wrenches[name] = wrench
        self.start = self.reports[0][0] if self.reports else min(w[0, 0] for w in self.wrenches.values())


def parts(topic, ending):
    """(namespace, instrument) of a topic /namespace/instrument/spatial/measured_cf."""
    namespace, _, instrument = topic[:-len(ending)].rpartition("/")
    return namespace, instrument


def read(path):
    runs, sources = {}, {}
    try:
        bag = rosbag.Bag(path)
    except (OSError, rosbag.ROSBagException) as error:
        sys.exit("%s: %s" % (path, error))
    with bag:
        types = {name: info.msg_type for name, info in bag.get_type_and_topic_info()[1].items()}
        for ending in SPATIAL, BODY:
            for name in sorted(types):
                if types[name] != "geometry_msgs/WrenchStamped" or not name.endswith(ending):
                    continue
                namespace, instrument = parts(name, ending)
                run = runs.setdefault(namespace, Run(namespace))
                if instrument not in run.topics:
                    run.topics[instrument], run.wrenches[instrument] = name, []
                    sources[name] = (run, instrument)
        for name in sorted(types):
            namespace = name[:-len(REPORT)]
            if types[name] == "palpate/StepReport" and name.endswith(REPORT) and namespace in runs:
                sources[name] = (runs[namespace], None)
        for name, message, at in bag.read_messages(topics=list(sources)):
            run, instrument = sources[name]
            if instrument is None:
                run.reports.append((at.to_sec(), message))
            else:
                f, m = message.wrench.force, message.wrench.torque
                run.wrenches[instrument].append((at.to_sec(), f.x, f.y, f.z, m.x, m.y, m.z))
    if not runs:
        sys.exit("%s: no geometry_msgs/WrenchStamped on a topic that ends in %s or %s; it has %s" %
                 (path, SPATIAL, BODY, ", ".join(sorted(types)) or "nothing"))
    for run in runs.values():
        run.cut()
    return [runs[namespace] for namespace in sorted(runs)]


def simulated_share(reports):
    """How much was simulated of the time between reports of a simulation that ran, or None.

    By the simulated time that the reports give, so that it counts neither how many steps a row of the input was cut
    into, nor pauses, resets, and reports that the recorder missed.
    """
    simulated = real = 0.0
    for (t0, before), (t1, after) in zip(reports, reports[1:]):
        if before.state == after.state == "RUNNING" and after.time >= before.time:
            simulated += after.time - before.time
            real += t1 - t0
    return simulated / real if real > 0.0 else None


def column(reports, name):
    return np.array([getattr(message, name) for _, message in reports], dtype=float)


def cycle_times(reports):
    return np.array([message.cycle_ms for _, message in reports if message.state == "RUNNING"])


def phases(times, touching):
    """Intervals of contact: a report holds until the next one. Gaps below 0.1 s are bridged."""
    spans = []
    for t, end, touch in zip(times, list(times[1:]) + [times[-1]], touching):
        if not touch:
            continue
        if spans and t - spans[-1][1] < 0.1:
            spans[-1][1] = end
        else:
            spans.append([t, end])
    return spans


def write_csv(path, run):
    """Of several instruments, a column says whose row it is."""
    several = len(run.wrenches) > 1
    rows = [(row, name) for name, wrench in run.wrenches.items() for row in wrench]
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", *(["instrument"] if several else []), "fx", "fy", "fz", "tx", "ty", "tz"])
        for row, name in sorted(rows, key=lambda item: item[0][0]):
            writer.writerow(["%.6f" % (row[0] - run.start), *([name] if several else []),
                             *("%.9g" % value for value in row[1:])])


def plot_force(axis, topic, wrench, start):
    t, force = wrench[:, 0] - start, wrench[:, 1:4]
    size = np.linalg.norm(force, axis=1)
    axis.plot(t, size, color="black", lw=1.8, label="|F|")
    for k, (name, color) in enumerate(zip("xyz", (RED, GREEN, BLUE))):
        axis.plot(t, force[:, k], color=color, lw=1.0, label="F" + name)
    peak = int(np.argmax(size))
    axis.annotate("%.2f N" % size[peak], (t[peak], size[peak]), xytext=(0, 6),
                  textcoords="offset points", ha="center", weight="bold")
    axis.margins(y=0.12)
    axis.set_ylabel("force of the tissue\non the tool [N]")
    axis.legend(loc="upper left", ncol=5, framealpha=0.9)
    axis.set_title("%s, expressed in %s" % (topic, "world" if topic.endswith(SPATIAL) else "the control frame"),
                   loc="left", fontsize=10, color=GREY)


def plot_contact(axis, reports, start):
    times = np.array([t for t, _ in reports]) - start
    axis.step(times, 1e3 * column(reports, "max_penetration"), color=BLUE, lw=1.2, where="post")
    axis.set_ylabel("deepest sample\nin a tool [mm]")
    axis.set_ylim(bottom=0)
    count = axis.twinx()
    count.step(times, column(reports, "contacts"), color=RED, lw=0.9, where="post")
    count.set_ylabel("contacts", color=RED)
    count.set_ylim(bottom=0)
    count.grid(False)
    count.spines["right"].set_visible(True)


def plot_cycles(axis, cycle):
    limit = max(np.percentile(cycle, 99.5) * 1.15, 1e-3)
    axis.hist(np.minimum(cycle, limit), bins=60, range=(0, limit), color=BLUE)
    for q, style in ((50, "-"), (99, "--")):
        value = np.percentile(cycle, q)
        axis.axvline(value, color=RED, ls=style, lw=1.2, label="p%d = %.2f ms" % (q, value))
    axis.set_xlim(0, limit)
    axis.set_xlabel("cycle time [ms]\n(longer ones in the last bar)")
    axis.set_ylabel("cycles")
    axis.legend(framealpha=0.9)


def plot_gaps(axis, wrenches):
    gaps = np.concatenate([1e3 * np.diff(wrench[:, 0]) for wrench in wrenches])
    limit = max(3.0, 1.5 * np.percentile(gaps, 99))
    axis.hist(np.minimum(gaps, limit), bins=60, range=(0, limit), color=GREEN)
    axis.set_xlim(0, limit)
    axis.set_yscale("log")
    axis.set_xlabel("time between two wrenches, as recorded [ms]\n(longer ones in the last bar)")
    axis.set_ylabel("messages")


def plot(path, run):
    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
                         "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True})
    count, reported = len(run.wrenches), bool(run.reports)
    heights = [2.2] * count + ([1.2] if reported else []) + [1.3]
    figure = plt.figure(figsize=(11, 1.7 * sum(heights)), constrained_layout=True)
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights)
    top = figure.add_subplot(grid[0, :])
    over_time = [top] + [figure.add_subplot(grid[k, :], sharex=top) for k in range(1, len(heights) - 1)]
    for axis, (name, wrench) in zip(over_time, run.wrenches.items()):
        plot_force(axis, run.topics[name], wrench, run.start)
    last = figure.add_subplot(grid[-1, 1] if reported else grid[-1, :])
    plot_gaps(last, run.wrenches.values())
    if reported:
        plot_contact(over_time[-1], run.reports, run.start)
        plot_cycles(figure.add_subplot(grid[-1, 0]), cycle_times(run.reports))
        times = np.array([t for t, _ in run.reports]) - run.start
        for axis in over_time:
            for k, (a, b) in enumerate(phases(times, column(run.reports, "contacts") > 0)):
                axis.axvspan(a, b, color="#f2d9b8", alpha=0.6, lw=0, label="contact" if k == 0 else None)
        top.legend(loc="upper left", ncol=5, framealpha=0.9)
    for axis in over_time[:-1]:
        plt.setp(axis.get_xticklabels(), visible=False)
    over_time[-1].set_xlabel("time [s]")
    top.set_xlim(0.0, max(w[-1, 0] for w in run.wrenches.values()) - run.start)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def force_rows(run):
    rows = []
    for name, wrench in run.wrenches.items():
        size = np.linalg.norm(wrench[:, 1:4], axis=1)
        of = " of " + name if len(run.wrenches) > 1 else ""
        rows.append(("peak force" + of, "%.3f N" % size.max()))
        rows.append(("force loop rate" + of, "%.0f Hz" % ((len(wrench) - 1) / (wrench[-1, 0] - wrench[0, 0]))))
    return sorted(rows, key=lambda row: not row[0].startswith("peak"))


def report_rows(reports):
    cycle = cycle_times(reports)
    contacts, depth = column(reports, "contacts"), column(reports, "max_penetration")
    failed = sum(message.status != "converged" for _, message in reports)
    running = [t for t, message in reports if message.state == "RUNNING"]
    skips = ", ".join(
        "%s %d" % (name[len(SKIP):].replace("_", " "), column(reports, name).sum())
        for name in reports[0][1].__slots__ if name.startswith(SKIP))
    rows = [
        ("the mesh's error, estimated", "%.3f N at most" % column(reports, "mesh_error").max()),
        ("contacts, most at once", "%d" % contacts.max()),
        ("contact phases", "%d" % len(phases([t for t, _ in reports], contacts > 0))),
        ("deepest sample in a tool", "%.3f mm" % (1e3 * depth.max())),
    ]
    if getattr(reports[0][1], "finest_edge", 0.0) > 0.0:  # an older bag has none
        edges = 1e3 * column(reports, "finest_edge")
        rows.insert(1, ("edges at tools, live", "%.3g to %.3g mm" % (edges.min(), edges.max())))
    if cycle.max() > 0.0:  # a replay leaves it out
        rows.append(("cycle time p50 / p99 / max", "%.2f / %.2f / %.2f ms" %
                     (np.percentile(cycle, 50), np.percentile(cycle, 99), cycle.max())))
    rows.append(("cycles, of which not converged", "%d, %d" % (len(cycle), failed)))
    if len(running) > 1:
        rows.append(("simulation rate", "%.1f Hz" % ((len(running) - 1) / (running[-1] - running[0]))))
    rows.append(("work skipped", skips))
    return rows


def table(run):
    rows = force_rows(run) + (report_rows(run.reports) if run.reports else [])
    width = max(len(name) for name, _ in rows)
    for name, value in rows:
        print("  %-*s  %s" % (width, name, value))
    if not run.reports:
        print("  no step reports of %s were recorded" % (run.namespace + REPORT))
    share = simulated_share(run.reports)
    if share is not None and share < REAL_TIME:
        print("WARNING: %.0f %% of real time was simulated: tools went as much faster through the tissue than the arm"
              " did,\n  and forces may be too large. palpate_replay_bag gives those of the same joints on any machine."
              % (100.0 * share))


def file_of(path, run, runs):
    """`path`, with the namespace before its ending where there are several."""
    if len(runs) == 1:
        return path
    stem, ending = os.path.splitext(path)
    return stem + run.namespace.replace("/", "_") + ending


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag")
    parser.add_argument("--csv", metavar="FILE", help="also write the wrenches as a table")
    parser.add_argument("--plot", metavar="FILE", help="also draw forces, contact and times")
    arguments = parser.parse_args()
    runs = read(arguments.bag)
    for run in runs:
        if len(runs) > 1:
            print((run.namespace or "/") + ":")
        table(run)
        if arguments.csv:
            write_csv(file_of(arguments.csv, run, runs), run)
        if arguments.plot:
            plot(file_of(arguments.plot, run, runs), run)


if __name__ == "__main__":
    main()
