"""Runs a command and notes the processor time that it and its programs took.

Usage: measured.py FOLDER NAME COMMAND... The seconds are written to FOLDER/NAME, with - for each / in NAME.
"""
import os
import resource
import subprocess
import sys

folder, name, *command = sys.argv[1:]
status = subprocess.run(command).returncode
used = resource.getrusage(resource.RUSAGE_CHILDREN)
os.makedirs(folder, exist_ok=True)
with open(os.path.join(folder, name.replace("/", "-")), "w") as file:
    file.write(f"{used.ru_utime + used.ru_stime:.2f}\n")
sys.exit(status if status >= 0 else 128 - status)
