#!/usr/bin/env python3
"""Fit the directional albedo of the GGX lobe; prints the constants of vsgl-core/src/brdf/albedo.rs.

The albedo of F D G2/(4 v o) with Schlick's F = f0 + (f90 - f0)(1 - c)^5 is f0 (S - B) + f90 B, where S is the albedo for
F = 1 and B that for F = (1 - c)^5. Both are integrals over visible normals (spherical-cap sampling, as a quadrature).

Needs numpy. Takes about two minutes.
"""
import numpy as np

LEVELS = 128


def albedo(mu, alpha):
    """S - B and B by product quadrature in the two coordinates of the visible-normal map."""
    x, w = np.polynomial.legendre.leggauss(LEVELS)
    u2, w = (x + 1) / 2, w / 2
    u1 = (np.arange(LEVELS) + 0.5) / LEVELS
    turn, cap = np.meshgrid(2 * np.pi * u1, u2, indexing="ij")
    sine = np.sqrt(max(0.0, 1 - mu * mu))
    v = np.array([alpha * sine, 0.0, mu])
    v /= np.linalg.norm(v)
    z = (1 - cap) * (1 + v[2]) - v[2]
    ring = np.sqrt(np.clip(1 - z * z, 0, 1))
    h = np.stack([alpha * (ring * np.cos(turn) + v[0]), alpha * ring * np.sin(turn), z + v[2]], -1)
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    c = h @ np.array([sine, 0.0, mu])
    o = np.maximum(2 * c * h[..., 2] - mu, 0)
    reach = lambda q: np.sqrt(alpha**2 + (1 - alpha**2) * q * q)
    g2_over_g1 = o * (mu + reach(mu)) / (o * reach(mu) + reach(o) * mu + 1e-300)
    schlick = np.clip(1 - c, 0, 1) ** 5
    return (g2_over_g1 * (1 - schlick) * w).sum() / LEVELS, (g2_over_g1 * schlick * w).sum() / LEVELS


def minimax(columns, target, weight, rounds=400):
    """Lawson's reweighted least squares: nearly the least maximum of weight * |columns c - target|."""
    lawson, best = np.ones(len(target)), None
    for _ in range(rounds):
        q = np.sqrt(lawson) * weight
        c, *_ = np.linalg.lstsq(columns * q[:, None], target * q, rcond=1e-13)
        e = np.abs(weight * (columns @ c - target))
        if best is None or e.max() < best[0]:
            best = (e.max(), c)
        lawson *= e / e.max() + 0.02
        lawson /= lawson.mean()
    return best


def rational(p, q, target, rounds=300):
    """p c / (1 + q d), linearised and reweighted."""
    below, lawson, best = np.ones_like(target), np.ones_like(target), None
    for _ in range(rounds):
        w = np.sqrt(lawson) / below
        c, *_ = np.linalg.lstsq(np.concatenate([p, -target[:, None] * q], 1) * w[:, None], target * w, rcond=1e-12)
        d = 1 + q @ c[p.shape[1]:]
        e = np.abs(p @ c[:p.shape[1]] / d - target)
        if d.min() > 0.05 and (best is None or e.max() < best[0]):
            best = (e.max(), c)
        below, lawson = np.clip(d, 0.02, None), lawson * (e / e.max() + 0.05)
        lawson /= lawson.mean()
    return best


def powers(*orders, total):
    grid = np.stack(np.meshgrid(*[np.arange(o + 1) for o in orders], indexing="ij"), -1).reshape(-1, len(orders))
    return [tuple(int(i) for i in g) for g in grid if g.sum() <= total]


def columns(exponents, *variables):
    return np.stack([np.prod([v**e for v, e in zip(variables, g)], axis=0) for g in exponents], 1)


mus = np.unique(np.clip(np.concatenate([[3e-4, 1e-3, 3e-3], np.linspace(0.01, 1, 60) ** 1.5]), 1e-4, 1))
alphas = np.unique(np.concatenate([[5e-4, 1e-3, 5e-3], np.linspace(0.1, 1, 40) ** 2]))
table = np.array([[albedo(m, a) for a in alphas] for m in mus])
mu, alpha = (g.ravel() for g in np.meshgrid(mus, alphas, indexing="ij"))
total, bent = table.sum(-1).ravel(), table[..., 1].ravel()
reach = np.sqrt(alpha**2 + (1 - alpha**2) * mu**2)
part, root = mu / reach, np.sqrt(alpha)

numerator, denominator = powers(3, 3, total=3), powers(2, 2, total=2)[1:]
error, c = rational(columns(numerator, part, alpha), columns(denominator, part, alpha), 1 - total)
print(f"1 - S, powers of (part, alpha): max error {error:.2e}")
for g, value in zip(numerator, c):
    print("  above", g, f"{np.float32(value):.7e}")
for g, value in zip(denominator, c[len(numerator):]):
    print("  below", g, f"{np.float32(value):.7e}")

# B/S is the mean of (1 - c)^5: fit the cosine that gives it, weighted by what an error of it does to B.
cosine = 1 - (bent / total) ** 0.2
weight = np.maximum(5 * (1 - cosine) ** 4 * total, 1e-3)
exponents = powers(3, 3, 3, total=3)
error, c = minimax(columns(exponents, part, root, reach), cosine, weight)
print(f"cosine, powers of (part, root, reach): max error in B {error:.2e}")
for g, value in zip(exponents, c):
    print("  ", g, f"{np.float32(value):.7e}")
