"""Plans: what is measured at a part number, in order."""

import json

from support.daemon import DaemonTest

BORE = {"name": "bore-A", "designation": "25 H7", "gauge": "G-07", "subgroup_size": 5, "frequency": "each hour",
        "picture": "plans/bore.png", "reaction": "Stop and tell the setter"}
SLOT = {"name": "slot", "nominal_mm": 8, "feature": "hole", "upper_um": 36, "lower_um": 0}
JOURNAL = {"name": "journal", "nominal_mm": "30", "tolerance_class": "k6", "rule": "guard_band", "uncertainty_um": 0.5}


class Plans(DaemonTest):
    def put(self, number, *characteristics, **others):
        return self.daemon.request("PUT", f"/v1/plans/{number}", {"characteristics": list(characteristics), **others})

    def test_a_plan_is_stored_replaced_listed_and_deleted(self):
        self.assertEqual(self.put("4711-A", BORE, SLOT, JOURNAL, name="Housing", part="4711-A").status, 201)
        plan = self.daemon.request("GET", "/v1/plans/4711-A").json
        self.assertEqual(plan, {"part": "4711-A", "name": "Housing", "characteristics": [BORE, SLOT, JOURNAL]})
        self.assertEqual(self.put("4711-A", SLOT).status, 200)
        self.assertEqual(self.daemon.request("GET", "/v1/plans/4711-A").json, {"part": "4711-A", "characteristics": [SLOT]})
        self.assertEqual(self.put("A%2F1", BORE).status, 201)
        self.assertEqual(self.daemon.request("GET", "/v1/plans/A/1").json["part"], "A/1")
        listed = self.daemon.request("GET", "/v1/plans").json["plans"]
        self.assertEqual([(each["part"], each["characteristics"]) for each in listed], [("4711-A", 1), ("A/1", 1)])
        self.assertEqual(self.daemon.request("DELETE", "/v1/plans/A%2F1").status, 204)
        for method in ("GET", "DELETE"):
            self.assert_problem(self.daemon.request(method, "/v1/plans/A%2F1"), 404, "plan.unknown")
        self.daemon.request("DELETE", "/v1/plans/4711-A")

    def test_every_bad_field_is_named(self):
        cases = [
            ([{**BORE, "designation": "25 H19"}], "/characteristics/0/designation", "class.unknown"),
            ([BORE, {**SLOT, "name": "bore-A"}], "/characteristics/1/name", "field.conflict"),
            ([{"name": "x"}], "/characteristics/0/nominal_mm", "field.missing"),
            ([{"designation": "25 H7"}], "/characteristics/0/name", "field.missing"),
            ([{**BORE, "nominal_mm": 25}], "/characteristics/0/nominal_mm", "field.conflict"),
            ([{**BORE, "rule": "guard_band"}], "/characteristics/0/uncertainty_um", "field.missing"),
            ([{**SLOT, "lower_um": 50}], "/characteristics/0/upper_um", "limits.invalid"),
            ([{**BORE, "measured_mm": 25}], "/characteristics/0/measured_mm", "field.unknown"),
            ([{**BORE, "subgroup_size": 0}], "/characteristics/0/subgroup_size", "field.invalid"),
            ([{**BORE, "name": "x" * 201}], "/characteristics/0/name", "field.too_long"),
            ([{**BORE, "gauge": 7}], "/characteristics/0/gauge", "field.type"),
            ([7], "/characteristics/0", "field.type"),
            ([], "/characteristics", "field.invalid"),
        ]
        for characteristics, pointer, code in cases:
            answer = self.put("bad", *characteristics)
            self.assert_problem(answer, 422, "request.invalid")
            self.assertIn((pointer, code), [(each["pointer"], each["code"]) for each in answer.json["errors"]], json.dumps(answer.json))
        self.assert_problem(self.put("bad", BORE, part="another"), 422, "request.invalid")
        self.assert_problem(self.put("x" * 201, BORE), 400, "path.malformed")
        self.assert_problem(self.daemon.request("GET", "/v1/plans/bad"), 404, "plan.unknown")
