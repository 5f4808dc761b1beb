"""A quick study through the SLURM profile, on a single-node Slurm that this test starts for itself: its own munged, slurmctld and slurmd, in a
temporary folder and on ports of their own. Skipped, saying why, where Debian's slurm-wlm and munge are missing or the user is not root."""
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

from support import run_study

skipped = 77  # what CTest counts as skipped


def reason_to_skip():
    missing = [tool for tool in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol") if shutil.which(tool, path="/usr/sbin:/usr/bin:/sbin:/bin") is None]
    if missing:
        return f"{', '.join(missing)} not installed (apt-get install slurm-wlm munge)"
    return "slurmd must be started by root" if os.geteuid() != 0 else ""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def memory_mb():
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") * 9 // 10 // 2**20


class SingleNode:
    """Daemons and their folder; ends what it started."""

    def __init__(self, folder):
        self.folder, self.processes = folder, []
        self.host = socket.gethostname().split(".")[0]
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir(mode=0o700)
        (folder / "munge" / "key").write_bytes(secrets.token_bytes(1024))
        (folder / "munge" / "key").chmod(0o400)
        self.configuration = folder / "slurm.conf"
        self.configuration.write_text(f"""ClusterName=vitrum-test
SlurmctldHost={self.host}(127.0.0.1)
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SwitchType=switch/none
NodeName={self.host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} RealMemory={memory_mb()} State=UNKNOWN
PartitionName=main Nodes={self.host} Default=YES MaxTime=INFINITE State=UP
""")

    def start(self, *command):
        environment = {**os.environ, "SLURM_CONF": str(self.configuration)}
        log = open(self.folder / f"{pathlib.Path(command[0]).name}.out", "w")
        self.processes.append(subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env=environment, start_new_session=True))

    def wait_for(self, what, ready):
        for _ in range(150):
            if ready():
                return
            time.sleep(0.2)
        raise RuntimeError(f"{what} did not come up:\n" + "\n".join(f"== {log.name}\n{log.read_text()[-1500:]}" for log in self.folder.glob("*.[lo][ou][gt]")))

    def up(self):
        munge = self.folder / "munge"
        # --force: the folder of a test has not the ownership that munged asks of /run/munge.
        self.start("/usr/sbin/munged", "--foreground", "--force", f"--socket={munge}/socket", f"--key-file={munge}/key", f"--pid-file={munge}/pid",
                   f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        self.wait_for("munged", (munge / "socket").exists)
        self.start("/usr/sbin/slurmctld", "-D", "-f", str(self.configuration))
        self.start("/usr/sbin/slurmd", "-D", "-f", str(self.configuration), "-N", self.host)
        self.wait_for("the node", lambda: "idle" in subprocess.run(["sinfo", "--noheader", "--format=%T"], capture_output=True, text=True).stdout)

    def down(self):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def main():
    reason = reason_to_skip()
    if reason:
        print(f"SKIPPED: {reason}")
        return skipped
    folder = pathlib.Path(tempfile.mkdtemp(prefix="vitrum-slurm-"))
    node = SingleNode(folder)
    os.environ["SLURM_CONF"] = str(node.configuration)
    try:
        node.up()
        done = run_study("sensitivity", folder / "out", "--profile", "studies/profiles/slurm")
        if done.returncode != 0:
            print(done.stdout[-2000:], done.stderr[-6000:], sep="\n")
            return 1
        logs = list((folder / "out" / "slurm").glob("*.log"))
        jobs = list((folder / "out" / "jobs").glob("*.done"))
        print(f"{len(logs)} Slurm jobs, {len(jobs)} jobs of the study")
        # Every job, and the report, went through Slurm.
        assert len(logs) == len(jobs) + 1 and len(jobs) >= 6, (logs, jobs)
        assert (folder / "out" / "page.md").exists()
        return 0
    finally:
        node.down()
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
