#!/usr/bin/env python3
"""Drops a second of OpenCAMLib on the meshes of benches/drop.rs, on one thread.

usage: opencamlib_peer.py        (in an environment with opencamlib==2023.1.11)
"""
import time
from math import cos, exp, pi, sin

import opencamlib as ocl


def height(x, y):
    z = 8 * sin(2 * pi * x / 50) * cos(2 * pi * y / 40) + 3 * sin(2 * pi * (x + 2 * y) / 23)
    z += 15 * exp(-((x - 12) ** 2 + (y + 8) ** 2) / 60)
    return z - 10 * exp(-((x + 20) ** 2 + (y - 15) ** 2) / 25)


def sculpt(n):
    at = [-50 + 100 * i / n for i in range(n + 1)]
    p = [[ocl.Point(x, y, height(x, y)) for y in at] for x in at]
    surface = ocl.STLSurf()
    for i in range(n):
        for j in range(n):
            a, b, c, d = p[i][j], p[i + 1][j], p[i + 1][j + 1], p[i][j + 1]
            surface.addTriangle(ocl.Triangle(a, b, c))
            surface.addTriangle(ocl.Triangle(a, c, d))
    return surface


def scattered(i):
    return tuple(-47.5 + 95 * (i * step % 1) for step in (0.754877666246693, 0.5698402909980533))


def raster(i):
    return -47.5 + 0.95 * (i % 100), -47.5 + 1.9 * (i // 100)


def measure(surface, cutter, place, count):
    drops = ocl.BatchDropCutter()
    drops.setSTL(surface)
    drops.setCutter(cutter)
    drops.setThreads(1)
    for i in range(count):
        drops.appendPoint(ocl.CLPoint(*place(i), -100))
    began = time.process_time()
    drops.run()
    return count / (time.process_time() - began)


if __name__ == "__main__":
    for n in (50, 158, 500):
        surface = sculpt(n)
        for name, cutter in (
            ("bull_nose", ocl.BullCutter(10, 2, 50)),
            ("ball", ocl.BallCutter(10, 50)),
            ("flat", ocl.CylCutter(10, 50)),
        ):
            for place in (scattered, raster):
                rate = measure(surface, cutter, place, 5000 if n == 50 else 500)
                print(f"{2 * n * n} triangles, {name}, {place.__name__}: {rate:.0f} drops/s", flush=True)
