#!/usr/bin/env python3
"""compare_limits.py DATA_FOLDER DUMP_EXECUTABLE

Computes the limits of size of every class of ISO 286-1 from the CSV files, by the tables alone and
in whole nanometres, and compares them with every line the executable prints. Shares nothing with the
library but the files. Exit code 1 names the first lines that differ.
"""

import csv
import functools
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

LETTERS = ("A B C CD D E EF F FG G H J JS K M N P R S T U V X Y Z ZA ZB ZC").split()
GRADES = ["01", "0"] + [str(n) for n in range(1, 19)]
# Every class that program 8255 brings: none of them may be missing from the comparison.
CLASSES_OF_8255 = (
    "D10 E9 F7 F8 G7 G9 H6 H7 H8 H9 H11 H12 H13 JS7 JS9 K6 K7 M6 M7 N7 N9 P7 P9 R7 "
    "d9 e8 f7 g6 h5 h6 h7 h8 h9 h11 js5 js6 js13 js14 k5 k6 m5 m6 n6 p6 r6 s6 s7").split()


MM = 10**6  # nanometres


def nanometres(text, unit):
    """The exact value; anything finer than a nanometre would be an error of the file."""
    value = Fraction(text) * unit
    assert value.denominator == 1, text
    return int(value)


def read(path):
    """The rows as (over, up to, {column: deviation}), blanks left out."""
    rows = []
    with path.open(newline="", encoding="utf-8") as file:
        for record in csv.DictReader(file):
            over, to = nanometres(record.pop("over_mm"), MM), nanometres(record.pop("to_mm"), MM)
            values = {name: nanometres(text, 1000) for name, text in record.items()
                      if text and not text.startswith("+-")}
            rows.append((over, to, values))
    return rows


class Table:
    def __init__(self, path):
        self.rows = read(path)
        self.row = functools.lru_cache(maxsize=None)(self.find_row)

    def find_row(self, size):
        return next(values for over, to, values in self.rows if over < size <= to)


class Standard:
    def __init__(self, folder):
        self.grades = Table(folder / "it_grades.csv")
        self.holes = Table(folder / "hole_fundamental_deviations.csv")
        self.shafts = Table(folder / "shaft_fundamental_deviations.csv")

    def limits(self, letter, grade, size):
        """(upper, lower) limit, or None where the standard has no such class."""
        deviations = self.deviations(letter, grade, size)
        if deviations is None:
            return None
        upper, lower = (size + deviation for deviation in deviations)
        return (upper, lower) if lower > 0 else None

    def deviations(self, letter, grade, size):
        number = {"01": -1}.get(grade, int(grade))
        it = self.grades.row(size).get("IT" + grade)
        if it is None:
            return None
        if size <= 1 * MM:
            if number >= 14 or letter.upper() in ("A", "B"):
                return None
            if letter == "N" and number > 8:
                return None
        if letter.upper() == "JS":
            return it // 2, it // 2 - it
        if letter.isupper():
            return self.hole(letter, number, grade, size, it)
        return self.shaft(letter, number, grade, size, it)

    def shaft(self, letter, number, grade, size, it):
        row = self.shafts.row(size)
        if letter in [other.lower() for other in LETTERS[:11]]:
            es = row.get("es_" + letter)
            return None if es is None else (es, es - it)
        if letter == "j":
            ei = row.get("ei_j" + grade)
        elif letter == "k":
            ei = row["ei_k_IT4_to_IT7" if 4 <= number <= 7 else "ei_k_le_IT3_or_gt_IT7"]
        else:
            ei = row.get("ei_" + letter)
        return None if ei is None else (ei + it, ei)

    def hole(self, letter, number, grade, size, it):
        row = self.holes.row(size)
        if letter in LETTERS[:11]:
            ei = row.get("EI_" + letter)
            return None if ei is None else (ei + it, ei)
        if letter == "J":
            es = row.get("ES_J" + grade)
        elif letter == "M" and number == 6 and 250 * MM < size <= 315 * MM:
            es = -9000
        elif letter in "KMN":
            es = row.get(f"ES_{letter}_gt_IT8") if number > 8 else self.with_delta(
                row.get(f"ES_{letter}_le_IT8_base"), row, number, size)
        else:
            es = row.get(f"ES_{letter}_gt_IT7")
            if number <= 7:
                es = self.with_delta(es, row, number, size)
        return None if es is None else (es, es - it)

    @staticmethod
    def with_delta(base, row, number, size):
        if base is None:
            return None
        if number >= 3:
            return base + row[f"delta_IT{number}"]
        return base if size <= 3 * MM or size > 500 * MM else None


def main(folder, executable):
    standard = Standard(Path(folder))
    names = {}
    for letter in LETTERS:
        for grade in GRADES:
            names[letter + grade] = (letter, grade)
            names[letter.lower() + grade] = (letter.lower(), grade)
    dump = subprocess.run([executable], check=True, capture_output=True, text=True).stdout
    compared, defined, differing = set(), 0, []
    for line in dump.splitlines():
        name, size, *found = line.split()
        compared.add((name, size))
        expected = standard.limits(*names[name], int(size))
        wanted = ["-"] if expected is None else [str(limit) for limit in expected]
        defined += expected is not None
        if found != wanted:
            differing.append(f"{name} at {size} nm: library {found}, tables {wanted}")
    sizes = {int(size) for _, size in compared}
    missing = len(names) * len(sizes) - len(compared)
    steps = sum(len({size for size in sizes if over < size <= to}) < 2
                for over, to, _ in standard.holes.rows)
    lost = [name for name in CLASSES_OF_8255 if name not in {found for found, _ in compared}]
    print(f"{len(compared)} classes and sizes, {defined} defined, {len(differing)} differ")
    print("\n".join(differing[:20]))
    if differing or missing or steps or lost or defined < 80_000:
        print(f"{missing} not printed, {steps} steps not covered, of 8255 not printed: {lost}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
