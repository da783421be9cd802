"""Uncertainty of temperature and expansion: what it adds to u, and what is refused."""

from statistics import NormalDist

from support.daemon import DaemonTest

HOLE = "/v1/verdicts/25H7?measured_mm="


class AddedUncertainty(DaemonTest):
    """What the correction to 20 degrees adds. JCGM 100:2008, H.1 (50 mm, 11.5 um/(m K) to +-1, 0.1 K from 20 degrees
    to +-0.05 K) has 2.9 nm for the expansion and 16.6 nm for the temperature."""

    END_GAUGE = {"nominal_mm": 50, "feature": "shaft", "upper_um": 1, "lower_um": -1, "measured_mm": "50.000838",
                 "temperature_c": "19.9", "part_expansion_um_per_m_k": "11.5"}
    HALF = {"temperature_uncertainty_c": "0.028868", "part_expansion_uncertainty_um_per_m_k": "0.57735"}

    def record(self, **fields):
        answer = self.daemon.measure({**self.END_GAUGE, **fields})
        self.assertEqual(answer.status, 201, answer)
        record = {name: value for name, value in answer.json.items() if name != "warnings"}
        self.assertEqual(self.daemon.get(f"/v1/measurements/{record['id']}").json, record)
        return record

    def test_the_end_gauge_of_the_guide(self):
        for name, nanometres in (("part_expansion_uncertainty_um_per_m_k", 2.9), ("temperature_uncertainty_c", 16.6)):
            found = self.record(**{name: self.HALF[name]})
            self.assertEqual(round(found["added_uncertainty_um"] * 1000, 1), nanometres)
            self.assertEqual((found[name], found["measured_mm"]), (float(self.HALF[name]), 50.000838))
        both = self.record(**self.HALF)["added_uncertainty_um"]
        self.assertAlmostEqual(both, (0.0028868 ** 2 + 0.0166 ** 2) ** 0.5, places=5)
        # A record without an uncertainty of the correction is what it was.
        self.assertEqual({name for name in self.record() if "uncertainty" in name}, set())
        self.assertEqual(self.record(temperature_uncertainty_c=0)["added_uncertainty_um"], 0)

    def test_the_rule_decides_with_both(self):
        """100 mm at 30 degrees, u(t) = 0.5 K of 11.5 um/(m K), u(alpha) = 0: L alpha u = 0.575 um; with u = 0.8 um
        that is 0.98521 um, and the guard band of k = 2 is 1.972 um as it is rounded up."""
        part = {"nominal_mm": 100, "feature": "hole", "upper_um": 21, "lower_um": 0, "temperature_c": 30,
                "part_expansion_um_per_m_k": "11.5", "uncertainty_um": "0.8", "temperature_uncertainty_c": "0.5"}
        reading = 1 + 11.5e-6 * 10

        def judged(size, **fields):
            answer = self.daemon.measure({**part, "measured_mm": f"{size * reading:.9f}", **fields})
            self.assertEqual(answer.status, 201, answer)
            self.assertEqual(answer.json["corrected_mm"], size)
            return answer.json

        for size, verdict in ((100.001972, "good"), (100.001971, "indeterminate"), (100.019028, "good"),
                              (100.019029, "indeterminate"), (99.998028, "indeterminate"), (99.998027, "rework")):
            found = judged(size, rule="guard_band")
            self.assertEqual((found["verdict"], found["uncertainty_um"]), (verdict, 0.8), size)
            self.assertAlmostEqual(found["added_uncertainty_um"], 0.575, places=3)
        # Without it the band is 1.6 um: the same size is good.
        del part["temperature_uncertainty_c"]
        self.assertEqual(judged(100.001601, rule="guard_band")["verdict"], "good")
        part["temperature_uncertainty_c"] = "0.5"
        found = judged(100.001972, rule="conformance")
        self.assertAlmostEqual(found["guard_band_um"], NormalDist().inv_cdf(0.95) * 0.986, places=8)
        # Nothing but what the correction adds: the degrees of freedom of a reading without uncertainty count for nothing.
        known = judged(100.001972, rule="conformance", uncertainty_um=0)["guard_band_um"]
        self.assertEqual(judged(100.001972, rule="conformance", uncertainty_um=0, degrees_of_freedom=1)["guard_band_um"], known)
        found = judged(100.001972, rule="simple")
        self.assertEqual((found["verdict"], found["uncertainty_um"]), ("good", 0.8))
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_question_and_a_record_say_the_same(self):
        steel = {"temperature_c": 25, "part_material": "steel", "scale_temperature_c": "19.5",
                 "scale_material": "glass_scale"}
        for rule in ({"rule": "guard_band", "uncertainty_um": 1}, {"rule": "conformance", "uncertainty_um": 1}, {}):
            fields = {**steel, **rule, "temperature_uncertainty_c": "0.3", "scale_temperature_uncertainty_c": "0.2",
                      "scale_expansion_uncertainty_um_per_m_k": "0.5"}
            asked = self.daemon.get(f"{HOLE}25.0215&" + "&".join(f"{k}={v}" for k, v in fields.items())).json
            record = self.daemon.measure({"designation": "25 H7", "measured_mm": "25.0215", **fields}).json
            for name, value in asked.items():
                self.assertEqual(record[name], value, name)
            # The four contributions; that of steel is +-1 um/(m K), rectangular (ISO 3650:1998, 6.2.2).
            size = 25.0215 * (1 + 8e-6 * -0.5) / (1 + 11.5e-6 * 5)
            stretched = 1 + 11.5e-6 * 5, 1 - 8e-6 * 0.5
            parts = [11.5 * 0.3 / stretched[0], 5 * 3 ** -0.5 / stretched[0], 8 * 0.2 / stretched[1], 0.25 / stretched[1]]
            self.assertAlmostEqual(asked["added_uncertainty_um"], sum(p * p for p in parts) ** 0.5 * size / 1000, places=6)
        row = self.daemon.get("/v1/measurements?last=1", Accept="text/csv").text.splitlines()
        row = dict(zip(row[0].split(","), row[1].split(",")))
        for name in ("added_uncertainty_um", "temperature_uncertainty_c", "scale_temperature_uncertainty_c",
                     "scale_expansion_uncertainty_um_per_m_k"):
            self.assertEqual(float(row[name]), record[name], name)
        self.assertEqual(row["part_expansion_uncertainty_um_per_m_k"], "")
        # What is written as CSV is taken again: the same record.
        names = [name for name in row if name in ("designation", *fields)]
        text = ",".join(["designation,measured_mm", *names]) + "\n" + ",".join(["25H7,25.0215", *(row[n] for n in names)])
        answer = self.daemon.request("POST", "/v1/measurements", text.encode(),
                                     {"Content-Type": "text/csv", "Prefer": "return=representation"})
        again, = answer.json["measurements"]
        self.assertEqual(again["added_uncertainty_um"], record["added_uncertainty_um"])

    def test_a_correction_keeps_it(self):
        given = {"rule": "guard_band", "uncertainty_um": 1, "measured_mm": "50.000001"}
        record = self.record(**given, **self.HALF)
        path = f"/v1/measurements/{record['id']}/corrections"
        again = self.daemon.post(path, {"measured_mm": "50.000838", "reason": "misread"}).json
        self.assertAlmostEqual(again["added_uncertainty_um"], 0.016849, places=6)
        # Another coefficient is not known as well as that one.
        path = f"/v1/measurements/{again['id']}/corrections"
        other = self.daemon.post(path, {"measured_mm": "50.000838", "part_material": "steel", "reason": "steel"}).json
        self.assertNotIn("part_expansion_uncertainty_um_per_m_k", other)
        self.assertAlmostEqual(other["added_uncertainty_um"], 0.016849, places=6)

    def test_what_is_refused(self):
        for fields, pointer, code in (
                ({"temperature_uncertainty_c": -1}, "/temperature_uncertainty_c", "number.out_of_range"),
                ({"temperature_uncertainty_c": 1001}, "/temperature_uncertainty_c", "number.out_of_range"),
                ({"temperature_uncertainty_c": True}, "/temperature_uncertainty_c", "field.type"),
                ({"scale_temperature_uncertainty_c": "0.1"}, "/scale_expansion_um_per_m_k", "field.missing"),
                ({"scale_expansion_uncertainty_um_per_m_k": 1}, "/scale_expansion_um_per_m_k", "field.missing"),
                ({"rule": "conformance", "uncertainty_um": "0.5", "temperature_uncertainty_c": 1}, "/uncertainty_um",
                 "rule.no_acceptance"),
                ({"rule": "guard_band", "temperature_uncertainty_c": 1}, "/uncertainty_um", "field.missing")):
            with self.subTest(fields):
                answer = self.daemon.measure({**self.END_GAUGE, **fields})
                problem = self.assert_problem(answer, 422, "request.invalid")
                self.assertEqual([(each["pointer"], each["code"]) for each in problem["errors"]], [(pointer, code)])
        answer = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "temperature_c": 21,
                                      "temperature_uncertainty_c": 1})
        self.assertIn("part_material", self.assert_problem(answer, 422, "request.invalid")["errors"][0]["detail"])
