#!/usr/bin/env python3
"""Tests a folder that scripts/bundle has written: it brings its libraries, can be moved, draws, and opens its window.

Usage: bundle_test.py FOLDER
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "app"))
from driver import Display  # noqa: E402

FOLDER = os.path.abspath(sys.argv[1])
# What a system has that can open a window at all.
OF_THE_SYSTEM = {"linux-vdso", "ld-linux-x86-64", "libc", "libm", "libdl", "libpthread", "librt", "libresolv", "libstdc++", "libgcc_s",
                 "libX11", "libxcb", "libXau", "libXdmcp", "libbsd", "libmd", "libz", "libzstd", "libGL", "libGLX", "libGLdispatch",
                 "libEGL", "libOpenGL"}


class BundleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.mkdtemp(prefix="holomorph-bundle-")
        cls.moved = os.path.join(cls.work, "a moved folder")
        shutil.copytree(FOLDER, cls.moved)
        cls.program = os.path.join(cls.moved, "bin/holomorph")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    def test_libraries_come_from_the_folder(self):
        lines = subprocess.run(["ldd", self.program], check=True, capture_output=True, text=True).stdout.splitlines()
        own = 0
        for line in lines:
            name = os.path.basename(line.split()[0]).split(".so")[0]
            self.assertNotIn("not found", line)
            if name not in OF_THE_SYSTEM:
                self.assertIn(self.moved + "/lib/", os.path.normpath(line.split("=>")[1].split(" (")[0].strip()), line)
                own += 1
        self.assertGreater(own, 20)

    def test_old_systems_have_what_it_needs(self):
        files = [self.program] + [os.path.join(self.moved, "lib", name) for name in os.listdir(os.path.join(self.moved, "lib"))]
        for file in files:
            symbols = subprocess.run(["objdump", "-T", file], check=True, capture_output=True, text=True).stdout
            for prefix, newest in (("GLIBC_", (2, 35)), ("GLIBCXX_", (3, 4, 30))):
                for found in set(re.findall(prefix + r"([0-9.]+)", symbols)):
                    self.assertLessEqual(tuple(map(int, found.split("."))), newest, file)

    def test_samples_are_drawn(self):
        out = os.path.join(self.work, "fish.png")
        sample = os.path.join(self.moved, "share/holomorph/assets/fish.json")
        subprocess.run([self.program, "render", sample, "--out", out], check=True, stderr=subprocess.DEVNULL, cwd=self.work)
        self.assertGreater(os.path.getsize(out), 1000)

    def test_licenses_and_sources_are_there(self):
        folder = os.path.join(self.moved, "share/doc/libraries")
        for package in ("libopenblas0-pthread", "libcgal-dev", "libimgui-dev", "libimagequant0", "fonts-roboto-unhinted"):
            self.assertTrue(os.path.exists(os.path.join(folder, package)), package)
        with open(os.path.join(folder, "sources")) as file:
            self.assertRegex(file.read(), r"(?m)^openblas [0-9]")
        self.assertTrue(os.path.exists(os.path.join(self.moved, "share/doc/holomorph/source.tar.gz")))

    def test_the_window_opens_with_the_fonts_of_the_folder(self):
        with Display() as display:
            display.run("strace", "-D", "-f", "-e", "trace=openat", "-o", os.path.join(self.work, "opened"), self.program,
                        os.path.join(self.moved, "share/holomorph/assets/fish.json"))
            end = time.time() + 60
            colors = 0
            while colors < 1000 and time.time() < end:  # the picture has many, an empty window only a few
                self.assertIsNone(display.process.poll(), display.messages())
                time.sleep(0.5)
                shot = os.path.join(self.work, "shot.png")
                display.screenshot(shot)
                colors = int(subprocess.run(["identify", "-format", "%k", shot], check=True, capture_output=True, text=True).stdout)
            self.assertGreaterEqual(colors, 1000, "the picture is not drawn")
            display.process.terminate()
            display.process.wait()
        with open(os.path.join(self.work, "opened")) as file:
            opened = file.read()
        self.assertIn("share/holomorph/fonts/Roboto-Regular.ttf", opened)
        self.assertNotIn("/usr/share/fonts/truetype/roboto", opened)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
