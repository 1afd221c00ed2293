"""Runs a command and notes the processor time that it and its programs took.

Usage: measured.py FOLDER NAME COMMAND... The seconds are written to FOLDER/NAME, with - for each / in NAME. The command
adds a line for each of its cases (main.cpp, timed.py): its seconds, a tab, and its name.
"""
import os
import resource
import subprocess
import sys

folder, name, *command = sys.argv[1:]
path = os.path.join(folder, name.replace("/", "-"))
os.makedirs(folder, exist_ok=True)
open(path, "w").close()
status = subprocess.run(command, env=dict(os.environ, HOLOMORPH_SECONDS=path)).returncode
used = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(path, "a") as file:
    file.write(f"{used.ru_utime + used.ru_stime:.2f}\tall\n")
sys.exit(status if status >= 0 else 128 - status)
