#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of docs/physics/shading.md from the formulas that stand there.

    /usr/bin/python3 benchmarks/figures_shading.py

Writes docs/images/shading-highlights.png and shading-reflectance.png.
"""
import os

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

IMAGES = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "docs", "images")
BLINN, PHONG, PHYSICAL = "#2471a3", "#c0392b", "#1e8449"


def spherical(theta, phi):
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi),
                     np.cos(theta) + 0 * phi], -1)


def phong(light, view, n):
    mirrored = light * np.array([-1, -1, 1])
    return np.maximum((mirrored * view).sum(-1), 0) ** n


def blinn(light, view, n):
    half = light + view
    half = half / np.linalg.norm(half, axis=-1)[..., None]
    return np.maximum(half[..., 2], 0) ** n


def hemisphere(steps):
    """Directions and projected solid angles, equal in cos^2: midpoints."""
    c = np.sqrt((np.arange(steps) + 0.5) / steps)
    phi = 2 * np.pi * (np.arange(2 * steps) + 0.5) / (2 * steps)
    theta, phi = np.meshgrid(np.arccos(c), phi, indexing="ij")
    return spherical(theta, phi), np.pi / theta.size


def beside_the_mirror(axis):
    """In the plane of incidence: the angle of the view from the mirror direction."""
    angle = np.radians(np.linspace(-90, 90, 721))
    incidence = np.radians(40)
    light = spherical(incidence, np.array(0.0))
    theta = incidence + angle
    view = np.stack([-np.sin(theta), 0 * theta, np.cos(theta)], -1)
    seen = np.cos(theta) > 0
    for n, style in ((10, "-"), (40, "--")):
        axis.plot(np.degrees(angle)[seen], blinn(light, view, n)[seen], style, color=BLINN,
                  label=f"Blinn (N·H)$^{{{n}}}$")
        axis.plot(np.degrees(angle)[seen], phong(light, view, n)[seen], style, color=PHONG,
                  label=f"Phong (R·V)$^{{{n}}}$")
    axis.set_title("In the plane of incidence, light at 40°", fontsize=10)
    axis.set_xlabel("view from the mirror direction (degrees)")
    axis.set_ylabel("highlight, its peak 1")
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)


def shapes(axis, model, n, title):
    """What a viewer sees around the hemisphere, for light at 60 degrees."""
    x, y = np.meshgrid(np.linspace(-1, 1, 401), np.linspace(-1, 1, 401))
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    inside = x * x + y * y < 1
    light = spherical(np.radians(60), np.array(0.0))
    value = np.where(inside, model(light, np.stack([x, y, z], -1), n), np.nan)
    levels = [0.05, 0.1, 0.25, 0.5, 0.75, 0.9]
    lines = axis.contour(x, y, value, levels, cmap="viridis", linewidths=1.2)
    axis.clabel(lines, fontsize=7)
    axis.add_patch(plt.Circle((0, 0), 1, fill=False, color="black", lw=1))
    axis.plot(light[0], light[1], "*", color="#d68910", ms=11)
    axis.plot(-light[0], light[1], "x", color="black", ms=7)
    axis.set_aspect("equal")
    axis.set_axis_off()
    axis.set_title(title, fontsize=10)


def highlights():
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.6),
                                gridspec_kw={"width_ratios": [1.5, 1, 1]},
                                constrained_layout=True)
    beside_the_mirror(axes[0])
    shapes(axes[1], blinn, 40, "Blinn, n = 40: the hemisphere from above,\nlight (star) at 60°")
    shapes(axes[2], phong, 10, "Phong, n = 10: the same width near\nthe mirror direction (cross)")
    figure.savefig(os.path.join(IMAGES, "shading-highlights.png"), dpi=110)
    plt.close(figure)


def reflectance():
    directions, weight = hemisphere(600)
    degrees = np.concatenate([np.arange(0, 80, 2.0), np.arange(80, 89.6, 0.5)])
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.3), sharey=True)
    for axis, n in ((axes[0], 5), (axes[1], 30)):
        for name, color in (("Blinn", BLINN), ("Phong", PHONG), ("energy-conserving", PHYSICAL)):
            values = []
            for d in degrees:
                light = spherical(np.radians(d), np.array(0.0))
                lobe = (blinn if name == "Blinn" else phong)(light, directions, n)
                scale = (n + 2) / (2 * np.pi) if name == "energy-conserving" else \
                    1 / (np.pi * np.cos(np.radians(d)))
                values.append(scale * (lobe * weight).sum())
            axis.semilogy(degrees, values, color=color, label=name)
        axis.axhline(1, color="black", lw=0.8, ls=":")
        axis.set_ylim(0.05, 10)
        axis.set_title(f"highlight alone, k_s = ρ_s = 1, n = {n}", fontsize=10)
        axis.set_xlabel("angle of the light from the normal (degrees)")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set_ylabel("reflected / received power")
    axes[0].text(2, 1.08, "all the power there is", fontsize=8)
    figure.tight_layout()
    figure.savefig(os.path.join(IMAGES, "shading-reflectance.png"), dpi=110)
    plt.close(figure)


if __name__ == "__main__":
    highlights()
    reflectance()
