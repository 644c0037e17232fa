# SPDX-License-Identifier: MIT
"""Drawings of convex polyhedra: the types of contacts and the shapes of grains. Faces are sorted from
far to near, which is exact for the faces of one convex body."""
import csv
import itertools
import math
import subprocess

import plots

LIGHT = (0.35, -0.75, 0.56)
EYE = (-0.5, -0.78, 0.38)  # direction from the origin to the viewer


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def rotated(points, axis, degrees):
    """The points turned about an axis through the origin."""
    k, angle = unit(axis), math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    return [tuple(p[i] * c + cross(k, p)[i] * s + k[i] * dot(k, p) * (1 - c) for i in range(3))
            for p in points]


def shifted(points, by):
    return [tuple(a + b for a, b in zip(p, by)) for p in points]


def hull_faces(points):
    """Faces of the convex hull as (outward normal, corners in order). Coplanar triangles are one face.
    All triples are tried: for bodies of at most some 40 points."""
    centre = tuple(sum(p[i] for p in points) / len(points) for i in range(3))
    faces = {}
    for a, b, c in itertools.combinations(points, 3):
        n = cross(sub(b, a), sub(c, a))
        if dot(n, n) < 1e-12:
            continue
        n = unit(n)
        if dot(n, sub(a, centre)) < 0:
            n = tuple(-x for x in n)
        level = dot(n, a)
        if any(dot(n, p) > level + 1e-6 for p in points):
            continue
        faces[tuple(round(x, 4) for x in (*n, level))] = (n, level)
    result = []
    for n, level in faces.values():
        corners = [p for p in points if dot(n, p) > level - 1e-5]
        middle = tuple(sum(p[i] for p in corners) / len(corners) for i in range(3))
        u = unit(sub(corners[0], middle))
        v = cross(n, u)
        corners.sort(key=lambda p: math.atan2(dot(sub(p, middle), v), dot(sub(p, middle), u)))
        result.append((n, corners))
    return result


class Drawing:
    """Bodies in a plane picture; those added first are behind."""

    def __init__(self, width, height, scale):
        self.commands = [f"set terminal pngcairo size {width}, {height} font 'DejaVu Sans,13'",
                         "unset tics", "unset border", "unset key",
                         f"set xrange [0:{width / scale}]", f"set yrange [0:{height / scale}]",
                         "set lmargin 0", "set rmargin 0", "set tmargin 0", "set bmargin 0",
                         "set size ratio -1"]
        eye = unit(EYE)
        self.right = unit(cross((0, 0, 1), eye))
        self.up = cross(eye, self.right)
        self.eye, self.objects, self.front = eye, 0, []

    def project(self, p, at):
        return at[0] + dot(p, self.right), at[1] + dot(p, self.up)

    def body(self, points, at, color):
        seen = [(n, c) for n, c in hull_faces(points) if dot(n, self.eye) > 0]
        seen.sort(key=lambda face: sum(dot(p, self.eye) for p in face[1]) / len(face[1]))
        for n, corners in seen:
            shade = 0.45 + 0.55 * max(0.0, dot(n, unit(LIGHT)))
            rgb = "".join(f"{int(shade * int(color[i:i + 2], 16)):02x}" for i in (0, 2, 4))
            path = " to ".join(f"{x:.5f},{y:.5f}" for x, y in
                               (self.project(p, at) for p in [*corners, corners[0]]))
            self.objects += 1
            self.commands.append(f"set object {self.objects} polygon from {path} fs solid "
                                 f"border lc rgb '#333333' fc rgb '#{rgb}' lw 0.7")

    def text(self, text, at):
        self.commands.append(f"set label '{text}' at {at[0]},{at[1]} center front")

    def mark(self, point, at):
        self.front.append(self.project(point, at))

    def write(self, path):
        if plots.WANTED and path.stem not in plots.WANTED:
            return
        data = [f"{x} {y}" for x, y in self.front] or ["-9 -9"]
        self.commands += [f"set output '{path}'", "$p << EOD", *data, "EOD",
                          "plot $p with points pt 7 ps 1.1 lc rgb '#b3261e'"]
        subprocess.run(["gnuplot"], input="\n".join(self.commands) + "\n", text=True, check=True)


