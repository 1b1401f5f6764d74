"""Transverse section of an involute gear cut by a rack, exactly.

Lengths in mm, angles in rad. A profile point is (r, a): radius and angle from the tooth's
centre line, on the counter-clockwise side; the other side is its mirror image.
"""

from dataclasses import dataclass
from math import atan, cos, pi, radians, sqrt, tan

import numpy as np


def involute(angle):
    """inv(angle) = tan(angle) - angle."""
    return tan(angle) - angle


@dataclass(frozen=True)
class Gear:
    """One helical gear; helix > 0 is right hand. Coefficients are multiples of the normal module."""

    teeth: int = 30
    module: float = 3.0
    pressure_angle: float = radians(20.0)
    helix: float = radians(20.0)
    width: float = 20.0
    bore_diameter: float = 60.0
    shift: float = 0.0
    thinning: float = 0.05
    addendum: float = 1.0
    dedendum: float = 1.25
    tip_round: float = 0.38

    @property
    def pitch_radius(self):
        return self.module * self.teeth / (2.0 * cos(self.helix))

    @property
    def transverse_angle(self):
        return atan(tan(self.pressure_angle) / cos(self.helix))

    @property
    def base_radius(self):
        return self.pitch_radius * cos(self.transverse_angle)

    @property
    def tip_radius(self):
        return self.pitch_radius + self.module * (self.addendum + self.shift)

    @property
    def root_radius(self):
        return self.pitch_radius - self.module * (self.dedendum - self.shift)

    @property
    def bore_radius(self):
        return self.bore_diameter / 2.0

    @property
    def pitch(self):
        """Angle from tooth to tooth."""
        return 2.0 * pi / self.teeth

    @property
    def twist(self):
        """Turn of the section per mm along the axis."""
        return tan(self.helix) / self.pitch_radius

    @property
    def base_half_angle(self):
        """Half the tooth's angle at the base circle."""
        thickness = pi * self.module / 2 + 2 * self.shift * self.module * tan(self.pressure_angle) - self.thinning
        return thickness / (self.module * self.teeth) + involute(self.transverse_angle)

    def flank_angle(self, radius):
        """Angle of the involute at a radius (number or array)."""
        roll = np.sqrt(np.maximum((np.asarray(radius) / self.base_radius) ** 2 - 1.0, 0.0))
        return self.base_half_angle - (roll - np.arctan(roll))

    def roll(self, radius):
        """Roll angle u of the involute at a radius: r = r_b sqrt(1 + u^2)."""
        return sqrt((radius / self.base_radius) ** 2 - 1.0)

    def trochoid(self, phi):
        """Fillet point (r, a) that the point phi of the rack's tip rounding leaves.

        phi = 0 at the root circle, pi/2 - alpha_n where the rounding meets the rack's flank. The
        rounding is a circle in the normal section, so an ellipse here: s_t = s_n / cos(beta).
        The rack point cuts where its normal passes through the pitch point.
        """
        m, alpha, rho = self.module, self.pressure_angle, self.tip_round * self.module
        depth = self.dedendum * m - rho  # of the rounding's centre, below the rack's reference line
        half = pi * m / 4 + self.thinning / 2 - depth * tan(alpha) - rho / cos(alpha)
        if half < -1e-12:
            raise ValueError("the rack's tip rounding is wider than the rack's tip")
        s = (half + rho * np.sin(phi)) / cos(self.helix)
        y = depth - self.shift * m + rho * np.cos(phi)
        ahead = y * np.tan(phi) * cos(self.helix)
        radius = np.hypot(self.pitch_radius - y, ahead)
        from_space = (s - ahead) / self.pitch_radius + np.arctan2(ahead, self.pitch_radius - y)
        return radius, self.pitch / 2 - from_space

    def half_profile(self, points=80):
        """Polylines (r, a) of one side: involute from the tip to the root form circle, then all below to the space's middle."""
        phi = np.linspace(pi / 2 - self.pressure_angle, 0.0, points)
        r, a = self.trochoid(phi)
        form = r[0]
        # without undercut the trochoid ends on the involute, tangentially
        if form < self.base_radius or abs(a[0] - float(self.flank_angle(form))) > 1e-9:
            raise ValueError("undercut: the trochoid cuts the involute")
        land = np.linspace(a[-1], self.pitch / 2, 12)[1:]
        below = np.concatenate([np.column_stack([r, a]), np.column_stack([np.full(land.shape, self.root_radius), land])])
        # even in roll^2, so nearly even in arc length
        rolls = np.sqrt(np.linspace(self.roll(self.tip_radius) ** 2, self.roll(form) ** 2, points))
        r = self.base_radius * np.sqrt(1.0 + rolls**2)
        r[0], r[-1] = self.tip_radius, form
        active = np.column_stack([r, self.flank_angle(r)])
        if active[0, 1] <= 0.0:
            raise ValueError("the tooth is pointed below its tip circle")
        below[0] = active[-1]
        return active, below


def xy(polar):
    """Cartesian points of polar ones."""
    polar = np.asarray(polar)
    return polar[..., 0, None] * np.stack([np.cos(polar[..., 1]), np.sin(polar[..., 1])], axis=-1)


def split_at_slope(below, slope=pi / 4):
    """Index where the fillet's tangent has turned to `slope` from the circumferential direction."""
    p = xy(below)
    d = np.gradient(p, axis=0)
    middle = np.arctan2(p[:, 1], p[:, 0])
    radial = -(d[:, 0] * np.cos(middle) + d[:, 1] * np.sin(middle))
    around = -d[:, 0] * np.sin(middle) + d[:, 1] * np.cos(middle)
    return int(np.argmin(np.abs(np.arctan2(radial, around) - slope)))
