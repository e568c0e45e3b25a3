# SPDX-License-Identifier: BSD-3-Clause
"""Splitting triangles at the middles of their edges, neighbours alike, on whole arrays at a time."""
import numpy as np


def row_keys(*columns):
    """A 64-bit number for each row of these columns: the same for rows with the same bits."""
    keys = np.full(len(columns[0]), 0x9E3779B97F4A7C15, dtype=np.uint64)
    multiplier = np.uint64(0xBF58476D1CE4E5B9)
    for column in columns:
        bits = np.ascontiguousarray(column + 0.0 if column.dtype.kind == "f" else column)
        keys ^= bits.astype(np.float64 if bits.dtype.kind == "f" else np.int64).view(np.uint64)
        keys *= multiplier
        keys ^= keys >> np.uint64(29)
    return keys


def divide(corners, wanted, largest, rounds=14):
    """Splits triangles at the middles of edges until no edge is to be divided.

    corners: (T, 3, k), the first three columns positions; everything is interpolated linearly.
    wanted(a, b): whether the edges from a to b are divided; it must be symmetric, so that
    neighbours agree and no gaps appear. Returns the corners and the index of each triangle's
    origin, or None where more than `largest` triangles would come of it.
    """
    origin = np.arange(len(corners))
    done_corners, done_origin, done = [], [], 0
    for _ in range(rounds):
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        marks = np.stack([wanted(a, b), wanted(b, c), wanted(c, a)], axis=1)
        number = marks.sum(axis=1)
        still = number == 0
        done_corners.append(corners[still])
        done_origin.append(origin[still])
        done += int(still.sum())
        if still.all():
            break
        if done + 2 * int((~still).sum()) > largest:
            return None
        pieces, sources = [], []

        def add(chosen, *triangles):
            for triangle in triangles:
                pieces.append(np.stack(triangle, axis=1))
                sources.append(origin[chosen])

        for first in range(3):  # one marked edge, from `first` to the next corner
            chosen = np.flatnonzero((number == 1) & marks[:, first])
            p, q, r = (corners[chosen, (first + k) % 3] for k in range(3))
            middle = 0.5 * (p + q)
            add(chosen, (p, middle, r), (middle, q, r))
            # two marked edges, the unmarked one ends at `first`
            chosen = np.flatnonzero((number == 2) & ~marks[:, (first + 2) % 3])
            p, q, r = (corners[chosen, (first + k) % 3] for k in range(3))
            pq, qr = 0.5 * (p + q), 0.5 * (q + r)
            add(chosen, (pq, q, qr), (p, pq, qr), (p, qr, r))
        chosen = np.flatnonzero(number == 3)
        p, q, r = (corners[chosen, k] for k in range(3))
        pq, qr, rp = 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)
        add(chosen, (p, pq, rp), (pq, q, qr), (rp, qr, r), (pq, qr, rp))
        corners, origin = np.concatenate(pieces), np.concatenate(sources)
    else:
        done_corners.append(corners)
        done_origin.append(origin)
    return np.concatenate(done_corners), np.concatenate(done_origin)
