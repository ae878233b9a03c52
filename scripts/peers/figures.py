"""What is read off the measured points: fronts, and when an error is reached. Points are (CPU seconds, error in percent)."""

import math


def front(points):
    """Those points that no other beats in both, by time."""
    best, out = math.inf, []
    for point in sorted(points, key=lambda p: (p[0], p[1])):
        if point[1] < best:
            best = point[1]
            out.append(point)
    return out


def cheapest(points, error):
    """The cheapest point with at most that error, or None: settings can be taken or left."""
    return min((p for p in points if p[1] <= error), key=lambda p: p[0], default=None)


def crossing(points, error):
    """Time at which a curve of falling error crosses it, straight between logarithms; None where it does not.

    For samples per pixel, which come in any number. A curve that begins below the error is None too: how much sooner it
    was there is not known.
    """
    points = front(points)
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e0 >= error >= e1:
            share = (math.log(e0) - math.log(error)) / (math.log(e0) - math.log(e1))
            return math.exp(math.log(t0) + share * (math.log(t1) - math.log(t0)))
    return None


def decades(low, high):
    """Marks of a logarithmic axis, at least three: 1, 2 and 5 times powers of ten within the bounds."""
    out = []
    for power in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1):
        out += [m * 10.0**power for m in (1, 2, 5) if low <= m * 10.0**power <= high]
    return out


def short(value, digits=2):
    """A number for a table, with that many significant digits and no exponent."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    places = max(0, digits - 1 - math.floor(math.log10(abs(value))))
    return f"{value:.{places}f}"
