"""Helpers for the attacks: run the program under limits, print the seed, print a summary line.

Each script takes the program and the checkout, as the other tests do, and options. It prints one summary line and exits
with status 1 if a check fails. Without options it does a short run.
"""
import argparse
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
from seeds import few_or_many, seed_of  # noqa: E402, F401
from timed import note  # noqa: E402, F401


def arguments(text, **options):
    """Parses the command line: PROGRAM SOURCE, --seed, and options with their defaults."""
    parser = argparse.ArgumentParser(description=text)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("source", type=os.path.abspath)
    parser.add_argument("--seed", type=int, help="of the random choices")
    for name, default in options.items():
        parser.add_argument("--" + name, type=type(default), default=default)
    parsed = parser.parse_args()
    if parsed.seed is None:
        parsed.seed = seed_of("attack")
    return parsed


class Outcome:
    """How a run of the program ended: exit status (or minus the signal), processor seconds, MB and error output."""

    def __init__(self, status, seconds, megabytes, said, hung):
        self.status, self.seconds, self.megabytes, self.said, self.hung = status, seconds, megabytes, said, hung

    def wrong(self, most_seconds, most_megabytes):
        """What is wrong with the run; "" if nothing is."""
        if self.hung:
            return "hangs"
        if self.status in (-signal.SIGXCPU, -signal.SIGKILL):
            return f"more than {most_seconds} s"
        if self.status < 0:
            return f"signal {-self.status}"
        if self.status > 2:
            return f"status {self.status}"
        if self.megabytes > most_megabytes:
            return f"{self.megabytes} MB"
        if self.status and not self.said.startswith("holomorph: "):
            return "no error message: " + self.said[:200]
        for word in ("bad_alloc", "basic_", "Sanitizer", "CGAL", "assertion", "what()", "filesystem error"):
            if word in self.said:
                return "says " + self.said[:200]
        return ""


def run(command, folder, most_seconds=20, patience=240, address_space=12 << 30):
    """Runs a command with a limit on its processor time."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (most_seconds, most_seconds + 2))
        resource.setrlimit(resource.RLIMIT_AS, (address_space, address_space))
        os.setsid()

    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=said, preexec_fn=limit)
        hung = []
        timer = threading.Timer(patience, lambda: (hung.append(True), process.kill()))
        timer.start()
        _, status, use = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = 0
        said.seek(0)
        return Outcome(os.waitstatus_to_exitcode(status), use.ru_utime + use.ru_stime, use.ru_maxrss >> 10,
                       said.read(4000).decode(errors="replace"), bool(hung))


class Tally:
    """What the runs of an attack used, and which of them were bad."""

    def __init__(self, most_seconds, most_megabytes):
        self.limits = most_seconds, most_megabytes
        self.bad, self.statuses, self.peak, self.slowest = [], {}, 0, 0

    def add(self, title, outcome):
        """Returns whether the run was bad."""
        self.statuses[outcome.status] = self.statuses.get(outcome.status, 0) + 1
        self.peak, self.slowest = max(self.peak, outcome.megabytes), max(self.slowest, outcome.seconds)
        if wrong := outcome.wrong(*self.limits):
            self.bad.append(f"{title}: {wrong}")
        return bool(wrong)

    def finish(self, name, line):
        finish(name, f"{line}, statuses {self.statuses}, {len(self.bad)} bad, at most {self.peak} MB and {self.slowest:.1f} s", self.bad)


def finish(name, line, bad):
    for each in bad[:20]:
        print("bad:", each)
    print(f"{name}: {line}: {'bad' if bad else 'good'}")
    sys.exit(1 if bad else 0)
