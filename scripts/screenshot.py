#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Saves a picture of the screen at the moment of the largest contact force.

    scripts/screenshot.py FILE

Looks at the screen (of DISPLAY) whenever the force has grown, until it is stopped: the last picture
is the one that stays. The force comes from the first topic that ends in spatial/measured_cf.
"""
import os
import signal
import subprocess
import sys
import time

import rospy
from geometry_msgs.msg import WrenchStamped


class Photographer:
    """Remembers how large the force was in the last picture."""

    def __init__(self, path):
        self.path = path
        self.force = 0.0
        self.best = 0.3  # [N], less is not worth a picture

    def receive(self, message):
        f = message.wrench.force
        self.force = (f.x**2 + f.y**2 + f.z**2) ** 0.5

    def look(self):
        force = self.force
        if force < 1.01 * self.best:
            return
        new = self.path + ".new.png"
        subprocess.run(["import", "-window", "root", new], check=True)
        os.replace(new, self.path)
        self.best = force
        print("screenshot.py: %s at %.2f N" % (self.path, force), flush=True)


def find_topic():
    while not rospy.is_shutdown():
        for name, kind in rospy.get_published_topics():
            if kind == "geometry_msgs/WrenchStamped" and name.endswith("spatial/measured_cf"):
                return name
        time.sleep(0.2)
    sys.exit("screenshot.py: no wrench was published")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rospy.init_node("screenshot", anonymous=True, disable_signals=False)
    photographer = Photographer(os.path.abspath(sys.argv[1]))
    rospy.Subscriber(find_topic(), WrenchStamped, photographer.receive, queue_size=1, tcp_nodelay=True)
    while not rospy.is_shutdown():
        photographer.look()
        time.sleep(0.1)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        main()
    except KeyboardInterrupt:
        pass
