"""Decisions with uncertainty and temperature: worked out by hand, and what is refused."""

from statistics import NormalDist

from support.daemon import DaemonTest

HOLE = "/v1/verdicts/25H7?measured_mm="


class Decisions(DaemonTest):
    def verdict(self, query):
        answer = self.daemon.get(HOLE + query)
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def test_conformance(self):
        # One limit counts: g is the 95 % quantile times u (JCGM 106, table 1), here 3.2897 um.
        guard = NormalDist().inv_cdf(0.95) * 2
        for measured, verdict in (("25.00329", "good"), ("25.003289", "indeterminate"), ("25.01771", "good"),
                                  ("25.017711", "indeterminate"), ("24.996711", "indeterminate"),
                                  ("24.99671", "rework"), ("25.02429", "reject")):
            with self.subTest(measured):
                found = self.verdict(f"{measured}&rule=conformance&uncertainty_um=2")
                self.assertEqual(found["verdict"], verdict)
                self.assertAlmostEqual(found["guard_band_um"], guard, places=8)
                true = NormalDist(float(measured), 0.002)
                self.assertAlmostEqual(found["conformance_probability"], true.cdf(25.021) - true.cdf(25), places=8)
                self.assertEqual(found["probability"], 0.95)
        self.assertEqual(self.verdict("25.0033&rule=conformance&uncertainty_um=2&probability=0.99")["verdict"],
                         "indeterminate")

    def test_both_limits_count_where_the_uncertainty_is_large(self):
        # At the middle of 21 um with u = 5.3 um lie 95.24 %; with 5.4 um 94.8 %, and no value is good.
        self.assertEqual(self.verdict("25.0105&rule=conformance&uncertainty_um=5.3")["verdict"], "good")
        for measured in ("25.0105", "25.1", "24"):
            self.assert_problem(self.daemon.get(f"{HOLE}{measured}&rule=conformance&uncertainty_um=5.4"), 422,
                                "rule.no_acceptance")

    def test_what_conformance_refuses(self):
        for query, status, code in (("", 422, "rule.invalid"), ("&uncertainty_um=0", 422, "rule.invalid"),
                                    ("&uncertainty_um=1&probability=1", 400, "query.invalid"),
                                    ("&uncertainty_um=1&probability=0.4", 400, "query.invalid")):
            with self.subTest(query):
                self.assert_problem(self.daemon.get(f"{HOLE}25.01&rule=conformance{query}"), status, code)

    def test_the_size_at_20_degrees_decides(self):
        # 25.0215 / (1 + 11.5e-6 * 5) = 25.020061...: too large as read, good at 20 degrees.
        found = self.verdict("25.0215&temperature_c=25&part_material=steel")
        self.assertEqual((found["measured_mm"], found["corrected_mm"], found["verdict"], found["deviation_um"],
                          found["excess_um"]), (25.0215, 25.020061, "good", 20.061, 0))
        # A scale at the part's temperature with the same expansion takes the correction back.
        found = self.verdict("25.0215&temperature_c=25&part_material=steel&scale_temperature_c=25"
                             "&scale_expansion_um_per_m_k=11.5")
        self.assertEqual((found["corrected_mm"], found["verdict"], found["excess_um"]), (25.0215, "reject", 0.5))
        self.assertNotIn("corrected_mm", self.verdict("25.0215&temperature_c=25"))

    def test_what_temperature_refuses(self):
        for query in ("part_material=steel", "temperature_c=25&part_material=wood",
                      "temperature_c=25&part_material=steel&part_expansion_um_per_m_k=11", "temperature_c=-300",
                      "temperature_c=25&part_expansion_um_per_m_k=-1"):
            with self.subTest(query):
                self.assert_problem(self.daemon.get(f"{HOLE}25.01&{query}"), 400, "query.invalid")


class Kept(DaemonTest):
    BUDGET = {"contributions": [{"name": "ring", "standard_uncertainty": 0.3},
                                {"name": "repeatability", "standard_uncertainty": 0.4}]}

    def put(self, path, body, **headers):
        return self.daemon.request("PUT", path, body, {k.replace("_", "-"): v for k, v in headers.items()})

    def test_a_budget_is_kept_under_a_name(self):
        path = "/v1/uncertainties/bore%20gauge%20%2F%20ring"
        first = self.put(path, self.BUDGET)
        self.assertEqual(first.status, 201, first)
        self.assertAlmostEqual(first.json["combined_standard_uncertainty"], 0.5, places=15)
        self.assertEqual(self.put(path, self.BUDGET).status, 200)
        found = self.daemon.get(path)
        self.assertEqual((found.json, found.headers["etag"]), (self.BUDGET, first.headers["etag"]))
        self.assertEqual([u["name"] for u in self.daemon.get("/v1/uncertainties").json["uncertainties"]],
                         ["bore gauge / ring"])
        self.assert_problem(self.put(path, self.BUDGET, If_None_Match="*"), 412, "precondition.failed")
        self.assert_problem(self.put(path, {"contributions": []}), 422, "request.invalid")
        self.assertEqual(self.daemon.request("DELETE", path).status, 204)
        self.assert_problem(self.daemon.request("DELETE", path), 404, "uncertainty.unknown")
        self.assert_problem(self.daemon.get(path), 404, "uncertainty.unknown")

    def test_a_gauge_in_use_names_its_budget_and_when_it_is_due(self):
        self.put("/v1/uncertainties/plug", self.BUDGET)
        path = "/v1/gauges-in-use/G-07"
        body = {"uncertainty": "plug", "calibration_due": "2027-03-31"}
        self.assertEqual([self.put(path, body).status for _ in range(2)], [201, 200])
        self.assertEqual(self.daemon.get(path).json, body)
        self.assertEqual(self.put(path, {"calibration_due": "2027-03-31T12:00:00+01:00"}).status, 200)
        for wrong, pointer, code in (({**body, "uncertainty": "none"}, "/uncertainty", "uncertainty.unknown"),
                                     ({**body, "calibration_due": "2027-02-30"}, "/calibration_due", "time.malformed"),
                                     ({}, "/calibration_due", "field.missing"),
                                     ({**body, "what": 1}, "/what", "field.unknown")):
            with self.subTest(wrong):
                problem = self.assert_problem(self.put(path, wrong), 422, "request.invalid")
                self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [(pointer, code)])
        self.assertEqual(self.daemon.request("DELETE", path).status, 204)
        self.assert_problem(self.daemon.get(path), 404, "gauge.unknown")
