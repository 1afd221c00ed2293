# Films drawn by a queue of jobs: a Slurm cluster of one machine, which the test starts, and scripts run by hand.
import os
import pwd
import re
import signal
import socket
import stat
import subprocess
import tempfile
import time
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from case import Case, timed  # noqa: E402


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Cluster:
    """Slurm with one node, in a folder of its own."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="holomorph-slurm-", dir="/tmp")
        os.chmod(self.folder, 0o755)
        self.programs = []
        key = self.path("munge.key")
        with open(key, "wb") as file:
            file.write(os.urandom(1024))
        os.chmod(key, 0o400)
        self.start("munged", "--foreground", "--force", "--key-file=" + key, "--socket=" + self.path("munge.socket"),
                   "--log-file=" + self.path("munge.log"), "--pid-file=" + self.path("munge.pid"), "--seed-file=" + self.path("seed"))
        self.wait(lambda: os.path.exists(self.path("munge.socket")), "munge")
        user = pwd.getpwuid(os.getuid()).pw_name
        host = socket.gethostname().split(".")[0]
        for name in ("state", "spool"):
            os.mkdir(self.path(name))
        with open(self.path("slurm.conf"), "w") as file:
            file.write(f"""ClusterName=holomorph
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={self.path('munge.socket')}
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
StateSaveLocation={self.path('state')}
SlurmdSpoolDir={self.path('spool')}
SlurmctldPidFile={self.path('slurmctld.pid')}
SlurmdPidFile={self.path('slurmd.pid')}
SlurmctldLogFile={self.path('slurmctld.log')}
SlurmdLogFile={self.path('slurmd.log')}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": self.path("slurm.conf")}
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait(lambda: "idle" in self.told("sinfo", "-h", "-o", "%T"), "the node is idle")

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, program, *words):
        with open(self.path(program + ".err"), "w") as said:
            self.programs.append(subprocess.Popen(["/usr/sbin/" + program, *words], env=getattr(self, "environment", None),
                                                  stdout=subprocess.DEVNULL, stderr=said))

    def told(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True).stdout

    def wait(self, ready, what, seconds=60):
        end = time.monotonic() + seconds
        while not ready():
            if time.monotonic() > end:
                logs = [name for name in os.listdir(self.folder) if name.endswith((".log", ".err"))]
                said = "".join(f"== {name}\n{open(self.path(name)).read()[-1500:]}\n" for name in logs)
                raise AssertionError(f"waited for: {what}\n{said}")
            time.sleep(0.05)

    def stop(self):
        for program in reversed(self.programs):
            program.terminate()
        for program in self.programs:
            program.wait()
        subprocess.run(["rm", "-rf", self.folder])


