# SPDX-License-Identifier: GPL-3.0-or-later
"""hsr.h, as cffi reads it: its declarations, without the preprocessor's lines.

The header is the only place where functions and structs are declared. It lies in
this folder if the package is installed, and in bench/library in hsr's own tree.
"""

import re
from pathlib import Path


def find() -> Path:
    """Where hsr.h is."""
    here = Path(__file__).resolve().parent
    places = [here / "hsr.h", here.parent.parent / "library" / "hsr.h"]
    for place in places:
        if place.is_file():
            return place
    raise ImportError(f"hsr: {places[0]} is missing")


def declarations(text: str) -> str:
    """The declarations of a header, with those of its constants that are whole
    numbers."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.S)
    text = re.sub(r"\bHSR_API\b", "", text)
    lines = [_line(line) for line in text.splitlines()]
    return "\n".join(line for line in lines if line.strip())


def _line(line: str) -> str:
    """A line, or nothing if it is the preprocessor's and no whole number."""
    if not line.startswith("#"):
        return line
    line = line.replace("UINT32_MAX", str(2**32 - 1))
    return line if re.fullmatch(r"#define \w+\s+\d+\s*", line) else ""
