"""Runs a command and notes the processor time that it and its programs took.

Usage: measured.py FOLDER NAME COMMAND... The seconds are written to FOLDER/NAME, with - for each / in NAME: a line for
each of the command's cases (main.cpp, timed.py), with its seconds, a tab, and its name, and a last one for all together.
A command that is killed leaves the file of an earlier run. In soak tests, which take longer, nothing is noted.
"""
import os
import resource
import subprocess
import sys

folder, name, *command = sys.argv[1:]
if "HOLOMORPH_FRESH" in os.environ:
    os.execvp(command[0], command)
path = os.path.join(folder, name.replace("/", "-"))
own = f"{path}.{os.getpid()}"
os.makedirs(folder, exist_ok=True)
try:
    open(own, "w").close()
    status = subprocess.run(command, env=dict(os.environ, HOLOMORPH_SECONDS=own)).returncode
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(own, "a") as file:
        file.write(f"{used.ru_utime + used.ru_stime:.2f}\tall\n")
    os.replace(own, path)
finally:
    if os.path.exists(own):
        os.remove(own)
sys.exit(status if status >= 0 else 128 - status)
