"""osdtex_job -- runs the program osdtex beside an application: how far it is,
what it says, and stopping it.

    job = osdtex_job.start(["bake", "cage.obj", "bark.png", "-o", "a.obj"])
    while job.poll():
        print(job.stage, job.percent)
    job.check()                      # raises Failed with the program's sentence

Needs nothing but Python 3.7, so that Blender, Houdini and Maya share it.
"""

import os
import re
import shutil
import signal
import subprocess
import threading

PROGRESS = re.compile(r"osdtex: (.+) (\d+)%$")


class Failed(Exception):
    """The program's own sentence."""


def find_program(given=""):
    """`given`, else $OSDTEX, else the one on the path."""
    for name in (given, os.environ.get("OSDTEX"), "osdtex"):
        path = shutil.which(os.path.expanduser(name)) if name else None
        if path:
            return path
        if name and name == given:
            raise Failed(f"there is no program '{given}'")
    raise Failed(
        "osdtex is not on the path; install it, or say where it is in the "
        "preferences or in $OSDTEX")


class Job:
    """A run of the program. `stage` and `percent` are what it said last."""

    def __init__(self, words, program=""):
        self.words = [find_program(program)] + [str(w) for w in words]
        self.stage, self.percent, self.lines = "starting", 0, []
        self.is_cancelled = False
        # The host's Python is not that of programs it starts.
        clean = {k: v for k, v in os.environ.items()
                 if k not in ("PYTHONHOME", "PYTHONPATH", "LD_PRELOAD")}
        self.process = subprocess.Popen(
            self.words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL, universal_newlines=True, env=clean,
            errors="replace")
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stderr:
            said = PROGRESS.match(line.rstrip())
            if said:
                self.stage, self.percent = said.group(1), int(said.group(2))
            else:
                self.lines.append(line.rstrip())

    def poll(self):
        """Whether it still runs."""
        return self.process.poll() is None

    def cancel(self):
        """Asks it to stop; it leaves nothing half-written."""
        self.is_cancelled = True
        if self.poll():
            self.process.send_signal(signal.SIGINT)

    def wait(self):
        self.process.wait()
        self.reader.join(10)
        self.process.stderr.close()
        return self.process.returncode

    def warnings(self):
        return [line[len("osdtex: warning: "):] for line in self.lines
                if line.startswith("osdtex: warning: ")]

    def check(self):
        """Waits for the end; raises Failed where it did not go well."""
        code = self.wait()
        if code == 0:
            return
        errors = [line for line in self.lines if "error: " in line]
        said = errors[-1].split("error: ", 1)[1] if errors else (
            self.lines[-1] if self.lines else f"it ended with status {code}")
        raise Failed("stopped" if self.is_cancelled else said)


def start(words, program=""):
    return Job(words, program)


def bake_words(cage, output, exemplar, **settings):
    """The command line of a bake. An exemplar that is a folder is a material:
    its maps are found by their names.

    settings  flags by name, dashes as underscores; None, "" and False are left
              out, True is a switch
    """
    words = ["bake", cage]
    if os.path.isdir(exemplar):
        words += ["--material", exemplar]
    else:
        words += [exemplar]
    words += ["-o", output]
    for name, value in settings.items():
        if value is None or value is False or value == "":
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(repr(value) if isinstance(value, float) else str(value))
    return words