def cube(size):
    return [(x, y, z) for x in (-size, size) for y in (-size, size) for z in (-size, size)]


STONE, UPPER = "b9b2a3", "8fa9c9"


def contact_types(path):
    """Two cubes in the six kinds of contact. Marks: the contact points of the study."""
    drawing = Drawing(1500, 430, 150)
    lower = cube(0.5)
    upper = cube(0.4)
    edge_down = rotated(upper, (0, 1, 0), 45)   # an edge along y is lowest
    # A corner is lowest: the diagonal of the cube is turned to the vertical.
    corner_down = rotated(upper, (1, -1, 0), math.degrees(math.acos(1 / math.sqrt(3))))
    edge = 0.4 * math.sqrt(2)
    corner = 0.4 * math.sqrt(3)
    lower_edge_up = rotated(lower, (0, 1, 0), 45)
    cases = [
        ("face–face: triple", lower, shifted(upper, (0, 0, 0.9)),
         [(-0.4, -0.4, 0.5), (0.4, -0.4, 0.5), (0, 0.4, 0.5)]),
        ("edge–face: double", lower, shifted(edge_down, (0, 0, 0.5 + edge)),
         [(0, -0.4, 0.5), (0, 0.4, 0.5)]),
        ("vertex–face: simple", lower, shifted(corner_down, (0, 0, 0.5 + corner)), [(0, 0, 0.5)]),
        ("edge–edge: simple", lower_edge_up,
         shifted(rotated(edge_down, (0, 0, 1), 90), (0, 0, 0.5 * math.sqrt(2) + edge)),
         [(0, 0, 0.5 * math.sqrt(2))]),
    ]
    for k, (name, below, above, points) in enumerate(cases):
        at = (1.25 + 2.5 * k, 1.08)
        drawing.body(below, at, STONE)
        drawing.body(above, at, UPPER)
        for point in points:
            drawing.mark(point, at)
        drawing.text(name, (at[0], 0.13))
    drawing.write(path)


def grain_shapes(grains, path):
    """Six of the thirty shapes of a sample, from a table of their vertices."""
    shapes = {}
    with open(grains, encoding="utf8") as file:
        for name, *point in csv.reader(file):
            shapes.setdefault(int(name), []).append(tuple(map(float, point)))
    chosen = sorted(shapes.values(), key=len)
    chosen = [chosen[round(k * (len(chosen) - 1) / 5)] for k in range(6)]
    drawing = Drawing(1500, 320, 118)
    for k, points in enumerate(chosen):
        at = (1.07 + 2.11 * k, 1.5)
        drawing.body(points, at, STONE)
        drawing.text(f"{len(points)} vertices, {2 * len(points) - 4} faces", (at[0], 0.2))
    drawing.write(path)


def snapshot(picture, path):
    """The picture of a packing with the force and the displacement of the wall."""
    if plots.WANTED and path.stem not in plots.WANTED:
        return
    commands = [
        "set terminal pngcairo size 900, 750 font 'DejaVu Sans,15'", f"set output '{path}'",
        "unset tics", "unset border", "unset key", "set lmargin 0", "set rmargin 0", "set tmargin 0",
        "set bmargin 0", "set xrange [0:1200]", "set yrange [0:1000]",
        "set arrow from 1060, 345 to 830, 420 lw 4 lc rgb '#b3261e' front",
        "set label 'f(t)' at 1070, 335 tc rgb '#b3261e' front font ',20'",
        "set arrow from 800, 95 to 935, 51 lw 3 lc rgb '#1f5fa8' front",
        "set label 'x' at 950, 50 tc rgb '#1f5fa8' front font ',20'",
        f"plot '{picture}' binary filetype=png with rgbimage"]
    subprocess.run(["gnuplot"], input="\n".join(commands) + "\n", text=True, check=True)
