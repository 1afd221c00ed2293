# An independent check of rendered pictures. The commands map and inverse map marked points of a scene
# one by one. From their images, numpy computes how large the picture's opaque part is, where the marks
# are in the picture and what color it has there. No drawing code is involved.
import csv
import functools
import io
import json
import os

import numpy
from PIL import Image

# The color maps at nine equally spaced positions: viridis, and RdBu of ColorBrewer from blue to red.
VIRIDIS = ("440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5ec962", "addc30", "fde725")
BLUE_RED = ("2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7", "fddbc7", "f4a582", "d6604d", "b2182b")
CELL, DARK, BRIGHT = 16, (70, 90, 120), (235, 235, 235)  # the checker, in pixels of the source
MARKS = 3000  # approximate number in the box around the cage


def premultiplied(picture):
    """Rows of RGBA from 0 to 255, with the colors multiplied by alpha."""
    pixels = numpy.asarray(picture.convert("RGBA")).astype(float)
    pixels[..., :3] *= pixels[..., 3:] / 255
    return pixels


def sampled(pixels, x, y):
    """Bilinear samples. x points right and y down; the centers of pixels are at half-integers."""
    height, width = pixels.shape[:2]
    x, y = numpy.clip(x - 0.5, 0, width - 1.001), numpy.clip(y - 0.5, 0, height - 1.001)
    column, row = x.astype(int), y.astype(int)
    right, down = (x - column)[:, None], (y - row)[:, None]
    upper = (1 - right) * pixels[row, column] + right * pixels[row, column + 1]
    lower = (1 - right) * pixels[row + 1, column] + right * pixels[row + 1, column + 1]
    return (1 - down) * upper + down * lower


def colors_of(position, anchors):
    """The colors at positions from 0 to 1 on a scale, opaque."""
    anchors = numpy.array([list(bytes.fromhex(anchor)) for anchor in anchors], float)
    at = numpy.linspace(0, 1, len(anchors))
    rgb = [numpy.interp(position, at, anchors[:, channel]) for channel in range(3)]
    return numpy.stack(rgb + [numpy.full(len(position), 255.0)], axis=1)


def checker(z):
    """The checker at rest points."""
    bright = (numpy.floor(z.real / CELL) + numpy.floor(z.imag / CELL)) % 2 == 1
    return numpy.where(bright[:, None], BRIGHT + (255,), DARK + (255,)).astype(float)


def shifted(grid, reach):
    """Copies of a grid, shifted by up to `reach` rows and columns in all directions."""
    steps = range(-reach, reach + 1)
    return numpy.array([numpy.roll(grid, (down, right), (0, 1)) for down in steps for right in steps])


