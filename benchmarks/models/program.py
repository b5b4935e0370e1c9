# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs palpate_models, which computes the figures of networks of springs."""

import json
import os
import subprocess

from accuracy.solve import Failed, build_folder


def place():
    """The built program; PALPATE_MODELS names another one."""
    if "PALPATE_MODELS" in os.environ:
        return os.environ["PALPATE_MODELS"]
    for folder in ("devel/lib/palpate", "benchmarks/models"):  # with catkin, without
        file = build_folder() / folder / "palpate_models"
        if file.is_file():
            return str(file)
    raise Failed(f"palpate_models is not built in {build_folder()}: run scripts/build.sh palpate_models")


def figures(context, part):
    """What the program says of a part (parts.h). @throws Failed"""
    done = subprocess.run([place(), part, *(["--quick"] if context.quick else [])], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise Failed(done.stderr.strip() or f"palpate_models {part}: status {done.returncode}")
    (context.work / f"{part}.json").write_text(done.stdout, encoding="utf-8")
    return json.loads(done.stdout)
