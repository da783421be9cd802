"""Decisions with degrees of freedom: k and probabilities by Student's t in closed form."""

from math import atan, cos, pi, sin, sqrt
from random import Random

from support.daemon import DaemonTest

HOLE = "/v1/verdicts/25H7?measured_mm="


def t_below(t, nu):
    """Student's t of whole degrees of freedom in closed form (Abramowitz and Stegun 26.7.3 and 26.7.4)."""
    theta = atan(t / sqrt(nu))
    if nu == 1:
        inside = 2 * theta / pi
    else:
        term = total = cos(theta) if nu % 2 else 1.0
        for k in range(3 if nu % 2 else 2, nu - 1, 2):
            term *= cos(theta) ** 2 * (k - 1) / k
            total += term
        inside = 2 / pi * (theta + sin(theta) * total) if nu % 2 else sin(theta) * total
    return (1 + inside) / 2


class DegreesOfFreedom(DaemonTest):
    def test_a_thousand_decisions_as_the_closed_form_has_them(self):
        random = Random(31)
        decided = {word: 0 for word in ("good", "rework", "reject", "indeterminate")}
        for _ in range(1000):
            nu = random.choice([1, 2, 3, 4, 5, 8, 13, 30, 99])
            u = random.randrange(200, 3000) / 1000
            p = random.choice([0.5, 0.8, 0.9, 0.95])
            measured = random.randrange(24_994_000, 25_027_000) / 1e6
            answer = self.daemon.get(f"{HOLE}{measured:.6f}&rule=conformance&uncertainty_um={u}&probability={p}"
                                     f"&degrees_of_freedom={nu}")
            inside = t_below((25.021 - measured) * 1000 / u, nu) - t_below((25 - measured) * 1000 / u, nu)
            middle = 2 * t_below(10.5 / u, nu) - 1
            if middle < p:
                self.assert_problem(answer, 422, "rule.no_acceptance")
                continue
            found = answer.json
            self.assertAlmostEqual(found["conformance_probability"], inside, delta=1e-9)
            self.assertEqual(found["degrees_of_freedom"], nu)
            if min(abs(inside - p), abs(1 - inside - p)) < 1e-9:
                continue
            bad = "reject" if measured > 25.0105 else "rework"
            self.assertEqual(found["verdict"], "good" if inside >= p else bad if 1 - inside >= p else "indeterminate",
                             (measured, u, p, nu))
            decided[found["verdict"]] += 1
        self.assertGreater(min(decided.values()), 20, decided)

    def test_a_guard_band_has_the_factor_that_covers_as_much(self):
        for nu in (1, 2, 3, 7, 30, 1000):
            found = self.daemon.get(f"{HOLE}25.01&rule=guard_band&uncertainty_um=0.1&degrees_of_freedom={nu}").json
            k = found["coverage_factor"]
            self.assertLess(2 * t_below(k - 1e-6, nu) - 1, 0.9545)
            self.assertGreater(2 * t_below(k + 1e-6, nu) - 1, 0.9545)
        given = self.daemon.get(f"{HOLE}25.01&rule=guard_band&uncertainty_um=0.1&degrees_of_freedom=2&coverage_factor=3")
        self.assertEqual(given.json["coverage_factor"], 3)
        self.assertEqual(self.daemon.get(f"{HOLE}25.01&rule=guard_band&uncertainty_um=0.1").json["coverage_factor"], 2)

    def test_those_of_a_budget_are_taken(self):
        for path, body in (("/v1/uncertainties/b5", {"contributions": [
                {"name": "a", "standard_uncertainty": 1, "degrees_of_freedom": 2}]}),
                           ("/v1/gauges-in-use/G-22", {"uncertainty": "b5", "calibration_due": "2099-12-31"})):
            self.assertEqual(self.daemon.request("PUT", path, body).status, 201)
        part = {"designation": "25 H7", "measured_mm": "25.0175", "gauge": "G-22"}
        for rule in ("guard_band", "conformance"):
            record = self.daemon.measure({**part, "measured_mm": "25.0189", "rule": rule}).json
            self.assertEqual((record["verdict"], record["degrees_of_freedom"], record["uncertainty"]),
                             ("indeterminate", 2, "b5"))
            again = self.daemon.post(f"/v1/measurements/{record['id']}/corrections",
                                     {"measured_mm": "25.0105", "reason": "misread"}).json
            self.assertEqual((again["verdict"], again["degrees_of_freedom"]), ("good", 2))
        other = self.daemon.post(f"/v1/measurements/{record['id']}/corrections",
                                 {"uncertainty_um": 1, "measured_mm": "25.0189", "reason": "known well"}).json
        self.assertNotIn("degrees_of_freedom", other)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_what_a_value_is_kept_in_spite_of_is_said_beside_it(self):
        def codes(answer):
            return [each["code"] for each in answer.get("warnings", [])]

        part = {"designation": "25 H7", "measured_mm": "25.0105"}
        none = self.daemon.measure({**part, "rule": "guard_band", "uncertainty_um": "5.3"}).json
        self.assertEqual((codes(none), none["verdict"]), (["rule.no_acceptance"], "indeterminate"))
        self.assertNotIn("warnings", self.daemon.get(f"/v1/measurements/{none['id']}").json)
        self.assertEqual(codes(self.daemon.measure({**part, "uncertainty_um": 50}).json), ["uncertainty.large"])
        self.assertEqual(codes(self.daemon.measure({**part, "uncertainty_um": "2.1"}).json), [])
        self.daemon.request("DELETE", "/v1/gauges-in-use/G-22")
        self.assertEqual(codes(self.daemon.measure({**part, "gauge": "any"}).json), [])
        self.daemon.request("PUT", "/v1/gauges-in-use/known", {"calibration_due": "2099-12-31"})
        self.assertEqual(codes(self.daemon.measure({**part, "gauge": "known"}).json), [])
        self.assertEqual(codes(self.daemon.measure({**part, "gauge": "other"}).json), ["gauge.unknown"])
        several = self.daemon.measure([{**part, "gauge": "other"}, part]).json
        self.assertEqual(codes(several), ["gauge.unknown"])
        self.assertIn(several["first_id"], several["warnings"][0]["detail"])
        self.assertEqual(codes(self.daemon.measure([{**part, "gauge": "other"}] * 20).json), ["gauge.unknown"] * 20)
        many = self.daemon.measure([{**part, "gauge": "other"}] * 57 + [part]).json["warnings"]
        self.assertEqual([each["detail"].partition("; ")[2] for each in many],
                         [""] * 19 + ["37 more warnings are not listed: check the measurements after it"])
        shown = self.daemon.measure([{**part, "gauge": "other"}], {"Prefer": "return=representation"}).json
        self.assertEqual((codes(shown), len(shown["measurements"])), (["gauge.unknown"], 1))
        self.assertEqual(self.daemon.command("verify").returncode, 0)
