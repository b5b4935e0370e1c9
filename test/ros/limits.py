# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand may be sent, whatever happens."""
import math

from helpers import numbers

LONGEST_TICK = 0.01  # [s] a tick of the force loop that comes later counts as so long, see WrenchFilter


class Limits:
    """Largest force and torque [N], [N m], and how fast a force may change [N/s]."""

    def __init__(self, force, torque, force_rate):
        self.largest, self.rates = (force, torque), (force_rate, force_rate * torque / force)

    def parameters(self, section="haptics/"):
        """Of the node; with section "" of a guard."""
        values = self.largest + self.rates[:1]
        return ["_%s%s:=%g" % ((section,) + p)
                for p in zip(["max_force", "max_torque", "max_force_rate"], values)]

    def check(self, test, messages):
        """All within; from one to the next no more than the ticks between them allow, which their numbers tell."""
        test.assertGreater(len(messages), 10)
        before = None
        for m in messages:
            now = numbers(m)
            test.assertTrue(all(math.isfinite(x) for x in now), m)
            parts = now[:3], now[3:]
            for part, largest in zip(parts, self.largest):
                test.assertLessEqual(math.hypot(*part), largest * (1 + 1e-9))
            if before:
                ticks = m.header.seq - before[0]
                test.assertGreater(ticks, 0)
                for part, last, rate in zip(parts, before[1], self.rates):
                    test.assertLessEqual(math.dist(part, last), rate * LONGEST_TICK * ticks * (1 + 1e-9),
                                         "%d ticks apart" % ticks)
            before = m.header.seq, parts
