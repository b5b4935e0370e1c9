#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what docs/adding_a_model.md says, in a copy of the table of models.

usage: apply_page.py PAGE MODEL_LIST_CPP FOLDER

The page's C++ blocks are the header, the source, the line that includes the header, and the entry in
the table.
"""
import pathlib
import re
import sys


def main(page, model_list, folder):
    blocks = re.findall(r"^```cpp\n(.*?)^```$", pathlib.Path(page).read_text(), re.M | re.S)
    if len(blocks) != 4:
        sys.exit(f"{page}: has {len(blocks)} C++ blocks; a header, a source, an include and an entry "
                 "are wanted")
    header, source, include, entry = blocks
    path = re.fullmatch(r'#include "((\w+)/\w+)\.h"\n', include)
    if not path or not re.fullmatch(r'\{"\w+", \w+, (true|false)\},\n', entry):
        sys.exit(f"{page}: no include and entry: {include!r}, {entry!r}")

    text = pathlib.Path(model_list).read_text()
    for mark, addition in [('#include "fem/make_fem.h"\n', include),
                           ('{"fem", makeFem, true},', "\n" + entry)]:
        if mark not in text:
            sys.exit(f"{model_list}: has no {mark!r}")
        at = text.index(mark) + len(mark)
        text = text[:at] + addition + text[at:]

    folder = pathlib.Path(folder)
    (folder / path.group(2)).mkdir(parents=True, exist_ok=True)
    (folder / (path.group(1) + ".h")).write_text(header)
    (folder / (path.group(1) + ".cpp")).write_text(source)
    (folder / "model_list.cpp").write_text(text)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
