#!/usr/bin/env python3
"""run_test -- runs one test, and keeps what it says it skipped.

    run_test.py FILE COMMAND...

Passes on what the command prints, line by line. What it skips it says in lines
"skipped: SENTENCE" (unittest: "... skipped 'SENTENCE'"); they go to FILE, and a
test that skipped anything ends with 77, which is not "Passed": cmocka and
unittest end with 0 however much they skip. A failed test stays failed.
"""

import re
import subprocess
import sys
from pathlib import Path

SENTENCE = re.compile(r"""^skipped: (.*)$|\.\.\. skipped ['"](.*)['"]$""")
# cmocka says each skipped case again in its summary.
CASE = re.compile(r"^\[  SKIPPED \] (\w+)$")


def sentence_of(line):
    found = SENTENCE.search(line)
    return found and (found[1] or found[2])


def run(command):
    """The exit status, the sentences, and how many cases were skipped."""
    sentences, cases = [], set()
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    for line in process.stdout:
        sys.stdout.buffer.write(line)
        sys.stdout.buffer.flush()
        line = line.decode(errors="replace").rstrip()
        if sentence_of(line):
            sentences.append(sentence_of(line))
        if CASE.match(line):
            cases.add(CASE.match(line)[1])
    return process.wait(), sentences, len(cases)


def main(path, *command):
    status, sentences, cases = run(command)
    if status == 77 and not sentences or cases > len(sentences):
        sentences.append("it does not say why")
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"{s}\n" for s in dict.fromkeys(sentences)))
    if status < 0:
        # ctest knows a crash by its signal's name only where it is ours.
        print(f"ended by signal {-status}")
        return 128 - status
    return 77 if status == 0 and sentences else status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
