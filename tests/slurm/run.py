#!/usr/bin/env python3
"""examples/slurm with a controller and a node of their own, started here and ended here: a sweep of eight tasks, of which
one is killed, one requeued and one stopped by its time limit, comes to the bytes of one process. run.py PROGRAM"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GRID = "--r 0.1:2:100 --alpha 0.05:4:100".split()
PARTS = 8
NEEDED = ["slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "munged"]
# Seconds, for a machine with other work: no measurement.
PATIENCE = 1500

CONFIGURATION = """
ClusterName=stickslip
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
CredType=cred/munge
# A requeued job waits until its credential has expired: two minutes otherwise.
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
KillWait=5
JobRequeue=1
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return listening.getsockname()[1]


class Cluster:
    """Munge, controller and node in a folder of their own."""

    def __init__(self, folder):
        self.folder, self.processes = folder, []
        for name in ("state", "spool"):
            (folder / name).mkdir()
        host = socket.gethostname().split(".")[0]
        ports = [free_port(), free_port()]
        self.configuration = folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(host=host, folder=folder, ports=ports))
        self.environment = {**os.environ, "SLURM_CONF": str(self.configuration)}

    def __enter__(self):
        folder = self.folder
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        places = {"socket": "munge.socket", "pid-file": "munge.pid", "seed-file": "munge.seed", "log-file": "munge.log"}
        options = [f"--{name}={folder / place}" for name, place in places.items()]
        self.start("munged", "--foreground", "--force", f"--key-file={key}", *options)
        wait_for("munge's socket", lambda: (folder / "munge.socket").exists())
        self.start("slurmctld", "-D", "-c", "-f", self.configuration)
        self.start("slurmd", "-D", "-f", self.configuration)
        wait_for("the node", lambda: "idle" in self.asks("sinfo", "--noheader", "--format=%t"))
        return self

    def start(self, *command):
        log = (self.folder / f"{command[0]}.out").open("w")
        self.processes.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log))

    def asks(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def __exit__(self, *error):
        if error[0] is None:
            subprocess.run(["scancel", "--user=root"], env=self.environment)
        for process in reversed(self.processes):
            process.terminate()
        for process in self.processes:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()


def wait_for(what, is_there, patience=PATIENCE):
    until = time.monotonic() + patience
    while not (found := is_there()):
        if time.monotonic() > until:
            sys.exit(f"waited in vain for {what}")
        time.sleep(0.1)
    return found


def program_of(part):
    """The process that computes a part."""
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"sweep" in words and any(word.endswith(f"/part-{part}.json".encode()) for word in words):
            if b"bash" not in words[0]:
                return int(entry.name)
    return None


def begun(part, folder):
    """Its process, once it has finished a point."""
    kept = folder / f"part-{part}.json.partial"
    wait_for(f"points of part {part}", lambda: kept.exists() and len(kept.read_bytes().splitlines()) > 2)
    return program_of(part)


def disturb(cluster, array, folder):
    """One task killed, one requeued, one stopped by its time limit."""
    killed = wait_for("part 1", lambda: begun(1, folder))
    os.kill(killed, signal.SIGKILL)
    wait_for("part 2", lambda: begun(2, folder))
    cluster.asks("scontrol", "requeue", f"{array}_2")
    # It does not get on until its time is nearly up.
    stopped = wait_for("part 3", lambda: begun(3, folder))
    os.kill(stopped, signal.SIGSTOP)
    log = folder / "task-3.log"
    wait_for("the limit of part 3", lambda: "the time is nearly up" in log.read_text())
    os.kill(stopped, signal.SIGCONT)


def main(program):
    missing = [name for name in NEEDED if shutil.which(name) is None]
    if missing:
        print(f"skipped: Slurm is not installed ({', '.join(missing)}); Debian: slurmctld slurmd slurm-client munge")
        return
    folder = Path(tempfile.mkdtemp(prefix="stickslip-slurm-"))
    alone = folder / "alone.json"
    subprocess.run([program, "--quiet", "sweep", *GRID, "-o", alone], check=True)
    with Cluster(folder) as cluster:
        cluster.environment["STICKSLIP"] = str(program)
        # The least limit that there is, and told when ten seconds of it have gone.
        cluster.environment.update(SBATCH_TIMELIMIT="1", SBATCH_SIGNAL="B:TERM@50")
        file = folder / "map.json"
        submit = [ROOT / "examples/slurm/submit.sh", file, str(PARTS), *GRID]
        submitted = subprocess.run(submit, env=cluster.environment, check=True, capture_output=True, text=True)
        array, _ = submitted.stdout.split()
        disturb(cluster, array, folder / "map.json.parts")
        wait_for("the map", file.exists)
        logs = {part: (folder / f"map.json.parts/task-{part}.log").read_text() for part in (1, 2, 3)}
    assert "stopped by signal 9: requeued" in logs[1], logs[1]
    assert all("restart 1" in logs[part] for part in logs), logs
    assert "the time is nearly up" in logs[3] and "stopped by signal 15: requeued" in logs[3], logs[3]
    assert file.read_bytes() == alone.read_bytes(), "the merged parts are not the bytes of one process"
    print(f"{PARTS} tasks, one killed, one requeued, one stopped by its time limit: the bytes of one process")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
