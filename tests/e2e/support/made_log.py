"""The log of a station that is not there: its key, its tree and its signed batches, made from one record. Written after
RFC 8032, RFC 6962 and C2SP's signed-note and tlog-checkpoint, and no part of the service."""

import base64
import hashlib
import json
import secrets

P = 2**255 - 19
L = 2**252 + 27742317777372353535851937790883648493
D = -121665 * pow(121666, P - 2, P) % P


def add(a, b):
    """The sum of two points in extended coordinates."""
    A = (a[1] - a[0]) * (b[1] - b[0]) % P
    B = (a[1] + a[0]) * (b[1] + b[0]) % P
    C = 2 * a[3] * b[3] * D % P
    Z = 2 * a[2] * b[2] % P
    E, F, G, H = B - A, Z - C, Z + C, B + A
    return E * F % P, G * H % P, F * G % P, E * H % P


def base_point():
    y = 4 * pow(5, P - 2, P) % P
    square = (y * y - 1) * pow(D * y * y + 1, P - 2, P) % P
    x = pow(square, (P + 3) // 8, P)
    if (x * x - square) % P:
        x = x * pow(2, (P - 1) // 4, P) % P
    if x % 2:
        x = P - x
    return x, y, 1, x * y % P


DOUBLED = [base_point()]
while len(DOUBLED) < 253:
    DOUBLED.append(add(DOUBLED[-1], DOUBLED[-1]))


def times_base(scalar):
    """The encoded point `scalar` times the base point."""
    sum_ = 0, 1, 1, 0
    for point in DOUBLED:
        if scalar & 1:
            sum_ = add(sum_, point)
        scalar >>= 1
    inverse = pow(sum_[2], P - 2, P)
    x, y = sum_[0] * inverse % P, sum_[1] * inverse % P
    return (y | (x & 1) << 255).to_bytes(32, "little")


def number(*parts):
    return int.from_bytes(hashlib.sha512(b"".join(parts)).digest(), "little") % L


class Key:
    def __init__(self, name):
        self.name = name
        hashed = hashlib.sha512(secrets.token_bytes(32)).digest()
        self.scalar = (int.from_bytes(hashed[:32], "little") & (2**254 - 8) | 2**254) % L
        self.prefix = hashed[32:]
        self.public = times_base(self.scalar)
        typed = b"\1" + self.public
        self.id = hashlib.sha256(name.encode() + b"\n" + typed).digest()[:4]
        self.vkey = f"{name}+{self.id.hex()}+{base64.b64encode(typed).decode()}"

    def note(self, text):
        """The text, signed."""
        nonce = number(self.prefix, text.encode())
        point = times_base(nonce)
        rest = (nonce + number(point, self.public, text.encode()) * self.scalar) % L
        signature = base64.b64encode(self.id + point + rest.to_bytes(32, "little")).decode()
        return f"{text}\n— {self.name} {signature}\n"


class MadeLog:
    """Grows by records like one that a real station has answered: only the id is each time another."""

    def __init__(self, record, origin=None):
        self.origin = origin or secrets.token_hex(8)
        self.key = Key(f"fitgauge/cell-{self.origin[-4:]}/{self.origin[:8]}")
        self.before, self.after = record.split(json.loads(record)["id"])
        self.size = 0
        self.frontier = []  # of each whole subtree, from the left: its size and its root

    def append(self, record):
        self.size += 1
        here = 1, hashlib.sha256(b"\0" + record.encode()).digest()
        while self.frontier and self.frontier[-1][0] == here[0]:
            size, left = self.frontier.pop()
            here = 2 * size, hashlib.sha256(b"\1" + left + here[1]).digest()
        self.frontier.append(here)

    def root(self):
        root = self.frontier[-1][1]
        for _, left in self.frontier[-2::-1]:
            root = hashlib.sha256(b"\1" + left + root).digest()
        return root

    def batch(self, rows):
        """The path and the body of the next rows."""
        path = f"/v1/log/{self.origin}/{self.size + 1}"
        records = []
        for _ in range(rows):
            records.append(f"{self.before}m{self.size + 1}-{self.origin}{self.after}")
            self.append(records[-1])
        text = f"{self.key.name}\n{self.size}\n{base64.b64encode(self.root()).decode()}\n"
        heading = json.dumps({"checkpoint": self.key.note(text), "key": self.key.vkey})
        return path, "\n".join([heading, *records]) + "\n"
