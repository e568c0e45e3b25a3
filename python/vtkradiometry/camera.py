# SPDX-License-Identifier: BSD-3-Clause
"""From where the pictures are taken."""
import math

import numpy as np


class Camera:
    """A view point. `height_angle` is the full vertical angle in degrees for width/height =
    `aspect`; `parallel_height` (metres, full) makes it a parallel projection instead."""

    def __init__(self, position, focal_point, up, height_angle=40.0, aspect=16.0 / 9.0,
                 parallel_height=None, origin="chosen"):
        self.position = np.asarray(position, dtype=float)
        self.focal_point = np.asarray(focal_point, dtype=float)
        self.up = np.asarray(up, dtype=float)
        self.height_angle = height_angle
        self.aspect = aspect
        self.parallel_height = parallel_height
        self.origin = origin  # "scene" or "chosen"

    @classmethod
    def three_quarter(cls, bounds, up=(0.0, 1.0, 0.0), aspect=16.0 / 9.0):
        """A view of everything from outside, above and to one side; near walls are seen through
        where surfaces are one-sided."""
        low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
        centre = 0.5 * (low + high)
        up = np.asarray(up, dtype=float)
        # Two directions across `up`, the longer horizontal side of the box seen broadside.
        axes = np.eye(3)[[i for i in range(3) if abs(up[i]) < 0.5]]
        extents = np.abs(axes @ (high - low))
        across, along = axes[np.argmin(extents)], axes[np.argmax(extents)]
        if np.dot(np.cross(along, up), across) < 0.0:
            across = -across
        direction = 0.80 * across + 0.45 * along + 0.55 * up
        direction /= np.linalg.norm(direction)
        height_angle = 35.0
        camera = cls(centre + direction, centre, up, height_angle, aspect)
        # Far enough for every corner of the box to lie inside the picture with a margin.
        right, above, forward = camera.axes()
        half_height = math.tan(math.radians(0.5 * height_angle)) * 0.92
        half_width = half_height * aspect
        distance = 0.0
        for corner in np.array(np.meshgrid(*zip(low, high))).T.reshape(-1, 3):
            offset = corner - centre
            depth = float(offset @ forward)
            distance = max(distance, abs(float(offset @ right)) / half_width - depth,
                           abs(float(offset @ above)) / half_height - depth)
        camera.position = centre + direction * distance
        return camera

    def axes(self):
        """Unit vectors to the right, up and forward of the picture."""
        forward = self.focal_point - self.position
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, self.up)
        right /= np.linalg.norm(right)
        return right, np.cross(right, forward), forward

    def distance_to(self, point):
        """From the view point, in metres."""
        return float(np.linalg.norm(np.asarray(point) - self.position))

    def half_height(self, aspect):
        """Half the picture's height at distance 1 (or in metres, if parallel), so that nothing
        that the camera shows is cut off at another aspect."""
        half = (0.5 * self.parallel_height if self.parallel_height
                else math.tan(math.radians(0.5 * self.height_angle)))
        return half * max(1.0, self.aspect / aspect)

    def apply(self, renderer, aspect):
        """Sets the renderer's camera for a picture of width/height = `aspect`."""
        camera = renderer.GetActiveCamera()
        camera.SetPosition(*self.position)
        camera.SetFocalPoint(*self.focal_point)
        camera.SetViewUp(*self.up)
        half = self.half_height(aspect)
        if self.parallel_height:
            camera.ParallelProjectionOn()
            camera.SetParallelScale(half)
        else:
            camera.ParallelProjectionOff()
            camera.SetViewAngle(math.degrees(2.0 * math.atan(half)))
        renderer.ResetCameraClippingRange()

    def corner(self, aspect, x, y, share):
        """The place at (x, y) of the picture, each from -1 to 1, as deep as the focal point; and
        the length of `share` of the picture's height there."""
        right, above, forward = self.axes()
        depth = self.distance_to(self.focal_point)
        half = self.half_height(aspect) * (1.0 if self.parallel_height else depth)
        place = self.position + depth * forward + half * (x * aspect * right + y * above)
        return place, 2.0 * half * share

    def rays(self, width, height):
        """Origins and directions (height, width, 3), row 0 at the bottom, through pixel centres.

        The directions have a component of 1 along the view axis, so that a distance along a ray is
        the depth Z of the point that it meets.
        """
        right, above, forward = self.axes()
        half = self.half_height(width / height)
        x = ((np.arange(width) + 0.5) / width * 2.0 - 1.0) * half * width / height
        y = ((np.arange(height) + 0.5) / height * 2.0 - 1.0) * half
        offset = x[None, :, None] * right + y[:, None, None] * above
        if self.parallel_height:
            return self.position + offset, np.broadcast_to(forward, offset.shape)
        return np.broadcast_to(self.position, offset.shape), offset + forward
