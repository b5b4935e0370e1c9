#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table, CSV and plot of a bag that recorded palpate's outputs.

    scripts/analyse_bag.py BAG --csv FILE --plot FILE

Reads the first wrench topic that ends in spatial/measured_cf and the palpate/StepReport topic.
"""
import argparse
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import rosbag  # noqa: E402

SKIP = "skipped_"  # what the counters of skipped work begin with
REAL_TIME = 0.9  # the share of it that has to be simulated, or forces are those of a faster hand
BLUE, RED, GREEN, GREY = "#1f4e79", "#b5322a", "#3a7d44", "#777777"


def read(path):
    """Time stamps are the recorder's: the same clock for all topics, in [s] from the first report."""
    wrenches, reports, topic = [], [], None
    with rosbag.Bag(path) as bag:
        names = bag.get_type_and_topic_info()[1]
        for name, info in sorted(names.items()):
            if info.msg_type == "geometry_msgs/WrenchStamped" and name.endswith("spatial/measured_cf"):
                topic = topic or name
        for name, message, at in bag.read_messages():
            if name == topic:
                f, m = message.wrench.force, message.wrench.torque
                wrenches.append((at.to_sec(), f.x, f.y, f.z, m.x, m.y, m.z))
            elif names[name].msg_type == "palpate/StepReport":
                reports.append((at.to_sec(), message))
    if not wrenches or not reports:
        sys.exit("%s: %d wrenches and %d step reports; both are needed" %
                 (path, len(wrenches), len(reports)))
    return topic, np.array(wrenches), reports


def column(reports, name):
    return np.array([getattr(message, name) for _, message in reports], dtype=float)


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


def write_csv(path, wrench, start):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", "fx", "fy", "fz", "tx", "ty", "tz"])
        for row in wrench:
            writer.writerow(["%.6f" % (row[0] - start)] + ["%.9g" % value for value in row[1:]])


