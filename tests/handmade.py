"""Shapes made by hand, with what they show: cylinders, folds of the whole, ridges, hourglasses."""

import numpy as np

RADIUS, GAP, ROWS, COLUMNS = 0.1, 0.13, 27, 90
ANGLE = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
HEIGHT = np.linspace(0, 1, ROWS)
ENVELOPE = np.sin(np.pi * HEIGHT)[:, None]
"""Nothing moves at the rings."""


def shape(radial, lateral=0.0):
    """Points with a radial displacement and a sideways one along x, m; shape (3, ROWS, COLUMNS)."""
    radius = RADIUS + ENVELOPE * radial
    x = radius * np.cos(ANGLE) + ENVELOPE * lateral
    return np.stack([x, radius * np.sin(ANGLE), np.broadcast_to(GAP * HEIGHT[:, None], x.shape)])


def concertina(waves, depth):
    """Axisymmetric folds."""
    return shape(depth * np.sin(2 * np.pi * waves * HEIGHT)[:, None] * np.ones(COLUMNS))


def pleat(at, depth, width=0.08):
    """One axisymmetric fold, the rest straight."""
    bump = np.exp(-0.5 * ((HEIGHT - at) / width) ** 2)
    return shape(-depth * bump[:, None] * np.ones(COLUMNS))


def kink(depth):
    """The cylinder sways to one side."""
    return shape(0.0, lateral=depth)


def diamonds(around, along, depth):
    """A Yoshimura-like pattern."""
    phase = np.where(np.floor(along * HEIGHT) % 2 == 0, 0.0, np.pi)
    pattern = np.abs(np.sin(0.5 * (around * ANGLE + phase[:, None])))
    return shape(-depth * (pattern - pattern.mean()))


def ridges(seed, depth, waves=8):
    """A random network: many waves around and along, none of them special."""
    rng = np.random.default_rng(seed)
    total = np.zeros((ROWS, COLUMNS))
    for n in range(waves):
        for m in range(1, 5):
            amplitude = rng.normal() / max(n, 2)  # long waves are deeper
            total += amplitude * np.sin(
                m * np.pi * HEIGHT[:, None] + n * ANGLE + rng.uniform(0, 2 * np.pi)
            )
    return shape(depth * total / np.abs(total).max())


def noisy(points, seed, size):
    """With a disturbance of every point, m."""
    return points + size * np.random.default_rng(seed).normal(size=points.shape)


def checkerboard(points, size):
    """With every second point out and every other one in."""
    sign = (-1.0) ** (np.arange(ROWS)[:, None] + np.arange(COLUMNS)) * ENVELOPE
    return (
        points + size * sign * np.stack([np.cos(ANGLE), np.sin(ANGLE), np.zeros(COLUMNS)])[:, None]
    )


FOLDED = {
    **{f"concertina of {n}": concertina(n, 0.01 * n) for n in (1, 2, 3, 6)},
    **{f"pleat at {a}": pleat(a, 0.04) for a in (0.3, 0.5, 0.7)},
    **{f"kink of {1e3 * d:g} mm": kink(d) for d in (0.01, 0.03, 0.06)},
    "kink with noise": noisy(kink(0.04), 1, 1e-3),
    "concertina with noise": noisy(concertina(3, 0.03), 2, 1e-3),
    "pleat with shallow ridges": pleat(0.5, 0.05) + ridges(3, 0.004) - shape(0.0),
}
RIDGED = {
    **{f"diamonds {n} x {m}": diamonds(n, m, 0.03) for n, m in ((4, 2), (6, 3), (8, 4), (10, 6))},
    **{f"ridges {s}": ridges(s, 0.03) for s in range(8)},
    **{f"deep ridges {s}": ridges(s, 0.07) for s in range(20, 24)},
    "ridges with noise": noisy(ridges(30, 0.03), 3, 2e-4),
    "diamonds with a kink": diamonds(6, 3, 0.04) + kink(0.01) - shape(0.0),
}
HOURGLASSED = {
    **{
        f"ridges with a checkerboard of {1e3 * d:g} mm": checkerboard(ridges(40, 0.03), d)
        for d in (2e-3, 4e-3)
    },
    "cylinder with a checkerboard": checkerboard(shape(0.0), 1e-3),
    "diamonds with a checkerboard": checkerboard(diamonds(6, 3, 0.03), 3e-3),
}
