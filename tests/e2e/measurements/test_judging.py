"""Limits of the tables, of a drawing, and the guard band: the verdict of each side of each limit."""

from support.daemon import DaemonTest


class Judging(DaemonTest):
    def verdict(self, measured, **fields):
        answer = self.daemon.measure({"measured_mm": measured, **fields})
        self.assertEqual(answer.status, 201, answer)
        return answer.json["verdict"]

    def test_limits_are_inclusive(self):
        hole = {"designation": "25 H7"}
        self.assertEqual(self.verdict("25.021", **hole), "good")
        self.assertEqual(self.verdict("25.021001", **hole), "reject")
        self.assertEqual(self.verdict("25", **hole), "good")
        self.assertEqual(self.verdict("24.999999", **hole), "rework")
        shaft = {"nominal_mm": 25, "tolerance_class": "g6"}
        self.assertEqual(self.verdict("24.993", **shaft), "good")
        self.assertEqual(self.verdict("24.993001", **shaft), "rework")
        self.assertEqual(self.verdict("24.98", **shaft), "good")
        self.assertEqual(self.verdict("24.979999", **shaft), "reject")

    def test_the_guard_band(self):
        # H7: 25.000 to 25.021; u = 0.8 um and k = 2.5 keep 2 um from either limit.
        band = {"designation": "25 H7", "rule": "guard_band", "uncertainty_um": 0.8,
                "coverage_factor": 2.5}
        for measured, verdict in (
                ("24.997999", "rework"), ("24.998", "indeterminate"), ("25.001999", "indeterminate"),
                ("25.002", "good"), ("25.019", "good"), ("25.019001", "indeterminate"),
                ("25.023", "indeterminate"), ("25.023001", "reject")):
            with self.subTest(measured):
                self.assertEqual(self.verdict(measured, **band), verdict)

    def test_the_coverage_factor_defaults_to_2(self):
        record = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.0194",
                                      "rule": "guard_band", "uncertainty_um": "0.8"}).json
        self.assertEqual((record["verdict"], record["coverage_factor"], record["uncertainty_um"]),
                         ("good", 2, 0.8))

    def test_the_guard_band_needs_the_uncertainty(self):
        answer = self.daemon.measure({"designation": "25 H7", "measured_mm": 25,
                                      "rule": "guard_band"})
        problem = self.assert_problem(answer, 422, "request.invalid")
        self.assertEqual(problem["errors"][0]["pointer"], "/uncertainty_um")

    def test_an_uncertainty_is_kept_under_the_simple_rule(self):
        record = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.021,
                                      "uncertainty_um": 5}).json
        self.assertEqual((record["verdict"], record["uncertainty_um"]), ("good", 5))

    def test_fields_of_fixed_width_are_read(self):
        """An ERP pads what it sends: the blanks are no part of the size, and a record does not have them."""
        plain = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01"}).json
        said = ("designation", "nominal_mm", "tolerance_class", "verdict")
        padded = [{"designation": "25 H7   ", "measured_mm": "25.01"},
                  {"nominal_mm": 25, "tolerance_class": "H7  ", "measured_mm": "25.01"}]
        answers = [self.daemon.measure(each) for each in padded]
        rows = "designation;measured_mm\n  25 H7  ;25,01\n"
        answers.append(self.daemon.post("/v1/measurements", rows, {"Content-Type": "text/csv", "Prefer": "return=representation"}))
        for answer in answers:
            self.assertEqual(answer.status, 201, answer)
            record = answer.json.get("measurements", [answer.json])[0]
            self.assertEqual([record[name] for name in said], [plain[name] for name in said])
        self.assertEqual(self.daemon.measure({"designation": "25 ISO 2768-m ", "measured_mm": 25}).status, 201)
        found = self.daemon.get("/v1/measurements?designation=25%20H7%20&last=1").json["measurements"]
        self.assertEqual([each["designation"] for each in found], ["25 H7"])
        self.assertEqual(self.daemon.get("/v1/verdicts/25H7%20?measured_mm=25.01").json["verdict"], "good")
        for path in ("/v1/fits/25H7%20/g6%20", "/v1/fits/25H7%2Fg6%20", "/v1/gauges/25H7%20"):
            self.assertEqual(self.daemon.get(path).status, 200, path)

    def test_the_limits_of_a_drawing(self):
        drawing = {"nominal_mm": "12.5", "feature": "shaft", "upper_um": "0.5", "lower_um": "-0.75"}
        record = self.daemon.measure({**drawing, "measured_mm": "12.500501"}).json
        self.assertEqual((record["basis"], record["verdict"], record["excess_um"],
                          record["upper_limit_mm"], record["lower_limit_mm"]),
                         ("explicit", "rework", 0.001, 12.5005, 12.49925))
        for absent in ("designation", "tolerance_class", "table_revision", "size_range_mm"):
            self.assertNotIn(absent, record)
        self.assertEqual(self.verdict("12.49925", **drawing), "good")
        self.assertEqual(self.verdict("12.49924", **drawing), "reject")

    def test_every_field_is_echoed(self):
        given = {"nominal_mm": 25, "tolerance_class": "H7", "measured_mm": 25.013,
                 "part_id": "SN-0001", "characteristic": "bore-A", "order": "WO-17",
                 "operation": "OP20", "machine": "M3", "operator": "42", "gauge": "G-07",
                 "uncertainty_um": 0.8, "rule": "simple", "temperature_c": 20.4, "unit": "line 2",
                 "comment": "Ø \"gehont\"\n"}
        record = self.daemon.measure({**given, "measured_at": "2026-11-20T08:00:00+01:00"}).json
        self.assertEqual({name: record[name] for name in given}, given)
        self.assertEqual(record["measured_at"], "2026-11-20T07:00:00Z")
