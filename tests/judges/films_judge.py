# melt draws frames through the frei0r filter, each with the bits of `render`. Times start where a clip starts.
import os
import random
import shutil
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

PROGRAM, SOURCE = sys.argv[1:3]
FILTER = os.path.join(os.path.dirname(PROGRAM), "frei0r-1")
sys.argv = [sys.argv[0], PROGRAM, SOURCE, FILTER]
sys.path.append(os.path.join(SOURCE, "tests/frei0r"))
from frei0r_test import Frei0r  # noqa: E402

FRAMES = 100


def profile(folder, width, height):
    path = os.path.join(folder, "profile")
    with open(path, "w") as file:
        file.write(f"description=judge\nframe_rate_num=25\nframe_rate_den=1\nwidth={width}\nheight={height}\nprogressive=1\n"
                   f"sample_aspect_num=1\nsample_aspect_den=1\ndisplay_aspect_num={width}\ndisplay_aspect_den={height}\n"
                   "colorspace=709\n")
    return path


def melted(folder, size, scene, first, last):
    """The frames of a clip from frame `first` of a picture."""
    out = tempfile.mkdtemp(dir=folder)
    subprocess.run(["melt", "-profile", profile(folder, *size), os.path.join(folder, "0.png"), f"in={first}", f"out={last}",
                    "-attach", "frei0r.holomorph", "Scene=" + scene, "Mode=0", "-consumer", f"avformat:{out}/%05d.png",
                    "vcodec=png", "pix_fmt=rgba", "mlt_image_format=rgba", "an=1", "real_time=-1", "progressive=1"],
                   check=True, env=dict(os.environ, FREI0R_PATH=FILTER), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return [numpy.asarray(Image.open(os.path.join(out, name)).convert("RGBA")) for name in sorted(os.listdir(out))]


def judge(size):
    seed = random.randrange(1 << 30)
    case = Frei0r("test_parameters_are_listed_and_can_be_read_back")
    case.setUp()
    scene = case.scene(random.Random(seed), size, layers=2)
    expected = case.rendered(scene, 0, FRAMES - 1)
    same = 0
    for first in (0, FRAMES // 2):
        frames = melted(case.folder, size, scene, first, FRAMES - 1)
        assert len(frames) == FRAMES - first, len(frames)
        same += sum((a == b).all() for a, b in zip(frames, expected))
    case.tearDown()
    print(f"melt, {size[0]} x {size[1]}, seed {seed}: {same} of {FRAMES + FRAMES // 2} frames have the bits of render")
    return same == FRAMES + FRAMES // 2


if __name__ == "__main__":
    if not shutil.which("melt"):
        sys.exit("melt is not installed")
    sys.exit(0 if all([judge(size) for size in ((1280, 720), (322, 242))]) else 1)
