#!/usr/bin/env python3
"""Fit the interpolations of vsgl-core/src/sg/cosine.rs (v14) and hemisphere.rs; prints error and constants.

The exact factors come from ring integrals with scaled Bessel functions; parameters from least squares, reweighted towards the
least maximum. There are several minima; the starting points are the best of a few random ones, rounded. Needs numpy and scipy; about a minute.
"""
import numpy as np
from scipy.optimize import least_squares
from scipy.special import erf, ive

NODES, WEIGHTS = np.polynomial.legendre.leggauss(160)


def above_horizon(k, z, power):
    """Integral of u^power over the hemisphere, over 2 pi; only the arc that the lobe reaches is divided."""
    s, reach, angle = np.sqrt((1 - z) * (1 + z)), 7 / np.sqrt(k + 0.5), np.arcsin(z)
    high = min(np.pi / 2, angle + reach)
    low = min(max(0, angle - reach), high / 2)
    a = (NODES + 1) / 2 * (high - low) + low
    u, c = np.sin(a), np.cos(a)
    x = k * s * c
    return (u**power * c * ive(0, x) * np.exp(x + k * z * u - k) * WEIGHTS).sum() * (high - low) / 2


rows = []
for k in np.geomspace(0.05, 3e4, 90):
    e = np.exp(-k)
    mass = -np.expm1(-k) / k
    upper = (1 - mass) / k
    lower = e * (mass - upper)
    for z in np.unique(np.concatenate([np.linspace(0, 1, 25), np.clip(np.linspace(0, 5, 22) / np.sqrt(k + 4), 0, 1)])):
        cosine = (above_horizon(k, z, 1) - lower) / (upper - lower)
        half = (above_horizon(k, z, 0) / mass - e) / (1 - e)
        rows.append((k, z, cosine, (upper - lower) / upper, half, 1 - e))
# Factor and how much of the peak an error of it is, for the clamped cosine and for the hemisphere.
k, z, cosine, cosine_weight, half, half_weight = np.array(rows).T


def minimax(residual, start, rounds=40):
    best, p, weight = (np.inf, None), np.array(start, float), np.ones(len(k))
    for _ in range(rounds):
        p = least_squares(lambda q: 1e3 * weight * residual(q), p, max_nfev=60).x
        e = np.abs(residual(p))
        if e.max() < best[0]:
            best = (e.max(), p.copy())
        weight *= np.sqrt(e / e.max() + 0.15)
        weight /= weight.mean()
    return best


def hemisphere(p):
    t = k * np.sqrt(abs(0.5 * k + p[0]) / abs((k + p[1]) * k + p[2]))
    depth = p[3] * k * k / ((k * k + abs(p[4]) * k + abs(p[5])) * np.sqrt(k + 1))
    bend = z * (1 - z * z) * np.exp(-((t * z) ** 2)) * depth
    return half_weight * (0.5 + 0.5 * erf(t * z) / erf(t) + bend - half)


def erf_integral(u):
    return u * erf(u) + np.expm1(-u * u) / np.sqrt(np.pi)


def clamped_cosine(p):
    t = k * np.sqrt(abs((k + p[0]) * k + p[1]) / (2 * abs(((k + p[2]) * k + p[3]) * k + p[4])))
    b = k * k + p[6] * k + abs(p[7]) + p[6] ** 2 / 4
    c = k * k + p[12] * k + abs(p[13]) + p[12] ** 2 / 4
    c0 = p[8] * k**3 / (k * k + abs(p[9]) * k + abs(p[10])) ** 2.5
    c1 = p[5] * k**3 / b**1.75
    c2 = (p[11] + p[14] * k) * k**2 / c**1.5
    v = (1 + z) / 2 - (erf_integral(t) - erf_integral(t * z)) / (2 * t)
    even = (1 - z * z) * np.exp(-((t * z) ** 2)) * (c0 + c1 * z**2 + c2 * z**4)
    return cosine_weight * (v + even - cosine)


for name, residual, start in [
    ("hemisphere", hemisphere, [0.65, 1.34, 7.22, 0.1, 2.0, 5.0]),
    (
        "clamped cosine",
        clamped_cosine,
        [2.3, 17.8, 3.49, 8.6, 81.64, -0.0785, 3.416, 35.0, 0.4827, 1e-5, 9.405, -0.0677, -11.13, 27.34, -0.00111],
    ),
]:
    error, p = minimax(residual, start)
    print(f"{name}: error {error:.2e} of the peak")
    print("  ", ", ".join(f"{x:.8g}" for x in p))
