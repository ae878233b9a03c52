#!/usr/bin/env python3
"""Write the compact set of exact values, tests/reference/*.csv, that the tests judge the mathematics by.

    python3 scripts/make_reference.py [--out tests/reference] [--seed N]

Needs mpmath and numpy. Another seed gives other arguments, for a second opinion. Arguments are f32 numbers; values have
40 digits before they are rounded to f64. Integrals are one-dimensional and exact, except those of the GGX reflectance: a
product rule over visible normals, good to six digits, hence lights of moderate sharpness only.
"""
import argparse
import csv
import math
import pathlib
import random

import mpmath as mp
import numpy as np

mp.mp.dps = 40
TAU = 2 * mp.pi


def f32(x):
    return float(np.float32(x))


def sharpnesses(rng, count):
    fixed = [0.0, 1e-30, 1e-8, 0.999, 1.0, 1.001, 87.5, 2.0**41]
    return sorted(f32(k) for k in fixed + [10 ** rng.uniform(-6, 10) for _ in range(count)])


def expm1_over_x(x):
    return mp.expm1(x) / x if x else mp.mpf(1)


def sphere(k):
    return 4 * mp.pi * expm1_over_x(-2 * k)


def bounds(k):
    """Clamped-cosine integrals over 2 pi with the axis along and against the normal."""
    if k < mp.mpf("1e-3"):
        upper = mp.nsum(lambda n: (-k) ** n / mp.factorial(n + 2), [0, 12])
        lower = mp.exp(-k) * mp.nsum(lambda n: (-k) ** n / (mp.factorial(n) * (n + 2)), [0, 12])
        return upper, lower
    e = mp.exp(-k)
    return (e - 1 + k) / k**2, e * (1 - e - k * e) / k**2


def mean_length(k):
    if k < mp.mpf("1e-6"):
        return k / 3 - k**3 / 45
    return mp.coth(k) - 1 / k


def above(k, z, power):
    """Integral over u in [0, 1] (cosine to the normal) of u^power 2 pi I0(k s sin) e^{k (z u - 1)}."""
    s = mp.sqrt((1 - z) * (1 + z))

    def ring(u):
        x = k * s * mp.sqrt((1 - u) * (1 + u))
        # Scaled Bessel function, so that sharp lobes neither over- nor underflow.
        return TAU * mp.besseli(0, x) * mp.exp(k * (z * u - 1)) * u**power

    width = 8 / mp.sqrt(k + 1)
    inside = lambda u: min(max(u, mp.mpf(0)), mp.mpf(1))
    # Around the peak; and for an axis below the horizon the decay away from it, over 1/(k |z|).
    points = {mp.mpf(0), mp.mpf(1)} | {inside(z + width * j) for j in range(-3, 4)}
    points |= {inside(4**j / (k * abs(z) + 1)) for j in range(-1, 5)}
    points = sorted(points)
    return mp.quad(ring, points, maxdegree=9)


def hemisphere(k, z):
    return above(k, z, 0), above(k, z, 1)


def filtered_density(ax, ay, view, axis, k):
    """NDF filtering by its definition, with matrices, at many digits."""
    mp.mp.dps = 120
    try:
        v, o = mp.matrix(view), mp.matrix(axis)
        a = [mp.mpf(ax) ** 2, mp.mpf(ay) ** 2]
        flat = mp.sqrt(v[0] ** 2 + v[1] ** 2)
        cx, cy = (v[0] / flat, v[1] / flat) if flat else (mp.mpf(1), mp.mpf(0))
        turn = mp.matrix([[cx, -cy], [cy, cx]])
        jacobian = turn * mp.diag([mp.mpf(1) / 2, 1 / (2 * v[2])])
        spread = mp.diag([x / (1 - x) for x in a]) + (2 / mp.mpf(k)) * (jacobian * jacobian.T)
        rough = (spread**-1 + mp.eye(2)) ** -1
        half = v + o
        half /= mp.norm(half)
        h, t = mp.matrix(half[:2]), mp.matrix(v[:2])
        d = 1 / (mp.pi * mp.sqrt(mp.det(rough)) * ((h.T * rough**-1 * h)[0] + half[2] ** 2) ** 2)
        return d / (4 * mp.sqrt((t.T * rough * t)[0] + v[2] ** 2))
    finally:
        mp.mp.dps = 40


def unit(rng, height):
    turn = rng.uniform(0, 2 * math.pi)
    ring = math.sqrt(max(0.0, 1 - height * height))
    return [f32(ring * math.cos(turn)), f32(ring * math.sin(turn)), f32(height)]


