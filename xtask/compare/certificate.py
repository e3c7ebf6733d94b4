"""The same certificate for everyone, from nothing but a saved pressure.

    python certificate.py CASE N PRESSURE_FILE [REFERENCE_FILE]

One product with Love's coefficients (1929; uniform pressure on a square), computed here with numpy and scipy and shared
with no program that is judged. With v = K p + g0, D = sum(p v) / sum(p), g = v - D and L the length of the problem:

    complementarity = sum(p |g|) / (L sum(p))        gap_in_contact = max over p > 0 of |g| / L
    overlap = max(0, -min g) / L                     load = |h^2 sum(p) - F| / F

With a second pressure, `difference` is the largest difference of the two over the largest of the second.

The coefficients of far elements carry rounding errors of about 1e-16 r each: 1e-12 of d_H in g for all of them.
"""

import json
import sys

import numpy as np
import scipy.fft

from problem import MODULUS, Problem


def corner(x, y):
    """The antiderivative of 1/r over a rectangle, at one of its corners."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def love(n, side):
    """Displacement of an element's centre for unit pressure on another, by offset, folded into (2n, 2n)."""
    # Offsets 0 ... n-1 and -n ... -1; the offset -n is nobody's.
    offset = np.fft.fftfreq(2 * n, 1.0 / (2 * n)) * side
    x, y, half = offset[:, None], offset[None, :], side / 2.0
    edges = (
        corner(x + half, y + half) - corner(x - half, y + half)
        - corner(x + half, y - half) + corner(x - half, y - half)
    )
    return edges / (np.pi * MODULUS)


def displacement(pressure, side):
    """K p by one zero-padded product."""
    n = len(pressure)
    spectrum = scipy.fft.rfft2(love(n, side))
    spectrum *= scipy.fft.rfft2(pressure, s=(2 * n, 2 * n))
    return scipy.fft.irfft2(spectrum, s=(2 * n, 2 * n))[:n, :n]


def certificate(problem, pressure):
    """The four lines, the smallest pressure, and the penetration that they belong to."""
    v = displacement(pressure, problem.element_side) + problem.gap
    total = pressure.sum()
    penetration = (pressure * v).sum() / total
    gap = v - penetration
    return {
        "complementarity": (pressure * np.abs(gap)).sum() / total / problem.length,
        "gap_in_contact": np.abs(gap[pressure > 0.0]).max() / problem.length,
        "overlap": max(0.0, -gap.min()) / problem.length,
        "load": abs(total * problem.element_side**2 - problem.force) / problem.force,
        "min_pressure": pressure.min(),
        "penetration": penetration,
        "contact_elements": int(np.count_nonzero(pressure > 0.0)),
    }


def main():
    case, n, pressure_file, *reference_file = sys.argv[1:]
    problem = Problem(case, int(n))
    pressure = np.load(pressure_file)
    lines = certificate(problem, pressure)
    for file in reference_file:
        reference = np.load(file)
        lines["difference"] = np.abs(pressure - reference).max() / reference.max()
    print(json.dumps({name: value if isinstance(value, int) else float(value) for name, value in lines.items()}))


if __name__ == "__main__":
    main()
