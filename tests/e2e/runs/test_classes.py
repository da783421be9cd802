"""Program 82551 against GET /v1/limits: every class of 8255 in every size range to 400 mm, with a part in
the middle, on both limits and 0.1 um outside of each."""

import concurrent.futures
import threading
from decimal import Decimal

from support.control import BLOCK, ControlTest, workpiece

HOLES = ("D10 E9 F7 F8 G7 G9 H6 H7 H8 H9 H11 H12 H13 JS7 JS9 K6 K7 M6 M7 N7 N9 P7 P9 R7").split()
SHAFTS = ("d9 e8 f7 g6 h5 h6 h7 h8 h9 h11 js5 js6 js13 js14 k5 k6 m5 m6 n6 p6 r6 s6 s7").split()
RANGES_TO_400 = 23
STEP = Decimal("0.0001")
# A small ball on a long stylus, so that it enters the smallest bore.
MACHINE = {"tools": [{"number": 30, "name": "PROBE", "length_mm": 120, "radius_mm": Decimal("0.4"), "probe": 1}]}


def part(is_hole, diameter):
    if is_hole:
        return workpiece(BLOCK, {"type": "bore", "center_mm": [0, 0], "top_mm": 0, "depth_mm": 40,
                                 "diameter_mm": diameter}, **MACHINE)
    return workpiece(BLOCK, {"type": "boss", "center_mm": [0, 0], "top_mm": 30, "height_mm": 30,
                             "diameter_mm": diameter}, **MACHINE)


class Classes(ControlTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.upload_examples(cls())
        cls.local = threading.local()
        cls.sizes = [row["up_to_mm"] for row in cls.client().table("hole", ["H7"])[:RANGES_TO_400]]

    @classmethod
    def client(cls):
        """A client for each thread."""
        if not hasattr(cls.local, "client"):
            cls.local.client = cls.daemon.client()
            cls.addClassCleanup(cls.local.client.close)
        return cls.local.client

    def gauge(self, size, tolerance_class, diameter):
        is_hole = tolerance_class[0].isupper()
        return self.client().run_program(
            "TNC:\\nc_prog\\8255\\82551.h", part(is_hole, diameter),
            parameters={"Q1": size, "QS1": tolerance_class, "Q11": 0, "Q21": 0,
                        "Q31": -10 if is_hole else 15, "Q41": 0, "Q51": 0})

    def differences(self, tolerance_class, size):
        """What is not as it should be for one class and size."""
        limits = self.client().limits_of(size, tolerance_class)
        upper, lower = limits["upper_limit_mm"], limits["lower_limit_mm"]
        above, below = ("reject", "rework") if tolerance_class[0].isupper() else ("rework", "reject")
        parts = {(upper + lower) / 2: "good", upper: "good", lower: "good",
                 upper + STEP: above, lower - STEP: below}
        found = []
        for diameter, verdict in parts.items():
            run = self.gauge(size, tolerance_class, diameter)
            q = run["parameters"]
            result = (run["status"], run["verdict"], q.get("Q23"), q.get("Q33"), round(q.get("Q153", 0), 6))
            if result != ("completed", verdict, upper, lower, diameter):
                found.append((size, tolerance_class, diameter, result))
        return found

    def test_limits_and_status_of_every_class_and_range(self):
        self.assertEqual(len(HOLES) + len(SHAFTS), 47)
        self.assertEqual(self.sizes[-1], 400)
        pairs = [(name, size) for name in HOLES + SHAFTS for size in self.sizes]
        with concurrent.futures.ThreadPoolExecutor(4) as threads:
            results = threads.map(lambda pair: self.differences(*pair), pairs)
            found = [entry for result in results for entry in result]
        self.assertEqual(found, [])
