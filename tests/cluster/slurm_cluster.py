# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""A Slurm of one node, of Debian's packages, with its files in a folder of its own and its ports on the loopback interface alone.
Needs root: munged runs as its own user, slurmd starts jobs as theirs."""

import os
import pathlib
import re
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "munge", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "runuser")
# cgroup/v1 does nothing while linuxproc tracks processes and nothing binds tasks. Without a choice
# slurmd looks for a cgroup version, and gives up where it finds none, as in many containers.
CGROUP_CONF = "CgroupPlugin=cgroup/v1\n"
SLURM_CONF = """ClusterName=lmdbench
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout={timeout}
SlurmctldTimeout=10
InactiveLimit=0
KillWait=5
MinJobAge={job_age}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldDebug=verbose
SlurmdDebug=verbose
NodeName={host} NodeHostname={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory=16000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
"""


def why_not():
    """Why no cluster can be had here; None where it can."""
    missing = [name for name in PROGRAMS if shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None]
    if missing:
        return f"not installed: {', '.join(missing)} (remedy: ./scripts/cluster_test.sh installs them)"
    if os.geteuid() != 0:
        return "Slurm's daemons start jobs as other users: that needs root"
    return None


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def wait_for(condition, seconds, what):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return
        time.sleep(0.1)
    raise TimeoutError(f"{what} did not come within {seconds} s")


class Cluster:
    def __init__(self, folder, processors, timeout=10, job_age=300):
        self.folder = pathlib.Path(folder)
        self.folder.chmod(0o755)
        for name in ("state", "spool"):
            (self.folder / name).mkdir(mode=0o700)
        self.host = socket.gethostname().split(".")[0]
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(SLURM_CONF.format(
            host=self.host, folder=self.folder, controller_port=free_port(), node_port=free_port(), processors=processors,
            timeout=timeout, job_age=job_age))
        (self.folder / "cgroup.conf").write_text(CGROUP_CONF)
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf), "USER": os.environ.get("USER", "root"),
                            "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        self.processes = {}

    def __enter__(self):
        try:
            self._start_munge()
            self.start("slurmctld", "slurmctld", "-D", "-i", "-f", str(self.conf))
            self.start_node()
            wait_for(lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"), 60, "an idle node")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in ("slurmd", "slurmctld", "munged"):
            process = self.processes.pop(name, None)
            if process is not None and process.poll() is None:
                process.terminate()
                try:
                    process.wait(20)
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.wait()
        for process in self.ours():
            self.kill(process)

    def _start_munge(self):
        folder = self.folder / "munge"
        folder.mkdir(mode=0o755)
        key = folder / "key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        user = pwd.getpwnam("munge")
        for path in (folder, key):
            os.chown(path, user.pw_uid, user.pw_gid)
        self.start("munged", "runuser", "-u", "munge", "--", "munged", "--foreground", "--key-file", str(key),
                   "--socket", str(folder / "socket"), "--pid-file", str(folder / "pid"), "--log-file", str(folder / "log"),
                   "--seed-file", str(folder / "seed"))
        wait_for((folder / "socket").exists, 20, "munged's socket")

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as log:
            self.processes[name] = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                                    start_new_session=True)

    def start_node(self):
        self.start("slurmd", "slurmd", "-D", "-N", self.host, "-f", str(self.conf))

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=60, check=False).stdout

    def ours(self):
        """Numbers of this cluster's processes, jobs included: their environment names its configuration."""
        mark = f"SLURM_CONF={self.conf}".encode()
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) == os.getpid():
                continue
            try:
                if mark in (entry / "environ").read_bytes().split(b"\0"):
                    found.append(int(entry.name))
            except OSError:
                continue
        return found

    @staticmethod
    def kill(process, number=signal.SIGKILL):
        try:
            os.kill(process, number)
        except ProcessLookupError:
            pass

    @staticmethod
    def job_of(process):
        """Number of the Slurm job that a process belongs to, or None."""
        try:
            found = re.search(rb"(?:^|\0)SLURM_JOB_ID=(\d+)", pathlib.Path(f"/proc/{process}/environ").read_bytes())
        except OSError:
            return None
        return int(found[1]) if found else None

    @staticmethod
    def name_of(process):
        try:
            return pathlib.Path(f"/proc/{process}/comm").read_text().strip()
        except OSError:
            return ""

    @staticmethod
    def descendants(process):
        children = {}
        for entry in pathlib.Path("/proc").iterdir():
            if entry.name.isdigit():
                try:
                    parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
                except (OSError, ValueError, IndexError):
                    continue
                children.setdefault(parent, []).append(int(entry.name))
        found, todo = [], [process]
        while todo:
            for child in children.get(todo.pop(), []):
                found.append(child)
                todo.append(child)
        return found
