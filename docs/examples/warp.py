"""Bends a grid, a drawing and a picture, and plots the distortion. Usage: warp.py FOLDER

Every part that starts with `# %%` is a cell for editors that show scripts as notebooks.
"""
# %% A cage around a bar, and its pose: the bar bends into an arc.
import os
import re
import sys

import matplotlib.pyplot as plt
import numpy as np

import holomorph

folder = sys.argv[1] if len(sys.argv) > 1 else "."
width, height, sections = 600, 150, 10
along = np.linspace(0, width, sections)
cage = np.concatenate([along, along[::-1] + 1j * height])


def arc(z, angle=2.0):
    """Where the bar's middle line becomes an arc. Lengths across the bar stay."""
    radius = width / angle
    return 1j * radius + (radius - (z.imag - height / 2)) * -1j * np.exp(1j * (z.real - width / 2) / radius)


scene = holomorph.Scene()
scene.set_cage(cage)
scene.pose = arc(cage) + width / 2
info = scene.info()
print("stretches from", info["min_sigma"], "to", info["max_sigma"], "and", info["flipped_triangles"], "flipped triangles")

# %% A grid: rows and columns of points, mapped at once.
x, y = np.meshgrid(np.linspace(2, width - 2, 61), np.linspace(2, height - 2, 16))
bent = scene.map(x + 1j * y)
figure, axes = plt.subplots(figsize=(7, 4))
axes.plot(bent.real, bent.imag, color="steelblue", lw=0.7)
axes.plot(bent.real.T, bent.imag.T, color="steelblue", lw=0.7)
axes.set_aspect("equal")
figure.savefig(os.path.join(folder, "grid.png"), dpi=120)

# %% A drawing: each line of an SVG path is divided, and its points are mapped.
path = "M 40 75 L 160 20 L 220 75 L 160 130 Z M 300 30 L 560 30 L 560 120 L 300 120 Z M 320 75 L 540 75"


def mapped_path(path):
    parts = []
    for part in re.findall(r"M[^M]*", path):
        corners = np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", part), float) @ [1, 1j]
        if "Z" in part:
            corners = np.append(corners, corners[0])
        t = np.linspace(0, 1, 20, endpoint=False)
        points = np.append((corners[:-1, None] + t * np.diff(corners)[:, None]).ravel(), corners[-1])
        z = scene.map(points)
        parts.append("M " + " L ".join(f"{p.real:.2f} {p.imag:.2f}" for p in z))
    return " ".join(parts)


with open(os.path.join(folder, "drawing.svg"), "w") as file:
    file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 0 640 300">'
               f'<path transform="matrix(1 0 0 -1 0 200)" d="{mapped_path(path)}" fill="none" stroke="black"/></svg>\n')

# %% A picture: a scene draws it, and the method `bounded` proves that nothing folds.
image = np.zeros((height, width, 4), np.uint8)
stripes = (np.arange(width) // 20 % 2)[None, :] ^ (np.arange(height) // 20 % 2)[:, None]
image[..., 0], image[..., 1], image[..., 2], image[..., 3] = 230 - 120 * stripes, 150, 60 + 120 * stripes, 255
plt.imsave(os.path.join(folder, "stripes.png"), image)
photograph = holomorph.Scene(os.path.join(folder, "stripes.png"))
photograph.set_cage(cage)
photograph.method = "bounded"
photograph.background = "transparent"  # or else, the picture as it was shows through
photograph.pose = arc(cage) + width / 2
certificate = photograph.certificate()
print("proved" if certificate.proved else "not proved", certificate.shear, certificate.smallest, certificate.largest)
plt.imsave(os.path.join(folder, "photograph.png"), photograph.render())

# %% The distortion: the map's derivatives give how much it stretches, and how far it is from conformal.
fz, fzbar = scene.derivatives(x + 1j * y)
figure, axes = plt.subplots(figsize=(7, 4))
stretch = axes.pcolormesh(bent.real, bent.imag, np.log2(abs(fz) + abs(fzbar)), cmap="RdBu", vmin=-1, vmax=1,
                          shading="gouraud")
figure.colorbar(stretch, label="log2 of the largest stretch")
axes.set_aspect("equal")
axes.set_title(f"abs(f_zbar) is at most {np.nanmax(abs(fzbar)):.1g}")
figure.savefig(os.path.join(folder, "distortion.png"), dpi=120)