def ggx_light(alpha_x, alpha_y, view, axis, k, n=700):
    """f64 product rule in the coordinates of the visible-normal map; the light enters as a weight."""
    x, w = np.polynomial.legendre.leggauss(n)
    u2, w = (x + 1) / 2, w / 2
    turn, cap = np.meshgrid(2 * np.pi * (np.arange(n) + 0.5) / n, u2, indexing="ij")
    v = np.array([alpha_x * view[0], alpha_y * view[1], view[2]])
    v /= np.linalg.norm(v)
    z = (1 - cap) * (1 + v[2]) - v[2]
    ring = np.sqrt(np.clip(1 - z * z, 0, 1))
    h = np.stack([alpha_x * (ring * np.cos(turn) + v[0]), alpha_y * (ring * np.sin(turn) + v[1]), z + v[2]], -1)
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    view = np.array(view)
    light = 2 * (h @ view)[..., None] * h - view
    reach = lambda d: np.sqrt((alpha_x * d[..., 0]) ** 2 + (alpha_y * d[..., 1]) ** 2 + d[..., 2] ** 2)
    o = np.maximum(light[..., 2], 0)
    g = o * (view[2] + reach(view)) / (o * reach(view) + reach(light) * view[2] + 1e-300)
    lobe = np.exp(-0.5 * k * ((light - np.array(axis)) ** 2).sum(-1))
    return float((g * lobe * w).sum() / n)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", default="tests/reference", type=pathlib.Path)
    parser.add_argument("--seed", default=1, type=int)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    rng = random.Random(options.seed)

    def write(name, columns, rows):
        with open(options.out / f"{name}.csv", "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows([[repr(float(c)) if not isinstance(c, str) else c for c in row] for row in rows])
        print(name, len(rows))

    xs = sorted(f32(s * 10 ** rng.uniform(-7, 1.9)) for s in (-1, 1) for _ in range(25)) + [0.0, -0.35, 0.35]
    write("expm1_over_x", ["x", "expm1_over_x", "expm1"], [[x, expm1_over_x(mp.mpf(x)), mp.expm1(x)] for x in xs])
    xs = [f32(rng.uniform(-4, 9)) for _ in range(60)] + [f32(10 ** rng.uniform(-8, 0)) for _ in range(10)]
    write("erf", ["x", "erf", "erfc"], [[x, mp.erf(x), mp.erfc(x)] for x in sorted(xs)])

    ks = sharpnesses(rng, 30)
    rows = []
    for k in ks:
        m = mp.mpf(k)
        log = mp.log(TAU * expm1_over_x(-m)) - m
        rows.append([k, sphere(m), TAU * expm1_over_x(-m), mp.exp(log), log])
    write("sg_integral", ["sharpness", "sg_integral", "c_upper", "c_lower", "ln_c_lower"], rows)
    rows = []
    for k in ks:
        upper, lower = bounds(mp.mpf(k))
        rows.append([k, upper, lower, mp.log(lower)])
    write("sg_clamped_cosine_bounds", ["sharpness", "b_upper_over_2pi", "b_lower_over_2pi", "ln_b_lower_over_2pi"], rows)
    rows = []
    for k in ks:
        r = mean_length(mp.mpf(k))
        complement = 1 - r
        rows.append([k, r, complement, r * (3 - r * r) / (1 - r * r), r / complement])
    names = ["banerjee_sharpness_of_mean_length", "toksvig_sharpness_of_mean_length"]
    write("vmf_mean_length", ["sharpness", "mean_length", "one_minus_mean_length", *names], rows)

    rows = []
    for _ in range(40):
        a, b = (f32(10 ** rng.uniform(-6, 12)) for _ in range(2))
        len2 = f32(rng.choice([rng.uniform(0, 4), 10 ** rng.uniform(-14, 0), 4 - 10 ** rng.uniform(-6, 0)]))
        length = mp.sqrt((mp.mpf(a) + b) ** 2 - mp.mpf(a) * b * len2)
        rows.append([a, b, len2, length, length - a - b])
    columns = ["sharpness1", "sharpness2", "len2", "product_sharpness", "log_amplitude"]
    write("sg_product_len2", columns, rows)

    rows = []
    for _ in range(110):
        k = f32(10 ** rng.uniform(-2, 4))
        z = f32(rng.choice([rng.uniform(-1, 1), rng.uniform(-3, 3) / math.sqrt(k + 9)]))
        h, b = hemisphere(mp.mpf(k), mp.mpf(z))
        rows.append([k, z, h, mp.log(h), b, mp.log(b), h / sphere(mp.mpf(k))])
    columns = ["sharpness", "cosine", "sg_hemispherical_integral", "ln_sg_hemispherical_integral"]
    columns += ["sg_clamped_cosine_integral", "ln_sg_clamped_cosine_integral", "vmf_hemispherical_integral"]
    write("sg_hemisphere", columns, rows)

    rows = []
    for _ in range(400):
        ax = f32(10 ** rng.uniform(-4, 0))
        ay = ax if rng.random() < 0.5 else f32(10 ** rng.uniform(-4, 0))
        view = unit(rng, rng.choice([rng.uniform(0, 1), 10 ** rng.uniform(-6, 0)]))
        axis = unit(rng, rng.uniform(-0.3, 1))
        k = f32(10 ** rng.uniform(-30 if rng.random() < 0.2 else -3, 10))
        rows.append([ax, ay, *view, *axis, k, filtered_density(ax, ay, view, axis, k)])
    columns = ["alpha_x", "alpha_y", "i_x", "i_y", "i_z", "xi_x", "xi_y", "xi_z", "sharpness", "density"]
    write("filtered_lobe", columns, rows)

    rows = []
    for _ in range(60):
        ax = rng.uniform(0.15, 1)
        ay = ax if rng.random() < 0.7 else rng.uniform(0.15, 1)
        view, height = unit(rng, rng.uniform(0.1, 1)), rng.uniform(-0.2, 1)
        mirrored = np.array([-view[0], -view[1], view[2]])
        axis = np.array(unit(rng, height)) * 0.6 + mirrored
        axis /= np.linalg.norm(axis)
        k = 10 ** rng.uniform(-1, 2.3)
        view = np.array(view) / np.linalg.norm(view)
        rows.append(["ggx", ax, ay, *view, *axis, k, ggx_light(ax, ay, view, axis, k)])
    columns = ["ndf", "alpha_x", "alpha_y", "i_x", "i_y", "i_z", "xi_x", "xi_y", "xi_z", "sharpness"]
    write("brdf_sg_integral", [*columns, "brdf_sg_integral"], rows)


if __name__ == "__main__":
    main()
