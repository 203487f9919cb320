# SPDX-License-Identifier: GPL-3.0-or-later
"""Test Anything Protocol, for the tests in Python."""

import traceback

_n = 0


def ok(holds, what):
    """An assertion."""
    global _n
    _n += 1
    print(f"{'ok' if holds else 'not ok'} {_n} - {what}", flush=True)


def raises(error, line, function, *arguments, **more):
    """Whether a call raises this class, with one line that has these words."""
    try:
        function(*arguments, **more)
    except error as found:
        text = str(found)
        holds = type(found) is error and line in text and "\n" not in text
        ok(holds, f"{error.__name__}: {text!r}")
    except Exception as found:
        ok(False, f"{error.__name__} is wanted, not {found!r}")
    else:
        ok(False, f"{error.__name__} is wanted for: {line}")


def run(cases):
    """Calls all functions test_... of a module."""
    for name, case in list(cases.items()):
        if name.startswith("test_"):
            try:
                case()
            except Exception:
                for line in traceback.format_exc().splitlines():
                    print("#", line)
                ok(False, f"{name} ends")
