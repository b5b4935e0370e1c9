#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/checks/soak.sh runs, in its environment."""
import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
import xmlrpc.client

import numpy as np
import roslib.packages
import rospy
from diagnostic_msgs.msg import DiagnosticArray

NODE, GUARD = "palpate", "guard"


class Graph:
    """A master, the node and its guard, hands one after the other, a subscriber of the pictures and one of the wrench."""

    def __init__(self, options):
        self.options, self.all, self.hands, self.hand = options, [], 0, None
        self.said = {}
        self.uri = os.environ["ROS_MASTER_URI"]
        self.master = xmlrpc.client.ServerProxy(self.uri)
        os.makedirs(options.out, exist_ok=True)

    def begin(self):
        self.start("master", "roscore", "-p", self.uri.rstrip("/").split(":")[-1])
        self.wait(lambda: self.master.getPid("/soak")[0] == 1, 30)
        rospy.init_node("soak", disable_signals=True, log_level=rospy.WARN)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.hear)
        self.watched = {
            NODE: self.program(NODE, "palpate_node", "_scene:=" + self.options.scene, "_save_state_at_end:=false"),
            GUARD: self.program(GUARD, "palpate_guard", "_input:=probe/body/measured_cf", "_output:=device/servo_cf")}
        self.wait(lambda: self.master.lookupService("/soak", "/%s/reset" % NODE)[0] == 1, 600)
        self.start("pictures", "rostopic", "bw", "/organs")
        self.wire = self.program("wire", "palpate_wire", "_seconds:=%g" % (60.0 * self.options.minutes - 3.0))

    def program(self, name, file, *parameters, log=None):
        return self.start(log or name, roslib.packages.find_node("palpate", file)[0], "__name:=" + name, *parameters)

    def start(self, log, *command):
        with open(os.path.join(self.options.out, log + ".log"), "w") as f:
            self.all.append(subprocess.Popen(command, stdout=f, stderr=subprocess.STDOUT))
        return self.all[-1]

    def wait(self, condition, seconds):
        end = time.monotonic() + seconds
        while True:
            try:
                if condition():
                    return
            except OSError:
                pass
            if time.monotonic() > end:
                sys.exit("soak.py: the graph did not come up; see " + self.options.out)
            time.sleep(0.1)

    def next_hand(self):
        if self.hand and self.hand.poll() is None:
            return
        if self.hand:
            self.all.remove(self.hand)
        self.hands += 1
        name = "hand_%d" % self.hands
        rospy.set_param("/" + name, {"start": self.options.start, "way": self.options.way, "hold": 4.0,
                                     "tremor": 0.002, "after": ""})
        self.hand = self.program(name, "palpate_device", log="hand")
        if self.hands > 1:
            rospy.delete_param("/hand_%d" % (self.hands - 1))

    def memory(self):
        """What is resident of each program that is watched [MB]; they must be there."""
        sizes = []
        for name, program in self.watched.items():
            if program.poll() is not None:
                sys.exit("soak.py: %s ended; see %s/%s.log" % (name, self.options.out, name))
            with open("/proc/%d/statm" % program.pid) as f:
                sizes.append(int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6)
        return sizes

    def hear(self, message):
        for status in message.status:
            if status.name.startswith(NODE + ": "):
                self.said.update({v.key: v.value for v in status.values})

    def end(self):
        for p in reversed(self.all):
            if p.poll() is None:
                p.send_signal(signal.SIGINT)
                try:
                    p.wait(15)
                except subprocess.TimeoutExpired:
                    p.kill()


def growth(times, sizes):
    """[MB/min] over the last three quarters, by least squares."""
    last = times >= 0.25 * times[-1]
    return float(60.0 * np.polyfit(times[last], sizes[last], 1)[0])


def figures(options, graph, times, sizes):
    with open(os.path.join(options.out, "wire.log")) as f:
        period = re.search(r"(\d+) wrenches(.*): period p50 (\S+) p99 (\S+) p99.9 (\S+) max (\S+) ms", f.read())
    table = {"minutes": options.minutes}
    for k, name in enumerate(graph.watched):
        of, own = " of " + name, sizes[:, k]
        table["memory%s at the start [MB]" % of] = own[0]
        table["memory%s after a minute [MB]" % of] = float(np.interp(60.0, times, own))
        table["memory%s at the end [MB]" % of] = own[-1]
        table["largest memory%s [MB]" % of] = max(own)
        table["growth%s over the last three quarters [MB/min]" % of] = growth(times, own)
    table.update({
        "hands": graph.hands,
        "cycles": int(graph.said["cycles"]),
        "cycles not solved": int(graph.said["cycles not solved"]),
        "cycle p50 of the last second [ms]": float(graph.said["cycle p50 [ms]"]),
        "peak force [N]": float(graph.said["peak force [N]"]),
        "wrenches": int(period.group(1)) if period else 0,
        "period of the wrench p50, p99, p99.9, max [ms]": [float(x) for x in period.groups()[2:]] if period else None,
        "heard in real time": bool(period) and not period.group(2),
    })
    return table


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--scene", default="liver_palpation")
    parser.add_argument("--start", type=lambda s: [float(x) for x in s.split(",")],
                        default=[-0.04, -0.025, -0.14, 0.0, 0.0, 0.0])
    parser.add_argument("--way", type=float, default=0.015)
    parser.add_argument("--bound", type=float, default=1.0)
    parser.add_argument("--out", default="build/soak")
    options = parser.parse_args()
    if not options.minutes >= 0.5:
        parser.error("--minutes must be at least 0.5")

    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    graph, times, sizes = Graph(options), [], []
    try:
        graph.begin()
        begin = time.monotonic()
        while time.monotonic() < begin + 60.0 * options.minutes:
            graph.next_hand()
            sizes.append(graph.memory())
            times.append(time.monotonic() - begin)
            time.sleep(0.5)
        graph.wire.wait(30)
        table = figures(options, graph, np.array(times), np.array(sizes))
    finally:
        graph.end()
    with open(os.path.join(options.out, "samples.csv"), "w") as f:
        f.write("t,%s\n" % ",".join(graph.watched))
        f.writelines("%.2f,%s\n" % (t, ",".join("%.3f" % x for x in row)) for t, row in zip(times, sizes))
    with open(os.path.join(options.out, "figures.json"), "w") as f:
        json.dump(table, f, indent=1)
    for name, value in table.items():
        print("%-62s %s" % (name, "%.3f" % value if isinstance(value, float) else value))
    if not (table["cycles"] > 0 and table["peak force [N]"] > 0.0 and table["wrenches"] > 0):
        sys.exit("soak.py: nothing was pressed, or no wrench was heard; see " + options.out)
    for name in graph.watched:
        if table["growth of %s over the last three quarters [MB/min]" % name] > options.bound:
            sys.exit("soak.py: memory of %s grows faster than %g MB/min" % (name, options.bound))


if __name__ == "__main__":
    main()
