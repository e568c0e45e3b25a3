# SPDX-License-Identifier: BSD-3-Clause
"""What the cells of the Cornell box really get: light paths of Mitsuba 3 until their standard error is
small, in batches of their own seeds, and vtkRadiosityFilter at a tight tolerance to see that two
programs which share nothing but the scene agree within their errors."""
import time

import numpy as np

BATCHES = 16


def by_particles(mitsuba, box, seconds):
    """Mean of the batches, its standard error, and the particles that it took."""
    mitsuba.build(box)
    count = 1 << 18
    mitsuba.estimate(box, count, 0)
    begin = time.monotonic()
    mitsuba.estimate(box, count, 1)
    each = time.monotonic() - begin
    doublings = max(0, int(np.log2(max(1.0, seconds / (BATCHES * each)))))
    count <<= min(doublings, 6)
    rounds = max(1, int(seconds / (BATCHES * each * 2**doublings)))
    batches = np.array([np.mean([mitsuba.estimate(box, count, 7919 + BATCHES * r + b)
                                 for r in range(rounds)], 0) for b in range(BATCHES)])
    return batches.mean(0), batches.std(0, ddof=1) / np.sqrt(BATCHES), count * BATCHES * rounds


def agreement(reference, spread, values, error):
    """How two answers differ, as shares of what their errors allow."""
    lit = reference > 0.01 * reference.max(0)
    relative = (values / np.maximum(reference, 1e-300) - 1.0)[lit]
    noise = (spread / np.maximum(reference, 1e-300))[lit]
    return {"rmsDifference": float(np.sqrt((relative**2).mean())),
            "rmsStandardErrorOfReference": float(np.sqrt((noise**2).mean())),
            "meanDifference": float(relative.mean()),
            "covered": float((np.abs(values - reference) <= np.hypot(error, 2 * spread)).mean())}
