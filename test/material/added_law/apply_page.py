#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what docs/adding_a_law.md says, in a folder that is laid over include/.

usage: apply_page.py PAGE LAW_LIST_H OVERLAY

The page's C++ blocks are the header, the line that includes it, and the entry in the list.
"""
import pathlib
import re
import sys


def main(page, law_list_h, overlay):
    blocks = re.findall(r"^```cpp\n(.*?)^```$", pathlib.Path(page).read_text(), re.M | re.S)
    if len(blocks) != 3:
        sys.exit(f"{page}: has {len(blocks)} C++ blocks; a header, an include and an entry are wanted")
    header, include, entry = blocks
    path = re.fullmatch(r'#include "(palpate/material/\w+\.h)"\n', include)
    if not path or not re.fullmatch(r"\w+,\n", entry):
        sys.exit(f"{page}: no include and entry: {include!r}, {entry!r}")

    text = pathlib.Path(law_list_h).read_text()
    for mark, addition in [('#include "palpate/material/', include), ("std::variant<", entry)]:
        if mark not in text:
            sys.exit(f"{law_list_h}: has no {mark}")
        at = text.index(mark)
        if mark.startswith("std"):
            at = text.index(mark, text.index("using LawList")) + len(mark)
        text = text[:at] + addition + text[at:]

    room = pathlib.Path(overlay) / "palpate" / "material"
    room.mkdir(parents=True, exist_ok=True)
    (pathlib.Path(overlay) / path.group(1)).write_text(header)
    (room / "law_list.h").write_text(text)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