def renderers(frames):
    """The processes that draw into a folder."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/cmdline", "rb") as file:
                words = file.read().split(b"\0")
        except OSError:
            continue
        if b"render" in words[1:2] and frames.encode() in words:
            found.append(int(pid))
    return found


class Farm(Case):
    def setUp(self):
        super().setUp()
        scene = self.keyed_scene()
        scene["animation"]["frames_per_second"] = 24
        scene["keyframes"][1]["time"] = 199 / 24
        self.scene = self.write("it's a scene.json", scene)
        os.mkdir(self.path("the frames"))
        self.frames = self.path("the frames/f.png")

    def bytes_of(self, path):
        with open(path, "rb") as file:
            return file.read()

    def frame(self, number):
        return f"{self.frames[:-4]}-{number:04}.png"

    def check_frames(self, count, *options):
        """Compares all frames with those of one machine."""
        os.mkdir(self.path("one"))
        self.good("render", self.scene, "--frames", f"0..{count - 1}", *options, "--out", self.path("one/f.png"))
        for i in range(count):
            self.assertEqual(self.bytes_of(self.frame(i)), self.bytes_of(self.path(f"one/f-{i:04}.png")), i)
        self.assertEqual(len([name for name in os.listdir(self.path("the frames")) if name.endswith(".png")]), count)

    def test_a_killed_worker_costs_nothing_but_time(self):
        cluster = Cluster()
        try:
            film = self.path("film.webp")
            said = self.good("farm", self.scene, "--engine", "slurm", "--out", self.frames, "--film", film, "--scale", "8",
                             "--chunk", "25", env=cluster.environment).stderr
            self.assertRegex(said, r"submitted as job \d+")
            cluster.wait(lambda: sum(os.path.exists(self.frame(i)) for i in range(200)) > 5, "the first frames")
            workers = renderers(self.frames)
            self.assertTrue(workers)
            os.kill(workers[0], signal.SIGKILL)
            self.assertLess(sum(os.path.exists(self.frame(i)) for i in range(200)), 200, "it was killed in the middle")
            cluster.wait(lambda: not cluster.told("squeue", "-h").strip(), "all jobs", 240)
            log = self.bytes_of(self.path("the frames/f.log")).decode()
            chunks = [int(count) for count in re.findall(r"^(\d+) frames of", log, re.M)]
            self.assertEqual(len(chunks), 8, log)  # one of the nine did not end
            self.assertTrue(0 < min(chunks) < 25, "only its missing frames are drawn again\n" + log)
            self.assertIn("all frames from 0 to 199 are drawn", log)
        finally:
            cluster.stop()
        self.check_frames(200, "--scale", "8")
        self.good("export", self.scene, "--format", "webp", "--scale", "8", "--out", self.path("one.webp"))
        self.assertEqual(self.bytes_of(film), self.bytes_of(self.path("one.webp")))

    def queue(self):
        """The environment of a queue that runs every job at once, in place of sbatch."""
        os.makedirs(self.path("bin"), exist_ok=True)
        with open(self.path("bin/sbatch"), "w") as file:
            file.write('#!/bin/bash\necho "$*" >> "$0.calls"\n'
                       'while [[ $1 = --* ]]; do case $1 in --array=*) tasks=${1#--array=};; esac; shift; done\nfor task in $(echo "${tasks:-x}" | tr , " "); do\n'
                       '  SLURM_ARRAY_TASK_ID=$task bash "$@" >> "$0.log" 2>&1\ndone\necho "7;here"\n')
        os.chmod(self.path("bin/sbatch"), stat.S_IRWXU)
        return {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"]}

    def by_hand(self, *options):
        return self.good("farm", self.scene, "--engine", "slurm", "--out", self.frames, *options, env=self.queue())

    def test_only_missing_frames_are_drawn(self):
        self.by_hand("--frames", "0..39", "--chunk", "8")
        self.check_frames(40)
        kept = {i: os.stat(self.frame(i)).st_mtime_ns for i in range(40)}
        for i in (3, 4, 30):
            os.remove(self.frame(i))
        self.by_hand("--frames", "0..39", "--chunk", "8", "--film", self.path("f.gif"))
        with open(self.path("bin/sbatch.calls")) as file:
            calls = file.read()
        self.assertIn("--array=0,3", calls)
        self.assertRegex(calls, r"sbatch draw -?\d", "the rectangle is found once, not by each task")
        drawn = {i for i in range(40) if os.stat(self.frame(i)).st_mtime_ns != kept[i]}
        self.assertEqual(drawn, {3, 4, 30})
        self.good("export", self.scene, "--format", "gif", "--frames", "0..39", "--out", self.path("one.gif"))
        self.assertEqual(self.bytes_of(self.path("f.gif")), self.bytes_of(self.path("one.gif")))

    def test_it_gives_up_after_some_rounds(self):
        self.good("farm", self.scene, "--engine", "slurm", "--out", self.frames, "--frames", "0..9", "--rounds", "2",
                  "--only-write")
        os.remove(self.scene)  # so that no frame can be drawn
        subprocess.run(["sbatch", self.path("the frames/f.sbatch")], check=True, stdout=subprocess.DEVNULL, env=self.queue())
        log = self.bytes_of(self.path("bin/sbatch.log")).decode()
        self.assertEqual(log.count("it's a scene.json"), 2, "two rounds\n" + log)
        self.assertIn("after 2 rounds, frames are still missing in chunks 0", log)

    def test_mistakes_are_explained(self):
        here = ["farm", self.scene, "--engine", "slurm", "--out", self.frames]
        self.bad("farm", self.scene, "--engine", "deadline", "--out", self.frames, says="the engine is slurm")
        self.bad(*here, "--frames", "0..500", says="frames")
        self.bad(*here, "--depth", "12", says="has 8 or 16 bits")
        self.bad(*here, "--film", self.path("f.xyz"), says="f.xyz")
        self.bad(*here, "--film", self.path("f.png"), says="needs another format")
        self.bad(*here, "--scale", "1000000", says="pixels")
        self.bad("farm", self.scene, "--engine", "slurm", "--out", self.path("f.doc"), says="f.doc")
        self.bad("farm", self.scene, "--engine", "slurm", "--out", self.path('a"b.png'), says="a quote")
        self.good(*here, "--film", self.path("f.WEBP"), "--rect", "-5,-5,60,50", "--only-write")
        with open(self.path("the frames/f.sbatch")) as file:
            script = file.read()
        self.assertIn(" chunk=10 rounds=3\n", script)
        self.assertIn("--format webp", script)
        self.assertIn("--rect -5,-5,60,50", script)
        os.remove(self.path("the frames/f.sbatch"))
        self.bad("farm", self.scene, "--engine", "slurm", "--out", self.path("50%.png"), says="%")
        still = self.write("still.json", {**self.keyed_scene(), "keyframes": []})
        self.bad("farm", still, "--engine", "slurm", "--out", self.frames, says="keyframes")
        self.bad(*here, says="sbatch is not installed", status=1, env={"PATH": "/nowhere"})
        self.assertTrue(os.path.exists(self.path("the frames/f.sbatch")))
        self.bad("render", self.scene, "--missing", "--out", self.frames, says="--missing")
        self.bad("export", self.scene, "--format", "svg", "--drawn", self.frames, "--out", self.path("o.svg"), says="--drawn")
        self.bad("export", self.scene, "--format", "gif", "--drawn", self.frames, "--out", self.path("o.gif"), says="f-0000.png")


if __name__ == "__main__":
    timed.main(sys.argv[3:])