def plot(path, topic, wrench, reports, start, running):
    times = np.array([t for t, _ in reports]) - start
    force = wrench[:, 1:4]
    size = np.linalg.norm(force, axis=1)
    contacts, depth = column(reports, "contacts"), column(reports, "max_penetration")
    cycle = column(reports, "cycle_ms")

    plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
                         "axes.grid": True, "grid.alpha": 0.3, "axes.axisbelow": True})
    figure = plt.figure(figsize=(11, 8), constrained_layout=True)
    grid = figure.add_gridspec(3, 2, height_ratios=[2.2, 1.2, 1.3])
    top = figure.add_subplot(grid[0, :])
    middle = figure.add_subplot(grid[1, :], sharex=top)
    left, right = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])

    spans = phases(times, contacts > 0)
    for axis in (top, middle):
        for k, (a, b) in enumerate(spans):
            axis.axvspan(a, b, color="#f2d9b8", alpha=0.6, lw=0, label="contact" if k == 0 else None)
    t = wrench[:, 0] - start
    top.plot(t, size, color="black", lw=1.8, label="|F|")
    for k, (name, color) in enumerate(zip("xyz", (RED, GREEN, BLUE))):
        top.plot(t, force[:, k], color=color, lw=1.0, label="F" + name)
    peak = int(np.argmax(size))
    top.annotate("%.2f N" % size[peak], (t[peak], size[peak]), xytext=(0, 6),
                 textcoords="offset points", ha="center", weight="bold")
    top.margins(y=0.12)
    top.set_xlim(times[0], times[-1])
    top.set_ylabel("force of the tissue on the tool [N]")
    top.legend(loc="upper left", ncol=5, framealpha=0.9)
    top.set_title("%s, expressed in world" % topic, loc="left", fontsize=10, color=GREY)
    plt.setp(top.get_xticklabels(), visible=False)

    middle.step(times, 1e3 * depth, color=BLUE, lw=1.2, where="post")
    middle.set_ylabel("deepest sample\nin the tool [mm]")
    middle.set_xlabel("time [s]")
    middle.set_ylim(bottom=0)
    count = middle.twinx()
    count.step(times, contacts, color=RED, lw=0.9, where="post")
    count.set_ylabel("contacts", color=RED)
    count.set_ylim(bottom=0)
    count.grid(False)
    count.spines["right"].set_visible(True)

    cycle = cycle[running]
    limit = max(np.percentile(cycle, 99.5) * 1.15, 1e-3)
    left.hist(np.minimum(cycle, limit), bins=60, range=(0, limit), color=BLUE)
    for q, style in ((50, "-"), (99, "--")):
        value = np.percentile(cycle, q)
        left.axvline(value, color=RED, ls=style, lw=1.2, label="p%d = %.2f ms" % (q, value))
    left.set_xlim(0, limit)
    left.set_xlabel("cycle time [ms]\n(longer ones in the last bar)")
    left.set_ylabel("cycles")
    left.legend(framealpha=0.9)

    gaps = 1e3 * np.diff(wrench[:, 0])
    limit = max(3.0, 1.5 * np.percentile(gaps, 99))
    right.hist(np.minimum(gaps, limit), bins=60, range=(0, limit), color=GREEN)
    right.set_xlim(0, limit)
    right.set_yscale("log")
    right.set_xlabel("time between two wrenches, as recorded [ms]\n(longer ones in the last bar)")
    right.set_ylabel("messages")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("bag")
    parser.add_argument("--csv", required=True)
    parser.add_argument("--plot", required=True)
    arguments = parser.parse_args()

    topic, wrench, reports = read(arguments.bag)
    # From the first input that was simulated to the last one.
    running = np.array([message.state == "RUNNING" for _, message in reports])
    if not running.any():
        sys.exit("%s: the simulation never ran; its last state is %s" %
                 (arguments.bag, reports[-1][1].state))
    span = [reports[i][0] for i in np.flatnonzero(running)[[0, -1]]]
    reports = [r for r in reports if span[0] <= r[0] <= span[1] + 0.5]
    wrench = wrench[(wrench[:, 0] >= span[0]) & (wrench[:, 0] <= span[1] + 0.5)]
    running = np.array([message.state == "RUNNING" for _, message in reports])
    if len(wrench) < 2:
        sys.exit("%s: no wrench was recorded while the simulation ran" % arguments.bag)
    if not np.isfinite(wrench).all():
        sys.exit("%s: a wrench is not finite" % arguments.bag)
    write_csv(arguments.csv, wrench, span[0])
    plot(arguments.plot, topic, wrench, reports, span[0], running)

    size = np.linalg.norm(wrench[:, 1:4], axis=1)
    cycle = column(reports, "cycle_ms")[running]
    contacts, depth = column(reports, "contacts"), column(reports, "max_penetration")
    failed = sum(message.status != "converged" for _, message in reports)
    rate = (len(wrench) - 1) / (wrench[-1, 0] - wrench[0, 0])
    skips = ", ".join(
        "%s %d" % (name[len(SKIP):].replace("_", " "), column(reports, name).sum())
        for name in reports[0][1].__slots__ if name.startswith(SKIP))
    rows = [
        ("peak force", "%.3f N" % size.max()),
        ("the mesh's error, estimated", "%.3f N at most" % column(reports, "mesh_error").max()),
        ("contacts, most at once", "%d" % contacts.max()),
        ("contact phases", "%d" % len(phases([t for t, _ in reports], contacts > 0))),
        ("deepest sample in the tool", "%.3f mm" % (1e3 * depth.max())),
        ("cycle time p50 / p99 / max", "%.2f / %.2f / %.2f ms" %
         (np.percentile(cycle, 50), np.percentile(cycle, 99), cycle.max())),
        ("cycles, of which not converged", "%d, %d" % (len(cycle), failed)),
        ("simulation rate", "%.1f Hz" % ((running.sum() - 1) / (span[1] - span[0]))),
        ("force loop rate", "%.0f Hz" % rate),
        ("work skipped", skips),
    ]
    width = max(len(name) for name, _ in rows)
    for name, value in rows:
        print("  %-*s  %s" % (width, name, value))
    simulated = column(reports, "step")[running].sum() / (span[1] - span[0])
    if simulated < REAL_TIME:
        print("WARNING: %.0f %% of real time was simulated: tools went as much faster through the tissue than the arm"
              " did,\n  and forces may be too large. palpate_replay_bag gives those of the same joints on any machine."
              % (100.0 * simulated))


if __name__ == "__main__":
    main()
