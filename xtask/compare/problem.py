"""The two problems on which the programs are compared, defined exactly; the fields need numpy.

Everything is dimensionless: a rigid paraboloid of radius R = 1 on a homogeneous half-space of plane-strain modulus
E* = 1, pressed by the force F = 4 E* a^3 / (3 R) of the Hertzian contact radius a = 0.15. The pressure acts inside the
square [-1/2, 1/2]^2 only, on n x n square elements, constant on each; the half-space is infinite, nothing is periodic.

    hertz    g0 = r^2 / (2 R)
    pillars  the same above flat-topped rigid pillars of height 0.1 d_H, so g0 is larger by that between them; their
             axes form a square lattice of period T = 16 elements, the first at (T/2, T/2) from the domain's corner;
             an element stands on a pillar if its centre lies within 0.4 T of the pillar's axis

d_H = a^2 / R is the Hertzian approach, the length that every error is relative to. xtask/src/compare/problem.rs is the
same definition for Pellicle.
"""

import numpy as np

SIDE = 1.0
MODULUS = 1.0
INDENTER_RADIUS = 1.0
CONTACT_RADIUS = 0.15
HERTZ_APPROACH = CONTACT_RADIUS**2 / INDENTER_RADIUS
PEAK_PRESSURE = 2.0 * MODULUS * CONTACT_RADIUS / (np.pi * INDENTER_RADIUS)
FORCE = 4.0 * MODULUS * CONTACT_RADIUS**3 / (3.0 * INDENTER_RADIUS)
PILLAR_HEIGHT = 0.1 * HERTZ_APPROACH
ELEMENTS_PER_PERIOD = 16
RADIUS_OVER_PERIOD = 0.4


class Problem:
    """One case on n x n elements; `gap` is the undeformed gap at their centres, an (n, n) array, x first."""

    def __init__(self, case, n):
        self.case, self.n = case, n
        self.element_side = SIDE / n
        # F spread over the whole square, the load that some programs ask for
        self.mean_pressure = FORCE / SIDE**2
        self.gap = self.paraboloid() + (self.valleys() if case == "pillars" else 0.0)

    def paraboloid(self):
        x = (np.arange(self.n) + 0.5) * self.element_side - SIDE / 2.0
        return (x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * INDENTER_RADIUS)

    def valleys(self):
        # Distances from the nearest axis in elements: half-integers, so none equals 6.4 and none is in doubt.
        period = ELEMENTS_PER_PERIOD
        from_axis = np.arange(self.n) % period + 0.5 - period / 2.0
        squared = from_axis[:, None] ** 2 + from_axis[None, :] ** 2
        return np.where(squared > (RADIUS_OVER_PERIOD * period) ** 2, PILLAR_HEIGHT, 0.0)
