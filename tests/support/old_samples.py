# The samples of earlier releases, with methods and parameters as they were then.
import atexit
import os
import shutil
import sys
import tempfile

SOURCE = sys.argv[2]
FOLDER = None


def old_sample(name):
    """The path of a copy of the scene, next to its picture."""
    global FOLDER
    if FOLDER is None:
        FOLDER = tempfile.mkdtemp(prefix="holomorph-samples-")
        atexit.register(shutil.rmtree, FOLDER)
    path = os.path.join(FOLDER, name + ".json")
    if not os.path.exists(path):
        shutil.copy(os.path.join(SOURCE, "assets", name.removeprefix("harmonic-") + ".png"), FOLDER)
        shutil.copy(os.path.join(SOURCE, "tests/data/scenes", name + ".json"), path)
    return path
