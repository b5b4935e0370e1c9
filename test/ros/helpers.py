# SPDX-License-Identifier: GPL-3.0-or-later
"""What the node's tests share: a hand that moves the probe, ears for what the node says."""
import io
import math
import subprocess
import threading
import time

import roslib.packages
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TransformStamped, WrenchStamped
from palpate.msg import StepReport
from sensor_msgs.msg import JointState

JOINTS = ["x", "y", "z", "roll", "pitch", "yaw"]
# Heights of the ball's centre over the base's frame [m], see scenes/block.yaml: the block's top is
# at 0.03, the base at 0.1, the ball has a radius of 0.005.
ABOVE = -0.05
TOUCHING = -0.068


class Ear:
    """Keeps all messages of a topic with the time of arrival."""

    def __init__(self, topic, kind):
        self.lock = threading.Lock()
        self.heard = []
        self.subscriber = rospy.Subscriber(topic, kind, self._hear, queue_size=1000, tcp_nodelay=True)

    def _hear(self, message):
        with self.lock:
            self.heard.append((time.monotonic(), message))

    def all(self):
        with self.lock:
            return [m for _, m in self.heard]

    def timed(self):
        with self.lock:
            return list(self.heard)

    def last(self):
        with self.lock:
            return self.heard[-1][1] if self.heard else None

    def clear(self):
        with self.lock:
            self.heard = []

    def wait(self, condition, timeout=10.0):
        """The first message (heard or to come) for which the condition holds, or None."""
        end = time.monotonic() + timeout
        seen = 0
        while time.monotonic() < end:
            messages = self.all()
            for m in messages[seen:]:
                if condition(m):
                    return m
            seen = len(messages)
            time.sleep(0.01)
        return None


def joint_state(z, stamp=None, names=None, positions=None):
    m = JointState()
    m.header.stamp = rospy.Time.now() if stamp is None else stamp
    m.name = list(JOINTS) if names is None else names
    m.position = [0.0, 0.0, z, 0.0, 0.6, 0.0] if positions is None else positions
    return m


def transform(parent, child, z, stamp=None):
    """Turned as joint_state() turns the probe."""
    t = TransformStamped()
    t.header.stamp = rospy.Time.now() if stamp is None else stamp
    t.header.frame_id, t.child_frame_id = parent, child
    t.transform.translation.z = z
    t.transform.rotation.y, t.transform.rotation.w = math.sin(0.3), math.cos(0.3)
    return t


class Hand:
    """Publishes a message a hundred times a second while it holds one."""

    def __init__(self, topic="probe/measured_js"):
        self.publisher = rospy.Publisher(topic, JointState, queue_size=1, tcp_nodelay=True)
        self.make = None
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        due = time.monotonic()
        while not rospy.is_shutdown():
            make = self.make
            if make:
                self.publisher.publish(make())
            # By the clock, as an arm is: sleeps are longer than asked, by as much as the machine likes.
            due = max(due + 0.01, time.monotonic() - 0.01)
            time.sleep(max(0.0, due - time.monotonic()))

    def hold(self, z):
        self.make = lambda: joint_state(z)

    def send(self, make):
        self.make = make

    def stop(self):
        self.make = None


def force(m):
    f = m.wrench.force
    return math.sqrt(f.x * f.x + f.y * f.y + f.z * f.z)


def numbers(m):
    f, t = m.wrench.force, m.wrench.torque
    return [f.x, f.y, f.z, t.x, t.y, t.z]


def wrench_ear(kind="spatial"):
    return Ear("probe/%s/measured_cf" % kind, WrenchStamped)


def report_ear():
    return Ear("step_report", StepReport)


def diagnostics_ear():
    return Ear("/diagnostics", DiagnosticArray)


class Programs:
    """Programs that a test starts; whatever happens, none stays behind."""

    def __init__(self, env=None):
        self.env, self.all = env, []

    def start(self, *command, **options):
        self.all.append(subprocess.Popen(list(command), env=self.env, start_new_session=True, **options))
        return self.all[-1]

    def node(self, program, *arguments, **options):
        return self.start(roslib.packages.find_node("palpate", program)[0], *arguments, **options)

    def end(self):
        for p in self.all:
            if p.poll() is None:
                p.kill()
            p.wait(10)


def bytes_of(message):
    """A message as it is sent."""
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


def memory(pid):
    """What is resident of a process [bytes]."""
    with open("/proc/%d/statm" % pid) as f:
        return int(f.read().split()[1]) * 4096


def status(diagnostics, name):
    """The status `name` of a DiagnosticArray of the node under test, or None."""
    for s in diagnostics.status:
        if s.name.endswith(": " + name):
            return s
    return None
