"""The exact definitions of the problems on which the programs are compared; the fields need numpy.

Everything is dimensionless: a rigid body on a homogeneous half-space of plane-strain modulus E* = 1. The pressure acts
inside the square [-1/2, 1/2]^2 only, on n x n square elements, constant on each; the half-space is infinite, and only
`periodic` and `saturated` are periodic.

    hertz    a paraboloid of radius R = 1, g0 = r^2 / (2 R), under the force F = 4 E* a^3 / (3 R) of the Hertzian
             contact radius a = 0.15
    pillars  the same above flat-topped rigid pillars of height 0.1 d_H, so g0 is larger by that between them; their
             axes form a square lattice of period T = 16 elements, the first at (T/2, T/2) from the domain's corner;
             an element stands on a pillar if its centre lies within 0.4 T of the pillar's axis
    rough-P  a self-affine surface: waves of integers (m, n) per side with 12 <= k = |(m, n)| <= 338, amplitude as
             k^-(1 + H), H = 0.8, phases drawn from a fixed seed, rms height 0.02 of the side, under the mean pressure
             that brings P percent of the square into contact; for n >= 1024
    periodic the same with 4 <= k <= 64 under the mean pressure 0.05, and the square is one cell of many in both
             directions; for n >= 256
    saturated
             the same with the pressure limited by the hardness 0.6, where gaps may be negative

Errors are relative to `length`: the Hertzian approach d_H = a^2 / R, or the rms height. pellicle.rs repeats the
definitions of hertz and pillars for Pellicle, which reads the gap of rough.
"""

import numpy as np

SIDE = 1.0
MODULUS = 1.0
INDENTER_RADIUS = 1.0
CONTACT_RADIUS = 0.15
HERTZ_APPROACH = CONTACT_RADIUS**2 / INDENTER_RADIUS
PILLAR_HEIGHT = 0.1 * HERTZ_APPROACH
ELEMENTS_PER_PERIOD = 16
RADIUS_OVER_PERIOD = 0.4

SEED = 18
HURST = 0.8
RMS_HEIGHT = 0.02 * SIDE
# The mean pressure over the square for each percentage in contact, found with Pellicle at n = 1024.
MEAN_PRESSURE = {"rough-0.1": 1.85e-3, "rough-2.5": 0.05, "rough-20": 0.49, "periodic": 0.05, "saturated": 0.05}
HARDNESS = {"saturated": 0.6}
# The longest and the shortest wave, in waves per side, and the elements per side that resolve them.
WAVES = {"rough": (12, 338), "periodic": (4, 64), "saturated": (4, 64)}
SMALLEST = {"rough": 1024, "periodic": 256, "saturated": 256}
CELLS = ("periodic", "saturated")

CASES = ("hertz", "pillars", *MEAN_PRESSURE)


class Problem:
    """One case on n x n elements; `gap` is the undeformed gap at their centres, an (n, n) array, x first."""

    def __init__(self, case, n):
        self.case, self.n = case, n
        self.element_side = SIDE / n
        if case in MEAN_PRESSURE:
            self.gap, self.length = rough(case.split("-")[0], n), RMS_HEIGHT
            self.force, self.peak_pressure = MEAN_PRESSURE[case] * SIDE**2, MODULUS
        else:
            self.gap = paraboloid(n) + (valleys(n) if case == "pillars" else 0.0)
            self.length = HERTZ_APPROACH
            self.force = 4.0 * MODULUS * CONTACT_RADIUS**3 / (3.0 * INDENTER_RADIUS)
            self.peak_pressure = 2.0 * MODULUS * CONTACT_RADIUS / (np.pi * INDENTER_RADIUS)
        self.is_periodic = case in CELLS
        self.hardness = HARDNESS.get(case, np.inf)
        # the force spread over the whole square, the form of the load in some programs
        self.mean_pressure = self.force / SIDE**2


def paraboloid(n):
    x = (np.arange(n) + 0.5) / n * SIDE - SIDE / 2.0
    return (x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * INDENTER_RADIUS)


def valleys(n):
    # Distances from the nearest axis in elements: half-integers along x and y, so none equals 6.4.
    period = ELEMENTS_PER_PERIOD
    from_axis = np.arange(n) % period + 0.5 - period / 2.0
    squared = from_axis[:, None] ** 2 + from_axis[None, :] ** 2
    return np.where(squared > (RADIUS_OVER_PERIOD * period) ** 2, PILLAR_HEIGHT, 0.0)


def rough(kind, n):
    if n < SMALLEST[kind]:
        raise ValueError(f"found n = {n} for {kind}, wanted at least {SMALLEST[kind]}")
    longest, shortest = WAVES[kind]
    # Waves -shortest ... shortest in both directions: the same surface for every n.
    wave = np.arange(-shortest, shortest + 1)
    k = np.hypot(wave[:, None], wave[None, :])
    phase = np.random.default_rng(SEED).uniform(0.0, 2.0 * np.pi, k.shape)
    inside = (k >= longest) & (k <= shortest)
    amplitude = np.where(inside, np.maximum(k, 1.0) ** -(1.0 + HURST), 0.0)
    spectrum = np.zeros((n, n), dtype=complex)
    spectrum[np.ix_(wave, wave)] = amplitude * np.exp(1j * phase)
    height = np.fft.ifft2(spectrum).real
    height *= RMS_HEIGHT / np.sqrt(np.mean(height**2))
    return height.max() - height
