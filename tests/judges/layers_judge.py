# GIMP and Krita read our files with layers and write them again: the pictures stay the same.
import os
import random
import subprocess
import sys
import unittest

import numpy
from PIL import Image
from psd_tools import PSDImage
from psd_tools.composite import composite

SOURCE = sys.argv[2]
sys.path.append(os.path.join(SOURCE, "tests/cli"))
from layered_test import Layered, premultiplied  # noqa: E402


def by_gimp(source, out):
    load = f'(gimp-file-load RUN-NONINTERACTIVE "{source}" "{source}")'
    script = (f"(let* ((image (car {load})) (layer (car (gimp-image-get-active-layer image))))"
              f' (file-psd-save RUN-NONINTERACTIVE image layer "{out}" "{out}" 0 0))')
    subprocess.run(["gimp", "-i", "-d", "-f", "-b", script, "-b", "(gimp-quit 0)"], capture_output=True, timeout=120)


def by_krita(source, out):
    subprocess.run(["xvfb-run", "-a", "krita", source, "--export", "--export-filename", out], capture_output=True, timeout=120)


class LayersJudge(Layered):
    def opened(self, file):
        self.good("new", file, "--out", self.path("opened.json"), "--force")
        self.good("render", self.path("opened.json"), "--out", self.path("opened.png"), "--force")
        return premultiplied(Image.open(self.path("opened.png")))

    def judge(self, name, write, kinds):
        for seed in (1, 2, random.randrange(1 << 30)):
            rng = random.Random(seed)
            scene = self.scene(rng, rng.randint(2, 5))
            scene.pop("background", None)
            whole, _ = self.written(scene)
            self.good("export", self.path("scene.json"), "--format", "ora", "--out", self.path("layers.ora"), "--force")
            for kind in kinds:
                out = self.path(f"{name}.{kind}")
                write(self.path("layers." + kind), out)
                self.assertTrue(os.path.exists(out), f"{name} wrote no {kind}")
                seen = self.opened(out)
                if kind == "psd":
                    color, _, alpha = composite(PSDImage.open(out), force=True)
                    wanted = 255 * numpy.dstack([color * alpha, alpha])
                    difference = numpy.abs(numpy.rint(seen) - numpy.rint(wanted)).max()
                    print(f"{name}, seed {seed}: our picture of its {kind} and psd-tools': {difference:.0f}/255")
                    self.assertLessEqual(difference, 2, (seed, kind))
                difference = numpy.abs(seen - premultiplied(whole)).max()
                print(f"{name}, seed {seed}: our picture before and after, by {kind}: {difference:.1f}/255")
                self.assertLessEqual(difference, 2, (seed, kind))

    def test_gimp(self):
        self.judge("gimp", by_gimp, ["psd"])  # its OpenRaster plug-in needs Python 2, which Debian no longer has

    def test_krita(self):
        self.judge("krita", by_krita, ["psd", "ora"])


if __name__ == "__main__":
    names = ["LayersJudge.test_gimp", "LayersJudge.test_krita"]
    unittest.main(argv=[sys.argv[0], *(sys.argv[3:] or names)], verbosity=2)
