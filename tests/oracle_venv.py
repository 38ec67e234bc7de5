"""oracle_venv -- how a test finds the programs of others that PyPI has.

`tools/deps oracles` installs what tests/oracles.txt pins into a virtual
environment: out/oracles, or $OSDTEX_ORACLES. A test asks for the Python of it
by the modules that it wants:

    python, reason = oracle_python("pxr", "MaterialX")
    if reason:
        self.skipTest(reason)           # a script prints it and ends with 77
    subprocess.run([python, "judge_usd.py", path])

A script that is all judgement begins with run_in_venv("pxr") instead: the rest
of it runs in the environment, or the test is skipped.
"""

import functools
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def venv():
    return Path(os.environ.get("OSDTEX_ORACLES") or ROOT / "out" / "oracles")


@functools.cache
def oracle_python(*modules):
    """The environment's Python and None, or None and why there is none that
    has these modules."""
    python = venv() / "bin" / "python"
    if not python.exists():
        return None, f"no {', '.join(modules)} (tools/deps oracles)"
    for module in modules:
        # bpy may end in a crash where a library of a desktop is missing.
        done = subprocess.run(
            [python, "-c", f"import {module}"], capture_output=True)
        if done.returncode != 0:
            return None, f"no {module} (tools/deps oracles)"
    return str(python), None


def run_in_venv(*modules):
    """Goes on as a script of the environment, or ends as skipped (77)."""
    python, reason = oracle_python(*modules)
    if reason:
        print(f"skipped: {reason}")
        sys.exit(77)
    # The link to the interpreter says which environment it is, not its target.
    if Path(sys.prefix) != venv().resolve():
        os.execv(python, [python, *sys.argv])
