#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""rosrun finds palpate's programs and scripts in the environment of scripts/env.sh, and in that of devel/setup.bash."""
import os
import shutil
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAMS = ["palpate_node", "palpate_guard", "palpate_device", "palpate_replay_bag", "palpate_when_ready", "palpate_wire",
            "analyse_bag.py"]


class Rosrun(unittest.TestCase):
    def found_after(self, command):
        # Not in the environment of the build, which names the devel space by its other name.
        clean = {name: os.environ[name] for name in ("HOME", "TMPDIR") if name in os.environ}
        script = "%s; for p in %s; do rosrun palpate $p --help </dev/null || exit 1; done; echo $CMAKE_PREFIX_PATH"
        done = subprocess.run(["bash", "-c", script % (command, " ".join(PROGRAMS))], cwd=ROOT, timeout=300,
                              env={**clean, "PATH": "/usr/bin:/bin"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        for program in PROGRAMS:
            self.assertRegex(done.stdout, r"(?i)usage: (\S*/)?" + program)
        self.assertEqual(done.stdout.splitlines()[-1], os.path.join(ROOT, "devel"))

    def test_after_env_sh(self):
        self.found_after(". scripts/env.sh")

    def test_after_setup_bash(self):
        self.found_after(". devel/setup.bash")


if __name__ == "__main__":
    if shutil.which("rosrun") is None:
        print("rosrun is not installed (rosbash)")
        sys.exit(77)
    unittest.main()
