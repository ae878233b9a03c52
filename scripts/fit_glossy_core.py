#!/usr/bin/env python3
"""Prints how far the blurred GGX distribution of `vsgl_core::sg::glossy` is from the exact blur.

    scripts/fit_glossy_core.py            Markdown table; needs nothing but Python
"""
import math

Q = [0, 0.1, 0.3, 0.6, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 25, 40, 80, 200]
RATIOS = [1.05, 1.2, 1.5, 2, 3, 5, 10, 30, 100, 1000]


def exact(q, rho, steps=4000):
    """GGX as a mixture of Gaussians, each blurred: by the trapezoid rule in ln u."""
    low, high = math.log(1e-12), math.log(60.0)
    step = (high - low) / steps
    total = 0.0
    for i in range(steps + 1):
        u = math.exp(low + step * i)
        v = 1 / (rho * u) + 1 - 1 / rho
        exponent = -u - q / v
        if exponent > -700:
            total += (0.5 if i in (0, steps) else 1) * u * math.exp(exponent) / v
    return total * step


def ours(q, rho):
    core = 1 - 1 / rho
    s = 0.57 + 0.19 * core + 0.24 * core**32
    return core * s * math.exp(-s * q) + (1 - core) * (1 + q) ** -2


def worst(form, rho):
    return max(abs(form(q, rho) / exact(q, rho) - 1) for q in Q)


def percent(x):
    return f"{100 * x:.0f} %" if x < 1 else f"×{1 + x:.0f}"


print("| ρ | " + " | ".join(f"{r:g}" for r in RATIOS) + " |")
print("| --- " * (len(RATIOS) + 1) + "|")
print("| core and tail | " + " | ".join(percent(worst(ours, r)) for r in RATIOS) + " |")
wider = lambda q, rho: (1 + q) ** -2
print("| wider GGX | " + " | ".join(percent(worst(wider, r)) for r in RATIOS) + " |")
