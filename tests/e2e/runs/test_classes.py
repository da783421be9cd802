"""Program 82551 against GET /v1/limits: every class of 8255 in every size range to 400 mm."""

from decimal import Decimal

from support.control import BLOCK, ControlTest, workpiece

HOLES = ("D10 E9 F7 F8 G7 G9 H6 H7 H8 H9 H11 H12 H13 JS7 JS9 K6 K7 M6 M7 N7 N9 P7 P9 R7").split()
SHAFTS = ("d9 e8 f7 g6 h5 h6 h7 h8 h9 h11 js5 js6 js13 js14 k5 k6 m5 m6 n6 p6 r6 s6 s7").split()
RANGES_TO_400 = 23
# A small ball on a long stylus, so that it enters the smallest bore.
MACHINE = {"tools": [{"number": 30, "name": "PROBE", "length_mm": 120, "radius_mm": Decimal("0.4"), "probe": 1}]}


def part(tolerance_class, diameter):
    if tolerance_class[0].isupper():
        return workpiece(BLOCK, {"type": "bore", "center_mm": [0, 0], "top_mm": 0, "depth_mm": 40,
                                 "diameter_mm": diameter}, **MACHINE)
    return workpiece(BLOCK, {"type": "boss", "center_mm": [0, 0], "top_mm": 30, "height_mm": 30,
                             "diameter_mm": diameter}, **MACHINE)


class Classes(ControlTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.upload_examples(cls())
        cls.client = cls.daemon.client()
        cls.addClassCleanup(cls.client.close)
        cls.sizes = [row["up_to_mm"] for row in cls.client.table("hole", ["H7"])[:RANGES_TO_400]]

    def gauge(self, size, tolerance_class, diameter):
        height = -10 if tolerance_class[0].isupper() else 15
        run = self.client.run_program("TNC:\\nc_prog\\8255\\82551.h", part(tolerance_class, diameter),
                                      parameters={"Q1": size, "QS1": tolerance_class, "Q11": 0, "Q21": 0,
                                                  "Q31": height, "Q41": 0, "Q51": 0})
        self.assertEqual(run["status"], "completed", run["messages"])
        return run

    def limits(self, size, tolerance_class):
        limits = self.client.limits_of(size, tolerance_class)
        return limits["upper_limit_mm"], limits["lower_limit_mm"]

    def test_limits_of_every_class_and_range(self):
        self.assertEqual(len(HOLES) + len(SHAFTS), 47)
        self.assertEqual(self.sizes[-1], 400)
        for tolerance_class in HOLES + SHAFTS:
            for size in self.sizes:
                with self.subTest(tolerance_class=tolerance_class, size=size):
                    upper, lower = self.limits(size, tolerance_class)
                    run = self.gauge(size, tolerance_class, (upper + lower) / 2)
                    q = run["parameters"]
                    self.assertEqual((q["Q23"], q["Q33"]), (upper, lower))
                    self.assertEqual(run["verdict"], "good")

    def test_status_on_both_limits_and_just_outside(self):
        step = Decimal("0.0001")
        for tolerance_class in HOLES + SHAFTS:
            hole = tolerance_class[0].isupper()
            for size in (3, 30, 400):
                upper, lower = self.limits(size, tolerance_class)
                expected = {upper: "good", lower: "good",
                            upper + step: "reject" if hole else "rework",
                            lower - step: "rework" if hole else "reject"}
                for diameter, verdict in expected.items():
                    with self.subTest(tolerance_class=tolerance_class, diameter=diameter):
                        run = self.gauge(size, tolerance_class, diameter)
                        self.assertEqual(run["verdict"], verdict)