class Marks:
    """Points on a slanted grid inside the cage of a scene, and their images."""

    def __init__(self, case, path, *when):
        scene = json.load(open(path))
        self.ask = lambda command, points: self.table(case, command, path, points, when)
        self.source = Image.open(os.path.join(os.path.dirname(path), scene["image"]["file"]))
        cage = numpy.array([complex(*z) for segment in scene["cage"]["rest"] for z in segment])
        # Slanted, so that the sides of the cage cross its rows and columns at varying fractions of
        # a cell.
        turn = numpy.exp(0.6j)
        box = cage / turn
        left, bottom = box.real.min(), box.imag.min()
        width, height = box.real.max() - left, box.imag.max() - bottom
        self.step = (width * height / MARKS) ** 0.5
        columns, rows = (int(length / self.step) + 3 for length in (width, height))
        x, y = left + self.step * numpy.arange(-1, columns), bottom + self.step * numpy.arange(-1, rows)
        grid = turn * (x[None, :] + 1j * y[:, None])
        mapped = self.ask("map", grid.ravel())
        inside = numpy.isfinite(mapped[:, 0])
        self.inside = inside.reshape(grid.shape)
        self.z = grid.ravel()[inside]
        self.f, self.fz, self.fzbar = (mapped[inside, k] + 1j * mapped[inside, k + 1] for k in (0, 2, 4))
        # The number of points in the cage that share each image.
        self.count = numpy.maximum(self.ask("inverse", self.f)[:, 3], 1)
        self.most, self.least = abs(self.fz) + abs(self.fzbar), abs(self.fz) - abs(self.fzbar)

    @staticmethod
    def table(case, command, path, points, when):
        text = "".join("%r,%r\n" % (z.real, z.imag) for z in points.tolist())
        answer = case.good(command, path, "--points", "-", *when, input=text).stdout
        header, *rows = csv.reader(io.StringIO(answer))
        return numpy.array([[float(x) for x in row] for row in rows]).reshape(-1, len(header))

    @functools.cache
    def small(self, scale):
        """The source, averaged over areas as large as a picture's pixels at this scale."""
        size = [round(length * scale) for length in self.source.size]
        channels = numpy.moveaxis(premultiplied(self.source).astype(numpy.float32), 2, 0)
        return numpy.stack([Image.fromarray(channel).resize(size, Image.BOX) for channel in channels], axis=2)

    def colors(self, view, scale, z=None):
        """The colors that this view should have at the marks or, for the view `image`, at rest points z."""
        if view == "image":
            z, small, (width, height) = self.z if z is None else z, self.small(scale), self.source.size
            return sampled(small, z.real * small.shape[1] / width, (height - z.imag) * small.shape[0] / height)
        if view == "checker":
            return checker(self.z)
        if view == "angle":
            return colors_of(abs(self.fzbar) / abs(self.fz), VIRIDIS)
        if view == "area":
            return colors_of((numpy.log2(self.most * self.least) + 2) / 4, BLUE_RED)
        return colors_of(numpy.log2(numpy.maximum(self.most, 1 / self.least)) / 2, VIRIDIS)

    def complaints(self, picture, corner, view, scale):
        """What is wrong with a picture whose lower left corner is at this point of the plane."""
        pixels, wanted = premultiplied(picture), self.colors(view, scale)
        x, y = (self.f.real - corner.real) * scale, len(pixels) - (self.f.imag - corner.imag) * scale
        found = self.area_complaints(pixels, wanted, scale) + self.place_complaints(pixels, wanted, x, y)
        if view == "checker":
            return found + self.checker_complaints(pixels, corner, scale)
        return found + self.color_complaints(pixels, wanted, x, y, view, scale)

    def area_complaints(self, pixels, wanted, scale):
        """The opaque area is the integral of opacity times the Jacobian determinant."""
        opaque = wanted[:, 3] / 255 * self.most * self.least * (self.step * scale) ** 2
        areas = numpy.zeros(self.inside.shape)
        areas[self.inside] = opaque / self.count
        # The area of a grid cell that the boundary crosses at random has a root-mean-square error of
        # 0.29 of the cell: a uniform distribution between -1/2 and 1/2. Such a cell differs from a
        # neighbor.
        around = numpy.array([numpy.roll(areas, by, (0, 1)) for by in ((0, 0), (0, 1), (1, 0), (1, 1))])
        error = 5 * 0.29 * (numpy.ptp(around, axis=0) ** 2).sum() ** 0.5
        # Where the picture overlaps itself, the upper part hides none, some or all of the opaque
        # part below.
        least, most, found = areas.sum() - error, opaque.sum() + error, pixels[..., 3].sum() / 255
        return [] if least <= found <= most else [f"area: {found:.0f} pixels, not {least:.0f} to {most:.0f}"]

    def place_complaints(self, pixels, wanted, x, y):
        """The marks fit the picture better than they would one pixel away in any direction."""
        misfits = {(right, down): abs(sampled(pixels, x + right, y + down) - wanted).mean()
                   for right in (-1, 0, 1) for down in (-1, 0, 1)}
        best = min(misfits, key=misfits.get)
        return [] if best == (0, 0) else [f"place: the marks fit better when moved by {best}"]

    def color_complaints(self, pixels, wanted, x, y, view, scale):
        """The colors are right at marks that are well inside, shown once and moderately stretched."""
        surrounded = shifted(self.inside, 1).all(axis=0)[self.inside]
        inner = surrounded & (self.count == 1) & (self.least > 0.6) & (self.most < 1.7)
        off = (sampled(pixels, x, y) - wanted)[inner]
        # Half a level for the rounding of pixels, and half for the interpolation between them. The color
        # maps bend at their anchors, so a few marks may be off by more.
        tolerance = numpy.full(off.shape, 1.0)
        if view == "image":
            # The picture and the expected colors are means of the source over at most 1.5 pixels to
            # each side.
            ring = [self.z + 1.5 / scale * numpy.exp(0.25j * numpy.pi * k) for k in range(8)]
            around = numpy.array([self.colors(view, scale, z) for z in ring])
            tolerance += abs(around - wanted).max(axis=0)[inner]
        wrong = (abs(off) > tolerance).any(axis=1).mean()
        # Averaging does not change the mean color. Allow five standard errors and half a level of
        # rounding.
        tint, error = off.mean(axis=0), off.std(axis=0) / len(off) ** 0.5
        return (([f"color: {100 * wrong:.1f} % of {len(off)} marks are wrong"] if wrong > 0.1 else [])
                + ([f"color: tinted by {tint.round(2)}"] if (abs(tint) > 0.5 + 5 * error).any() else []))

    def checker_complaints(self, pixels, corner, scale):
        """Pixels inside a cell have its color. Looks at every third pixel, because inverses take long."""
        row, column = (index[::3] for index in numpy.nonzero((shifted(pixels[..., 3], 1) == 255).all(axis=0)))
        centers = corner + (column + 0.5 + 1j * (len(pixels) - row - 0.5)) / scale
        answer = self.ask("inverse", centers)
        z, once = answer[:, 0] + 1j * answer[:, 1], answer[:, 3] == 1
        # Where the picture shrinks to 0.6, a pixel reaches 0.5 * sqrt(2) / (0.6 * scale) pixels of the
        # source to each side of its center.
        reach = 0.5 * 2 ** 0.5 / (0.6 * scale)
        within = [numpy.minimum(x % CELL, CELL - x % CELL) > reach for x in (z.real, z.imag)]
        deep = once & within[0] & within[1]
        off = abs(pixels[row, column] - checker(z))[deep].max(axis=1)
        return [] if deep.sum() > 1000 and (off <= 1).mean() > 0.99 else [
            f"color: {(off > 1).sum()} of {deep.sum()} pixels inside cells are wrong"]
