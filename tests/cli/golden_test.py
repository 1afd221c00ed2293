# Golden pictures: renders of the samples equal the stored pictures, which are also checked independently.
import os
import re
import shutil
import sys

import numpy
from PIL import Image

from case import PROGRAM, SOURCE, Case, soak, timed
from golden import Marks
from old_samples import old_sample
from seeds import SOAKS

SAMPLES = ["giraffe", "gecko", "sunflower", "fish", "octopus", "snake", "heart", "tiger", "fern"]


def corner_of(said):
    """The lower left corner of a rendered picture, from the command's message."""
    x, y = re.search(r"lower left corner at \((\S+), (\S+)\)", said).groups()
    return complex(float(x), float(y))


class GoldenPictures(Case):
    def marks(self, *words):
        """The independent check of a golden picture. It takes seconds, and is due when the picture changes."""
        return Marks(self, *words) if SOAKS or os.environ.get("HOLOMORPH_UPDATE_GOLDEN") else None

    def test_samples_look_like_their_golden_pictures(self):
        for name in SAMPLES:
            scene = os.path.join(SOURCE, "assets", name + ".json")
            marks = self.marks(scene)
            for view in ("image", "angle", "area", "stretch", "checker"):
                if view in ("angle", "checker") and name != "gecko":
                    continue
                self.compare(f"{name}-{view}", scene, marks, view)
        # At a time between two keyframes.
        scene = os.path.join(SOURCE, "assets/fern.json")
        marks = self.marks(scene, "--time", 1.3)
        self.compare("fern-between", scene, marks, "image", "--time", 1.3)

    def test_samples_of_earlier_releases_look_as_they_did(self):
        """The golden pictures are those of these releases. They are never drawn again."""
        for name in ("giraffe", "gecko", "octopus", "harmonic-giraffe", "harmonic-gecko", "harmonic-octopus"):
            scene = old_sample(name)
            marks = self.marks(scene)
            for view in ("image", "area", "stretch"):
                self.compare(f"old-{name}-{view}", scene, marks, view, renews=False)

    def compare(self, title, scene, marks, view, *when, renews=True):
        """The picture matches its golden picture, which passes the checks of golden.py."""
        out = self.path(title + ".png")
        said = self.good("render", scene, "--out", out, "--scale", 0.3, "--view", view, *when).stderr
        golden = os.path.join(SOURCE, "tests/golden", title + ".png")
        if renews and os.environ.get("HOLOMORPH_UPDATE_GOLDEN"):
            shutil.copy(out, golden)
        a, b = (numpy.asarray(Image.open(p).convert("RGBA")).astype(int) for p in (out, golden))
        self.assertEqual(a.shape, b.shape, golden)
        difference = numpy.abs(a - b).max(axis=2)
        if difference.mean() > 0.3 or (difference > 40).mean() > 0.002:
            kept = os.path.join(os.path.dirname(PROGRAM), "golden-failures")
            os.makedirs(kept, exist_ok=True)
            shutil.copy(out, kept)
            Image.fromarray(numpy.clip(difference * 4, 0, 255).astype("uint8")).save(os.path.join(kept, title + "-difference.png"))
            self.fail(f"{title} differs from its golden picture; see {kept}")
        if marks:
            self.assertEqual(marks.complaints(Image.open(golden), corner_of(said), view, 0.3), [], title)

    @soak
    def test_the_checks_notice_wrong_pictures(self):
        scene = os.path.join(SOURCE, "assets/gecko.json")
        marks, out = Marks(self, scene), self.path("gecko.png")
        for view in ("image", "area", "checker"):
            corner = corner_of(self.good("render", scene, "--out", out, "--scale", 0.3, "--view", view).stderr)
            pixels = numpy.asarray(Image.open(out).convert("RGBA"))
            wrong = {"place": [numpy.roll(pixels, by, axis) for by in (3, -3) for axis in (0, 1)],
                     "color": [(pixels * factors).astype("uint8") for factors in numpy.diag([-0.06] * 4)[:3] + 1],
                     "area": [(pixels * [1, 1, 1, 0.9]).astype("uint8")]}
            for kind, pictures in wrong.items():
                for picture in pictures:
                    found = marks.complaints(Image.fromarray(picture), corner, view, 0.3)
                    self.assertIn(kind, [complaint.split(":")[0] for complaint in found], (view, found))


if __name__ == "__main__":
    timed.main(sys.argv[3:])
