#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a configuration in rviz, with all its displays, and prints what each says of itself.

    rviz_statuses.py CONFIG [--seconds S] [--picture FILE]

Ends when every display has been well for a second, or after S seconds (20), with a line of JSON:
{"display": ["Ok", "what it says", ...], ...}. Needs python3-rviz and a screen (Xvfb).
"""
import argparse
import json
import sys
import time

from python_qt_binding.QtWidgets import QApplication
from rviz import bindings as rviz


def status_of(display):
    """["Ok" | "Warn" | "Error", "name: text" of each part that is not well]."""
    if not display.isEnabled():
        return ["Disabled"]
    lists = [display.childAt(i) for i in range(display.numChildren())]
    lists = [p for p in lists if p.getName().startswith("Status")]
    if not lists:
        return ["Ok"]
    parts = [lists[0].childAt(i) for i in range(lists[0].numChildren())]
    return [lists[0].getName().split(": ")[-1]] + ["%s: %s" % (p.getName(), p.getValue()) for p in parts]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("config")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--picture", help="of the window, at the end")
    options = parser.parse_args()

    app = QApplication(sys.argv[:1])
    frame = rviz.VisualizationFrame()
    frame.setSplashPath("")
    frame.initialize()
    config = rviz.Config()
    rviz.YamlConfigReader().readFile(config, options.config)
    frame.load(config)
    frame.show()
    group = frame.getManager().getRootDisplayGroup()
    displays = [group.getDisplayAt(i) for i in range(group.numDisplays())]
    for display in displays:
        display.setEnabled(True)

    def spin(until):
        while time.monotonic() < until:
            app.processEvents()
            time.sleep(0.01)

    end = time.monotonic() + options.seconds
    well_since = None
    while time.monotonic() < end and not (well_since and time.monotonic() - well_since > 1.0):
        spin(time.monotonic() + 0.1)
        well = all(status_of(d)[0] == "Ok" for d in displays)
        well_since = (well_since or time.monotonic()) if well else None
    print(json.dumps({d.getName(): status_of(d) for d in displays}), flush=True)
    if options.picture:
        app.primaryScreen().grabWindow(frame.winId()).save(options.picture)
    sys.stdout.flush()
    import os
    os._exit(0)


if __name__ == "__main__":
    main()
