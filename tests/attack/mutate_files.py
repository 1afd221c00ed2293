#!/usr/bin/env python3
"""Pictures, films, drawings, surfaces and tables with changed bytes: an answer within 20 s and 1 GB, also of the programs that are started."""
import io
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile
import zlib

import numpy
from PIL import Image

import attack

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../support"))
import psd_writer  # noqa: E402

options = attack.arguments(__doc__, runs=attack.few_or_many(40, 300), keep="")
MOST_SECONDS, MOST_MEGABYTES = 20, 1024
WORDS = [0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0x8000, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 16384, 65537]
TEXTS = ["1e308", "-1e308", "nan", "1e-300", "0", "-1", "2147483648", "9" * 400, "", "url(#a)", "100%", "&#0;", "<svg>", "data:,", "file:///etc/passwd"]
TEXT_FORMATS = (".svg", ".obj", ".csv", ".xml")
rng = random.Random(options.seed)
folder = tempfile.mkdtemp(prefix="mutate-files-")


def place(name):
    return os.path.join(folder, name)


def picture(mode="RGBA"):
    """A disc on a transparent ground, with noise."""
    y, x = numpy.mgrid[0:48, 0:64]
    pixels = numpy.random.default_rng(rng.randrange(1 << 30)).integers(0, 256, (48, 64, 4)).astype(numpy.uint8)
    pixels[..., 3] = 255 * (numpy.hypot(x - 32, y - 24) < 20)
    return Image.fromarray(pixels, "RGBA").convert(mode)


def bytes_of(image, kind, **how):
    out = io.BytesIO()
    image.save(out, kind, **how)
    return out.getvalue()


def made_by(*command):
    """The content of a file that a program makes; the last word is its name."""
    subprocess.run([*command], cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(place(command[-1]), "rb") as file:
        return file.read()


def seeds():
    """A whole file of each kind that can be opened, by its extension."""
    with open(place("p.png"), "wb") as file:
        file.write(bytes_of(picture(), "PNG"))
    made_by(options.program, "new", "p.png", "--out", "p.json")
    with open(place("p.csv"), "wb") as file:
        file.write(b"x,y\n10,20\n30.5,-4e1\n7,8\n")
    drawing = b"""<svg xmlns="http://www.w3.org/2000/svg" width="64" height="48" viewBox="0 0 64 48"><defs><linearGradient id="a">
<stop offset="0" stop-color="#f80"/><stop offset="1" stop-color="#08f"/></linearGradient><filter id="b"><feGaussianBlur stdDeviation="2"/></filter>
<clipPath id="c"><circle cx="30" cy="24" r="20"/></clipPath></defs><g transform="rotate(10 32 24) scale(1.1)" clip-path="url(#c)">
<path id="rest" d="M10 10L50 12C60 20 58 40 40 42Q20 44 10 30A8 8 0 0 1 10 10Z" fill="url(#a)" filter="url(#b)"/></g>
<use href="#rest" x="5" opacity=".5"/><text x="10" y="40" font-size="9">leaf</text></svg>"""
    def layered(depth, packing):
        planes = [numpy.asarray(picture()).astype(int)[..., k] * (257 if depth == 16 else 1) for k in (3, 0, 1, 2)]
        layers = [(name, rng.randrange(-9, 9), rng.randrange(-9, 9), planes) for name in ("low", "high")]
        return psd_writer.psd(64, 48, psd_writer.RGB, depth, packing, planes[1:], layers)

    frames = [picture() for _ in range(3)]
    surface = b"v 0 0 0\nv 9 0 1\nv 9 9 0\nv 0 9 2\nv 4 4 3\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\n" \
              b"f 1/1 2/2 5/5\nf 2/2 3/3 5/5\nf 3/3 4/4 5/5\nf 4/4 1/1 5/5\n"
    return {
        ".png": [bytes_of(picture(mode), "PNG") for mode in ("RGBA", "RGB", "L", "P")],
        ".jpg": [bytes_of(picture("RGB"), "JPEG"), bytes_of(picture("RGB"), "JPEG", progressive=True), bytes_of(picture("CMYK"), "JPEG")],
        ".gif": [bytes_of(frames[0], "GIF", save_all=True, append_images=frames[1:])],
        ".webp": [bytes_of(picture(), "WEBP"), bytes_of(frames[0], "WEBP", save_all=True, append_images=frames[1:], lossless=True)],
        ".tif": [bytes_of(picture(mode), "TIFF", compression=how) for mode in ("RGBA", "L") for how in (None, "tiff_lzw", "tiff_adobe_deflate")],
        ".bmp": [bytes_of(picture("RGB"), "BMP"), bytes_of(picture("P"), "BMP")],
        ".tga": [bytes_of(picture(), "TGA"), bytes_of(picture("RGB"), "TGA", rle=True)],
        ".psd": [*[layered(depth, packing) for depth in (8, 16) for packing in range(4)], made_by(options.program, "export", "p.json", "--format", "psd", "--out", "p.psd")],
        ".ora": [made_by(options.program, "export", "p.json", "--format", "ora", "--out", "p.ora")],
        ".exr": [made_by(options.program, "render", "p.json", "--out", "p.exr"),
                 made_by(options.program, "export", "p.json", "--format", "stmap", "--out", "st.exr")],
        ".svg": [drawing],
        ".obj": [surface],
        ".csv": [b"x,y\n10,20\n30.5,-4e1\n7,8\n", b"\xef\xbb\xbfx;y\r\n1,5;2,5\r\n\"3\";4\r\n"],
        ".mp4": [made_by("ffmpeg", "-f", "lavfi", "-i", "testsrc=size=64x48:rate=10:duration=1", "-pix_fmt", "yuv420p", "f.mp4")],
        ".webm": [made_by("ffmpeg", "-f", "lavfi", "-i", "testsrc=size=64x48:rate=10:duration=1", "-pix_fmt", "yuv420p", "f.webm")],
    }


def with_changed_bytes(data):
    """A few bytes of binary data are replaced, removed, repeated or cut off."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5])):
        at = rng.randrange(min(len(data), rng.choice([64, 512, len(data)]))) if data else 0
        kind = rng.random()
        if kind < 0.45:
            size = rng.choice([1, 2, 4])
            order = rng.choice("<>") + {1: "B", 2: "H", 4: "I"}[size]
            data[at:at + size] = struct.pack(order, rng.choice(WORDS) & (1 << 8 * size) - 1)
        elif kind < 0.65:
            data[at:at + 1] = bytes([rng.randrange(256)])
        elif kind < 0.75:
            del data[at:at + rng.choice([1, 4, 30, len(data) // 3])]
        elif kind < 0.85:
            part = data[at:at + rng.choice([1, 8, 200])]
            data[at:at] = part * rng.choice([1, 2, 300])
        elif kind < 0.92:
            data[at:at] = bytes(rng.choice([1, 4, 4096]))
        else:
            del data[at:]
    return bytes(data)


def with_changed_text(data):
    """Numbers, names and elements of a text are replaced, removed or repeated."""
    text = data.decode(errors="replace")
    for _ in range(rng.choice([1, 1, 2, 4])):
        parts = list(re.finditer(rng.choice([r"-?[\d.]+", r'"[^"]*"', r"<[^>]*>", r"\w+", r"\n[^\n]*"]), text))
        if not parts:
            continue
        part = rng.choice(parts)
        new = rng.choice([rng.choice(TEXTS), rng.choice(parts)[0], part[0] * rng.choice([2, 50, 3000]), ""])
        if part[0].startswith('"') and new[:1] != '"':
            new = f'"{new}"'
        text = text[:part.start()] + new + text[part.end():]
    return text.encode(rng.choice(["utf-8", "utf-8", "utf-16"]), errors="replace")


def with_right_checks(data):
    """A PNG whose chunks have the right sums, so that decoders read on."""
    out, at = bytearray(data[:8]), 8
    while at + 8 <= len(data):
        length = struct.unpack_from(">I", data, at)[0]
        kind, content = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        out += data[at:at + 8] + content + struct.pack(">I", zlib.crc32(kind + content))
        at += 12 + length
    return bytes(out)


def with_changed_member(data):
    """One file of an archive is changed, and the archive is whole."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as source, zipfile.ZipFile(out, "w") as to:
        names = source.namelist()
        chosen = rng.choice([name for name in names if name != "mimetype"])
        for name in names:
            content = source.read(name)
            if name == chosen:
                content = changed(content, os.path.splitext(name)[1])
            to.writestr(name, content, rng.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED]))
    return out.getvalue()


