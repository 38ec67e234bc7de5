"""oracles -- running osdtex and the programs that judge what it writes."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests"))

from oracle_venv import oracle_python, run_in_venv  # noqa: E402,F401


def run(*words, **options):
    words = [str(w) for w in words]
    done = subprocess.run(words, capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(
            f"{' '.join(words)}\nexit {done.returncode}\n{done.stdout}{done.stderr}"
        )
    return done.stdout


def need(*programs):
    """Ends the test as skipped (77) where a program is missing."""
    for program in programs:
        if not shutil.which(program):
            print(f"skipped: {program} is not installed (tools/deps medium)")
            sys.exit(77)


def difference(a, b):
    """Mean and largest absolute difference of two pictures, by idiff."""
    # It says them only where it fails.
    words = ["idiff", "-fail", "0", "-warn", "0", str(a), str(b)]
    text = subprocess.run(words, capture_output=True, text=True).stdout
    mean = re.search(r"Mean error = ([-0-9.e]+)", text)
    most = re.search(r"Max error\s+= ([-0-9.e]+)", text)
    return (
        float(mean.group(1)) if mean else 0.0,
        float(most.group(1)) if most else 0.0,
    )


def within_tolerance(a, b):
    """The thresholds of a lit render: 0.004 for all but 0.02 % of the pixels,
    and 0.012 for all of them."""
    words = ["idiff", "-fail", "0.004", "-failpercent", "0.02"]
    words += ["-hardfail", "0.012", "-warn", "1", str(a), str(b)]
    done = subprocess.run(words, capture_output=True, text=True)
    return done.returncode in (0, 1), done.stdout
