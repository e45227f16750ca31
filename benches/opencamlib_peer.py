#!/usr/bin/env python3
"""Drops of OpenCAMLib on the meshes of benches/drop.rs, on one thread: a line of seconds, count and name.

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


def measure(surface, cutter, count):
    drops = ocl.BatchDropCutter()
    drops.setSTL(surface)
    drops.setCutter(cutter)
    drops.setThreads(1)
    for i in range(count):
        drops.appendPoint(ocl.CLPoint(*scattered(i), -100))
    began = time.process_time()
    drops.run()
    return time.process_time() - began


if __name__ == "__main__":
    for n in (50, 158, 500):
        surface = sculpt(n)
        # Its time grows with the triangles under the cutter.
        count = 5000 if n == 50 else 500
        seconds = min(measure(surface, ocl.BullCutter(10, 2, 50), count) for _ in range(3))
        print(f"{seconds}\t{count}\tbull-nose drops on {2 * n * n} triangles", flush=True)