def changed(data, extension):
    if extension in TEXT_FORMATS:
        return with_changed_text(data)
    if extension == ".ora" and rng.random() < 0.7:
        return with_changed_member(data)
    new = with_changed_bytes(data)
    return with_right_checks(new) if extension == ".png" and rng.random() < 0.7 else new


def commands(name, extension):
    """What reads the file."""
    if extension == ".csv":
        return [["map", "p.json", "--points", name]]
    if extension == ".obj":
        return [["new", "p.png", "--outline", name, "--out", "o.json", "--force"]]
    opens = ["new", name, "--out", "o.json", "--force"]
    draws = ["render", "o.json", "--scale", "0.5", "--out", "o.png"]
    if extension == ".svg" and rng.random() < 0.3:
        return [["new", "p.png", rng.choice(["--cage", "--outline"]), name, "--out", "o.json", "--force"]]
    return [opens, draws if extension != ".svg" else ["export", "o.json", "--format", "drawing", "--out", "o.svg"]]


files = seeds()
tally = attack.Tally(MOST_SECONDS, MOST_MEGABYTES)
for number in range(options.runs):
    extension = sorted(files)[number % len(files)]
    name = "m" + extension
    with open(place(name), "wb") as file:
        file.write(changed(rng.choice(files[extension]), extension))
    for words in commands(name, extension):
        outcome = attack.run([options.program, *words], folder, MOST_SECONDS)
        if tally.add(f"file {number}, {' '.join(words)}", outcome) and options.keep:
            os.makedirs(options.keep, exist_ok=True)
            shutil.copy(place(name), os.path.join(options.keep, f"{options.seed}-{number}{extension}"))
        if outcome.status:
            break
shutil.rmtree(folder)
tally.finish("mutate_files", f"seed {options.seed}, {options.runs} files")
