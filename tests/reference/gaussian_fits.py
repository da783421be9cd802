#!/usr/bin/env python3
"""gaussian_fits.py REFERENCES_FOLDER [--print]

Fits every circle, sphere, plane and cylinder of data.txt to 50 digits, and compares expected.txt with
that. The least squares of the distances are found by Gauss-Newton in decimal arithmetic with 120
digits; derivatives are difference quotients over 1e-55, so that nothing is shared with the library but
the points. Exit code 1 names the figures that differ. --print writes the lines of expected.txt.
"""

import sys
from decimal import Decimal as D
from decimal import getcontext
from pathlib import Path

getcontext().prec = 120
STEP, SETTLED = D("1e-55"), D("1e-50")
LIMIT_OF_DIRECTION = "1e-11"  # a lever of 100 mm makes 1e-9 mm of it
WORDS = {"x": "centre in X / mm", "y": "centre in Y / mm", "z": "centre in Z / mm", "r": "radius / mm",
         "a": "direction in X", "b": "direction in Y", "c": "direction in Z", "d": "distance from zero / mm"}


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def norm(a):
    return dot(a, a).sqrt()


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def mean(points):
    return [sum(column) / len(points) for column in zip(*points)]


def solve(matrix, right):
    """Gauss elimination with the largest pivot."""
    rows = [row + [value] for row, value in zip(matrix, right)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [value / rows[k][k] for value in rows[k]]
        for i, row in enumerate(rows):
            if i != k:
                rows[i] = [value - row[k] * own for value, own in zip(row, rows[k])]
    return [row[-1] for row in rows]


def least_squares(residual, points, values):
    """The values with the least sum of residual(point, values) squared, from a start near them."""
    for _ in range(500):
        at = [residual(p, values) for p in points]
        columns = []
        for k in range(len(values)):
            beside = values[:k] + [values[k] + STEP] + values[k + 1:]
            columns.append([(residual(p, beside) - own) / STEP for p, own in zip(points, at)])
        step = solve([[dot(a, b) for b in columns] for a in columns], [-dot(a, at) for a in columns])
        values = [value + change for value, change in zip(values, step)]
        if norm(step) < SETTLED:
            return values
    raise SystemExit("a search does not settle")


def circle(rows):
    x, y = mean(rows)
    return dict(zip("xyr", least_squares(ball, rows, [x, y, norm(minus(rows[0], [x, y]))])))


def ball(point, values):
    return norm(minus(point, values[:-1])) - values[-1]


def sphere(rows):
    return dict(zip("xyzr", least_squares(ball, rows[1:], rows[0])))


def plane(rows):
    """First row: the axis along which the normal is positive. The answer has the distance of the plane
    from zero along the normal."""
    main, rows = rows[0].index(1), rows[1:]
    sides = [minus(p, rows[0]) for p in rows[1:]]
    guess = max((cross(a, b) for a in sides for b in sides), key=norm)
    others = [k for k in range(3) if k != main]

    def normal(a, b):
        n = [D(1)] * 3
        n[others[0]], n[others[1]] = a, b
        return [value / norm(n) for value in n]

    slope = [guess[k] / guess[main] for k in others]
    start = slope + [dot(normal(*slope), mean(rows))]
    a, b, d = least_squares(lambda p, v: dot(p, normal(v[0], v[1])) - v[2], rows, start)
    return dict(zip("abcd", normal(a, b) + [d]))


def cylinder(rows):
    """First row: a point of the axis near it, its direction, the radius. The answer's point is the
    nearest of the axis to the points' mean."""
    (x, y, z, *direction, radius), points = rows[0], rows[1:]
    main = max(range(3), key=lambda k: abs(direction[k]))
    others = [k for k in range(3) if k != main]
    centre = mean(points)

    def axis(v):
        at, along = list(centre), [D(1)] * 3
        for i, k in enumerate(others):
            at[k], along[k] = v[i], v[i + 2]
        return at, along

    def residual(p, v):
        at, along = axis(v)
        return norm(cross(minus(p, at), along)) / norm(along) - v[4]

    slope = [direction[k] / direction[main] for k in others]
    near = [x, y, z]
    start = [near[k] + s * (centre[main] - near[main]) for k, s in zip(others, slope)]
    values = least_squares(residual, points, start + slope + [radius])
    at, along = axis(values)
    size = norm(along).copy_sign(direction[main])
    along = [value / size for value in along]
    way = dot(minus(centre, at), along)
    at = [p + way * a for p, a in zip(at, along)]
    return dict(zip("xyzabcr", at + along + [values[4]]))


def sets(folder):
    name, found = "", {}
    for line in (folder / "data.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("=="):
            name = line.split()[1]
        elif line and not line.startswith("#") and name.split(".")[0] in FITS:
            found.setdefault(name, []).append([D(word) for word in line.split()])
    return found


FITS = {"circle": circle, "sphere": sphere, "plane": plane, "cylinder": cylinder}


def main():
    folder = Path(sys.argv[1])
    lines = (folder / "expected.txt").read_text(encoding="utf-8").splitlines()
    expected = {words[0]: words[1:3] for words in map(str.split, lines) if len(words) > 2}
    compared, wrong = 0, []
    for name, rows in sets(folder).items():
        for figure, value in FITS[name.split(".")[0]](rows).items():
            figure_id = f"{name}.{figure}"
            if "--print" in sys.argv:
                limit = LIMIT_OF_DIRECTION if figure in "abc" else "1e-9"
                print(figure_id, f"{value:.15g}", limit, WORDS[figure])
                continue
            compared += 1
            printed = expected.get(figure_id)
            # The last of 14 or 15 printed digits is rounded.
            if printed is None or abs(D(printed[0]) - value) > max(abs(value), D(1)) * D("1e-13"):
                wrong.append(f"{figure_id}: {printed} instead of {value:.20g}")
    print("\n".join(wrong) or f"{compared} figures agree")
    return 1 if wrong or not (compared or "--print" in sys.argv) else 0


if __name__ == "__main__":
    sys.exit(main())
