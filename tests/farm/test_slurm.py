#!/usr/bin/env python3
"""A real farm: Slurm on this machine, with munged, slurmctld and slurmd of
our own on the loopback. An array bakes the UDIM tiles of a cage; a task is
killed half-way and requeued; the bytes are those of one process."""

import os
import pwd
import shutil
import signal
import socket
import subprocess
import time
import unittest
from pathlib import Path

from jobs import PROGRAM, JobTest, main

TOOLS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue")
WHOLE = ("creased.obj gravel.png --level 2 --uvs atlas --resolution 256 "
         "--texels-per-unit 60 -o out/cage.obj")
CONFIGURATION = """
ClusterName=osdtex
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
KillWait=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def has_munge_user():
    try:
        return bool(pwd.getpwnam("munge"))
    except KeyError:
        return False


def free_ports():
    sockets = [socket.socket() for _ in range(2)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def wait_until(condition, seconds, what):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not after {seconds} s")
        time.sleep(0.05)


@unittest.skipUnless(
    all(map(shutil.which, TOOLS)) and os.getuid() == 0 and has_munge_user(),
    "needs root, slurm-wlm and munge")
def unmarked(text):
    """A text without the line that says what made it."""
    return [l for l in text.splitlines() if b" seal " not in l]


class Slurm(JobTest):
    def setUp(self):
        super().setUp()
        self.folder.chmod(0o755)
        self.start_munge()
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], ports=free_ports(),
            folder=self.folder, cpus=os.cpu_count()))
        self.start("slurmctld", "-D", "-f", self.conf)
        self.start("slurmd", "-D", "-f", self.conf)
        wait_until(
            lambda: "idle" in self.slurm("sinfo", "-h", "-o", "%T"), 120,
            "the node is idle")

    def start(self, *words, **more):
        log = (self.folder / f"{words[0]}.out").open("w")
        self.addCleanup(log.close)
        daemon = subprocess.Popen(
            [*map(str, words)], stdout=log, stderr=log, **more)

        def stop():
            daemon.terminate()
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.addCleanup(stop)

    def start_munge(self):
        folder = self.folder / "munge"
        user = pwd.getpwnam("munge")
        folder.mkdir(mode=0o755)
        key = folder / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        for path in (folder, key):
            os.chown(path, user.pw_uid, user.pw_gid)
        self.start(
            "munged", "--foreground", "--force", f"--key-file={key}",
            *(f"--{n}={folder / n.split('-')[0]}"
              for n in ("socket", "pid-file", "log-file", "seed-file")),
            user=user.pw_uid, group=user.pw_gid, extra_groups=[])
        wait_until((folder / "socket").exists, 60, "munged has its socket")

    def slurm(self, *words):
        result = subprocess.run(
            [*map(str, words)], capture_output=True, text=True,
            cwd=self.folder, env={**os.environ, "SLURM_CONF": str(self.conf)})
        return result.stdout + result.stderr

    def state(self, job, task):
        text = self.slurm("scontrol", "show", "job", f"{job}_{task}")
        words = dict(w.split("=", 1) for w in text.split() if "=" in w)
        return words.get("JobState", text)

    def process_of(self, job, task):
        """The process that runs a task of this very test."""
        wanted = f"{PROGRAM}\0run\0{job}\0--task\0{task}\0".encode()
        for path in Path("/proc").glob("[0-9]*/cmdline"):
            try:
                if path.read_bytes() == wanted:
                    return int(path.parent.name)
            except OSError:
                pass
        return None

    def test_a_killed_task_is_requeued(self):
        alone = self.write_job("alone", [("all", WHOLE)])
        self.run_all(alone, 1)
        numbers = [n.split(".")[1] for n in self.outputs(alone)
                   if n.endswith(".exr")]
        self.assertIn(len(numbers), range(3, 9))
        farm = self.write_job(
            "farm", [(f"tile_{n}", f"{WHOLE} --udim {n}") for n in numbers])
        self.assert_exit(self.run_program(
            "plan", farm, "--engine", "slurm", "-o", self.folder / "plan"), 0)
        said = self.slurm("sbatch", "--parsable", "plan/job.sbatch")
        self.assertRegex(said, r"^\d+\n$")
        number = said.strip()

        wait_until(lambda: self.process_of(farm, 1), 60, "the task runs")
        time.sleep(0.5)
        os.kill(self.process_of(farm, 1), signal.SIGKILL)
        wait_until(
            lambda: self.state(number, 1) == "FAILED", 60, "the task failed")
        self.assertNotIn("cage.1002.exr", sorted(self.outputs(farm)))

        self.assertEqual(self.slurm("scontrol", "requeue", f"{number}_1"), "")
        for task in range(len(numbers)):
            wait_until(
                lambda: self.state(number, task) == "COMPLETED", 120,
                f"task {task} is done")
        whole, tiles = self.outputs(alone), self.outputs(farm)
        for name, content in whole.items():
            # Only a bake of all tiles says in its texts that all is done.
            if name.endswith(".exr"):
                self.assertTrue(content == tiles[name], name)
            else:
                self.assertEqual(unmarked(content), unmarked(tiles[name]))


if __name__ == "__main__":
    main()
