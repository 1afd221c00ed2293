# Shared by the tests of the command line: the program, a folder, and checks for good and bad calls.
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from PIL import Image

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
sys.path.append(os.path.join(SOURCE, "tests/support"))
import timed  # noqa: E402, F401
from old_samples import old_sample  # noqa: E402
from seeds import few_or_many, seed_of, soak  # noqa: E402, F401


def run(*words, **options):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, **options)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="holomorph-cli-")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "w") as file:
            file.write(content if isinstance(content, str) else json.dumps(content))
        return self.path(name)

    def good(self, *words, **options):
        result = run(*words, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def bad(self, *words, says, status=2, **options):
        result = run(*words, **options)
        self.assertEqual(result.returncode, status, result.stderr + result.stdout)
        self.assertIn(says, result.stderr)
        return result

    def keyed_scene(self):
        Image.new("RGBA", (60, 40), (200, 40, 40, 255)).save(self.path("red.png"))
        cage = [[10, 10], [50, 10], [50, 30], [10, 30]]
        moved = [[[x + 20, y + 30]] for x, y in cage]
        return {"format": "holomorph", "version": 1, "image": {"file": "red.png"},
                "cage": {"rest": [[p] for p in cage]}, "method": {"id": "cage"},
                "animation": {"frames_per_second": 4},
                "keyframes": [{"time": 0, "ease": "linear", "pose": {}}, {"time": 1, "pose": {"cage": moved}}]}
