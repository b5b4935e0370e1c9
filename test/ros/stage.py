# SPDX-License-Identifier: GPL-3.0-or-later
"""Hands for every instrument of a scene file, and a screen that nobody sees."""
import os
import subprocess
import tempfile
import threading
import time
import xml.etree.ElementTree as ElementTree

import rospy
import tf2_msgs.msg
import yaml
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import JointState


class Screen:
    """An X server without a monitor; `environment` leads programs to it."""

    def __init__(self, size="1280x800x24"):
        with tempfile.TemporaryFile("w+") as number:
            self.server = subprocess.Popen(
                ["Xvfb", "-displayfd", str(number.fileno()), "-screen", "0", size, "-nolisten", "tcp"],
                pass_fds=[number.fileno()], stderr=subprocess.DEVNULL)
            end = time.monotonic() + 20.0
            text = ""
            while not text.endswith("\n") and time.monotonic() < end:
                time.sleep(0.05)
                number.seek(0)
                text = number.read()
        if not text:
            self.close()
            raise RuntimeError("Xvfb did not start")
        self.environment = dict(os.environ, DISPLAY=":" + text.strip(), LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
        for name in ("XAUTHORITY", "WAYLAND_DISPLAY"):
            self.environment.pop(name, None)

    def close(self):
        self.server.terminate()
        self.server.wait(10)


class Tool:
    """One instrument of a scene: its input, as a message."""

    def __init__(self, config, folder):
        self.name, self.input = config["name"], config.get("input", "joints")
        self.topic = config.get("joint_topic") or self.name + "/measured_js"
        self.prefix = config.get("tf_prefix", "")
        robot = ElementTree.parse(os.path.join(folder, config["urdf"])).getroot()
        self.joints = [j.get("name") for j in robot.iter("joint")
                       if j.get("type") != "fixed" and j.find("mimic") is None]
        self.links = [l.get("name") for l in robot.iter("link")
                      if l.find("collision") is not None or l.get("name") == config["control_frame"]]

    def state(self, positions):
        """`positions`: by joint; those that are not there are zero."""
        m = JointState()
        m.header.stamp = rospy.Time.now()
        m.name, m.position = self.joints, [positions.get(j, 0.0) for j in self.joints]
        return m

    def frames(self, height):
        """All links at (0, 0, height) in world."""
        m = tf2_msgs.msg.TFMessage()
        for link in self.links:
            t = TransformStamped()
            t.header.stamp, t.header.frame_id = rospy.Time.now(), "world"
            t.child_frame_id, t.transform.translation.z, t.transform.rotation.w = self.prefix + link, height, 1.0
            m.transforms.append(t)
        return m


class Hands:
    """Holds all instruments of a scene, at 100 Hz: joints at zero, tracked tools 0.3 m above the origin."""

    def __init__(self, scene, namespace=""):
        with open(scene, encoding="utf-8") as file:
            tools = [Tool(c, os.path.dirname(scene)) for c in yaml.safe_load(file)["instruments"]]
        self.messages = []  # (publisher, how its next message is made)
        for tool in tools:
            if tool.input == "tf":
                topic, kind, make = "/tf", tf2_msgs.msg.TFMessage, lambda t=tool: t.frames(0.3)
            else:
                topic, kind, make = os.path.join("/", namespace, tool.topic), JointState, lambda t=tool: t.state({})
            self.messages.append((rospy.Publisher(topic, kind, queue_size=1, tcp_nodelay=True), make))
        self.stopping = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        while not self.stopping.wait(0.01):
            for publisher, make in self.messages:
                publisher.publish(make())

    def stop(self):
        self.stopping.set()
        self.thread.join()
        for publisher, _ in self.messages:
            publisher.unregister()
