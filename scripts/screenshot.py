#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Saves a picture of the screen at the moment of the largest contact force.

    scripts/screenshot.py FILE

Looks at the screen (of DISPLAY) whenever the force has grown and rests, until it is stopped: the last
picture is the one that stays. The force is the sum of those on all topics that end in spatial/measured_cf.
"""
import collections
import os
import signal
import subprocess
import sys
import time

import rospy
from geometry_msgs.msg import WrenchStamped


class Photographer:
    """Takes a picture when the force is larger than in the last one and rests.

    It must rest because the screen lags behind the topic by a few frames.
    """

    REST = 0.3  # [s] for which the force must have been within 5 %, or 10 mN

    def __init__(self, path):
        self.path = path
        self.recent = collections.deque()  # (time received [s], force [N])
        self.best = 0.005  # [N], less is not worth a picture
        self.forces = {}  # by topic [N]

    def receive(self, message, topic):
        f = message.wrench.force
        self.forces[topic] = (f.x**2 + f.y**2 + f.z**2) ** 0.5
        now = time.monotonic()
        self.recent.append((now, sum(self.forces.values())))
        while self.recent[0][0] < now - self.REST:
            self.recent.popleft()

    def look(self):
        forces = [force for _, force in list(self.recent)]
        rests = len(forces) >= 10 and max(forces) - min(forces) <= max(0.05 * max(forces), 0.01)
        if not rests or forces[-1] < 1.02 * self.best:
            return
        new = self.path + ".new.png"
        subprocess.run(["import", "-window", "root", new], check=True)
        os.replace(new, self.path)
        self.best = forces[-1]
        print("screenshot.py: %s at %.3f N" % (self.path, self.best), flush=True)


def find_topics():
    while not rospy.is_shutdown():
        time.sleep(0.5)  # the node advertises them one after the other
        found = [name for name, kind in rospy.get_published_topics()
                 if kind == "geometry_msgs/WrenchStamped" and name.endswith("spatial/measured_cf")]
        if found:
            return found
    sys.exit("screenshot.py: no wrench was published")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rospy.init_node("screenshot", anonymous=True, disable_signals=False)
    photographer = Photographer(os.path.abspath(sys.argv[1]))
    for topic in find_topics():
        rospy.Subscriber(topic, WrenchStamped, photographer.receive, topic, queue_size=100, tcp_nodelay=True)
    while not rospy.is_shutdown():
        photographer.look()
        time.sleep(0.1)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        main()
    except KeyboardInterrupt:
        pass
