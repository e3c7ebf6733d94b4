"""The same certificate for all programs, computed only from a saved pressure.

    python certificate.py CASE N OPERATOR PRESSURE_FILE [REFERENCE_FILE]

One product with Love's coefficients (1929; uniform pressure on a square), computed here with numpy and scipy,
independently of the programs judged. With v = K p + g0, D = sum(p v) / sum(p), g = v - D and L the length of the
problem:

    complementarity = sum(p |g|) / (L sum(p))        gap_in_contact = max over p > 0 of |g| / L
    overlap = max(0, -min g) / L                     load = |h^2 sum(p) - F| / F

Where a hardness p_max limits the pressure, D and these lines except the load are for the elements below it, and

    gap_at_limit = max over p = p_max of g / L       over_limit = max(0, max p / p_max - 1)

`at_limit` is the fraction of elements there; a pressure counts as p_max if it differs by at most 1e-9 of it.

`contact` is the fraction of elements in contact, `mean_gap` the mean of g over all elements, relative to L.

For `periodic` and `saturated` the product uses the symbol of the cell, without a displacement of the mean. OPERATOR
selects it: `elements`, with pressures constant on each element and displacements at the centres, as in the other
problems; or `continuum`, the half-space's 2 / (E* |q|) at the waves of the grid, as if pressures were waves themselves.
A program solves one of the two, and is judged by the one that it solves.

With a second pressure, `difference` is the largest difference between the two over the peak of the second.

The coefficients of far elements have rounding errors of about 1e-16 r each: 1e-12 of d_H in g for all of them.
"""

import json
import math
import sys

import numpy as np
import scipy.fft

from problem import MODULUS, SIDE, Problem

# Number of aliases on either side in the sum for the symbol of elements in a cell.
ALIASES = 32
# Relative tolerance for a pressure to count as at the hardness.
NEAR = 1e-9


def corner(x, y):
    """The antiderivative of 1/r over a rectangle, at one corner."""
    return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))


def love(n, side):
    """Displacement of an element's centre for unit pressure on another, by offset, folded into (2n, 2n)."""
    # Offsets 0 ... n-1 and -n ... -1; the offset -n is unused.
    offset = np.fft.fftfreq(2 * n, 1.0 / (2 * n)) * side
    x, y, half = offset[:, None], offset[None, :], side / 2.0
    edges = (
        corner(x + half, y + half) - corner(x - half, y + half)
        - corner(x + half, y - half) + corner(x - half, y - half)
    )
    return edges / (np.pi * MODULUS)


def displacement(pressure, side):
    """Computes K p by one zero-padded product."""
    n = len(pressure)
    spectrum = scipy.fft.rfft2(love(n, side))
    spectrum *= scipy.fft.rfft2(pressure, s=(2 * n, 2 * n))
    return scipy.fft.irfft2(spectrum, s=(2 * n, 2 * n))[:n, :n]


def alternating_weights(count):
    """Weights of the terms -count ... count of an alternating series, whose sum then has an error of about 2^-count."""
    tail = np.cumsum([math.comb(count, k) for k in range(count + 1)])[:-1] / 2.0**count
    return np.concatenate([tail, [1.0], tail[::-1]])


def symbol(n, operator):
    """The displacement for waves of unit pressure in a cell of n x n elements, in the half spectrum of a real FFT."""
    m, k = np.fft.fftfreq(n, 1.0 / n)[:, None], np.arange(n // 2 + 1)[None, :]

    def continuum(m, k):
        wavenumber = 2.0 * np.pi * np.hypot(m, k) / SIDE
        return 2.0 / (MODULUS * np.where(wavenumber == 0.0, np.inf, wavenumber))

    if operator == "continuum":
        return continuum(m, k)
    # Pressures constant on elements contain each wave and its aliases, whose sines alternate in sign.
    total = 0.0
    weights = alternating_weights(ALIASES)
    for one, across in zip(weights, range(-ALIASES, ALIASES + 1)):
        for other, along in zip(weights, range(-ALIASES, ALIASES + 1)):
            x, y = m + across * n, k + along * n
            total = total + one * other * continuum(x, y) * np.sinc(x / n) * np.sinc(y / n)
    total[0, 0] = 0.0
    return total


def displacement_of_cell(pressure, operator):
    """The displacement relative to its mean in a periodic cell."""
    spectrum = scipy.fft.rfft2(pressure) * symbol(len(pressure), operator)
    return scipy.fft.irfft2(spectrum, s=pressure.shape)


def certificate(problem, pressure, operator):
    """The lines of the certificate, the smallest pressure, and the penetration."""
    if problem.is_periodic:
        v = displacement_of_cell(pressure, operator) + problem.gap
    else:
        v = displacement(pressure, problem.element_side) + problem.gap
    total = pressure.sum()
    is_cut = pressure >= problem.hardness * (1.0 - NEAR)
    below = np.where(is_cut, 0.0, pressure)
    penetration = (below * v).sum() / below.sum()
    gap = v - penetration
    return {
        "complementarity": (below * np.abs(gap)).sum() / total / problem.length,
        "gap_in_contact": np.abs(gap[below > 0.0]).max() / problem.length,
        "overlap": max(0.0, -gap[~is_cut].min()) / problem.length,
        "gap_at_limit": max(0.0, gap[is_cut].max(initial=0.0)) / problem.length,
        "over_limit": max(0.0, pressure.max() / problem.hardness - 1.0),
        "at_limit": np.count_nonzero(is_cut) / pressure.size,
        "load": abs(total * problem.element_side**2 - problem.force) / problem.force,
        "min_pressure": pressure.min(),
        "penetration": penetration,
        "contact": np.count_nonzero(pressure > 0.0) / pressure.size,
        "mean_gap": gap.mean() / problem.length,
    }


def main():
    case, n, operator, pressure_file, *reference_file = sys.argv[1:]
    problem = Problem(case, int(n))
    pressure = np.load(pressure_file)
    lines = certificate(problem, pressure, operator)
    for file in reference_file:
        reference = np.load(file)
        lines["difference"] = np.abs(pressure - reference).max() / reference.max()
    print(json.dumps({name: float(value) for name, value in lines.items()}))


if __name__ == "__main__":
    main()
