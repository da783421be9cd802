"""Corrections: a new record takes the place of the old one, which stays."""

from support.daemon import DaemonTest

PART = {"designation": "25 H7", "measured_mm": 25.0215, "part_id": "SN-1", "order": "WO-17",
        "operator": "42", "temperature_c": 20.4, "comment": "first",
        "measured_at": "2026-11-20T08:00:00+01:00"}


class Corrections(DaemonTest):
    def store(self, **fields):
        answer = self.daemon.measure({**PART, **fields})
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def correct(self, record, headers=None, **fields):
        return self.daemon.post(f"/v1/measurements/{record['id']}/corrections", fields, headers)

    def corrected(self, record, **fields):
        answer = self.correct(record, reason="gauge was not zeroed", **fields)
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def assert_field(self, answer, pointer, code):
        problem = self.assert_problem(answer, 422, "request.invalid")
        self.assertEqual([(e["pointer"], e["code"]) for e in problem["errors"]], [(pointer, code)])

    def test_the_record_names_what_it_corrects(self):
        old = self.store()
        answer = self.correct(old, measured_mm=25.0205, reason="gauge was not zeroed")
        self.assertEqual(answer.status, 201, answer)
        new = answer.json
        self.assertEqual(answer.headers["location"], f"/v1/measurements/{new['id']}")
        self.assertEqual(self.daemon.get(answer.headers["location"]).json, new)
        self.assertEqual((new["correction_of"], new["reason"]), (old["id"], "gauge was not zeroed"))
        self.assertEqual((old["verdict"], new["verdict"]), ("reject", "good"))
        same = set(old) - {"id", "received_at", "measured_mm", "deviation_um", "verdict",
                           "excess_um"}
        self.assertEqual({f: old[f] for f in same}, {f: new[f] for f in same})

    def test_the_old_record_stays_and_names_the_new_one(self):
        old = self.store()
        new = self.corrected(old, measured_mm=25.01)
        self.assertEqual(self.daemon.get(f"/v1/measurements/{old['id']}").json,
                         {**old, "corrected_by": new["id"]})

    def test_lists_and_summaries_show_the_current_value(self):
        old = self.store(part_id="SN-list", characteristic="bore-list")
        new = self.corrected(old, measured_mm=25.01)
        ids = lambda query: [m["id"] for m in self.daemon.get(
            f"/v1/measurements?part_id=SN-list{query}").json["measurements"]]
        self.assertEqual(ids(""), [new["id"]])
        self.assertEqual(ids("&history=all"), [old["id"], new["id"]])
        group, = [g for g in self.daemon.get("/v1/measurements/summary").json["groups"]
                  if g["characteristic"] == "bore-list"]
        self.assertEqual((group["count"], group["mean_mm"]), (1, 25.01))

    def test_a_measurement_is_corrected_once(self):
        old = self.store()
        new = self.corrected(old, measured_mm=25.01)
        problem = self.assert_problem(self.correct(old, measured_mm=25.0, reason="again"), 409,
                                      "measurement.corrected")
        self.assertIn(new["id"], problem["detail"])
        self.assertEqual(self.corrected(new, measured_mm=25.0)["correction_of"], new["id"])

    def test_any_field_may_change(self):
        new = self.corrected(self.store(), measured_mm=25.01, part_id="SN-2", order="WO-18",
                             measured_at="2026-11-20T09:00:00Z", temperature_c=21)
        self.assertEqual((new["part_id"], new["order"], new["temperature_c"], new["measured_at"]),
                         ("SN-2", "WO-18", 21, "2026-11-20T09:00:00Z"))
        self.assertEqual(new["operator"], "42")

    def test_the_limits_may_change(self):
        old = self.store(measured_mm=25.0215)
        self.assertEqual(self.corrected(old, measured_mm=25.0215, tolerance_class="H8")["verdict"],
                         "good")
        old = self.store()
        new = self.corrected(old, measured_mm=30.01, nominal_mm=30)
        self.assertEqual((new["designation"], new["verdict"]), ("30 H7", "good"))
        old = self.store()
        new = self.corrected(old, measured_mm=29.99, designation="30 g6")
        self.assertEqual((new["feature"], new["verdict"]), ("shaft", "good"))
        old = self.store()
        new = self.corrected(old, measured_mm=25.04, upper_um=50)
        self.assertEqual((new["basis"], new["upper_limit_mm"], new["lower_limit_mm"]),
                         ("explicit", 25.05, 25))
        newer = self.corrected(new, measured_mm=25.06, lower_um=10)
        self.assertEqual((newer["upper_limit_mm"], newer["lower_limit_mm"], newer["verdict"]),
                         (25.05, 25.01, "reject"))

    def test_the_guard_band_is_taken_over(self):
        old = self.store(rule="guard_band", uncertainty_um=0.8, coverage_factor=2.5)
        new = self.corrected(old, measured_mm=25.0195)
        self.assertEqual((new["rule"], new["uncertainty_um"], new["coverage_factor"],
                          new["verdict"]), ("guard_band", 0.8, 2.5, "indeterminate"))
        self.assertEqual(self.corrected(new, measured_mm=25.0195, rule="simple")["verdict"], "good")

    def test_a_corrected_value_is_judged_as_a_new_one(self):
        """What the service computed from the facts is computed again from the corrected facts."""
        for name, freedom in (("ring", {}), ("many", {"degrees_of_freedom": 100}), ("few", {"degrees_of_freedom": 2})):
            self.daemon.request("PUT", f"/v1/uncertainties/{name}", {"contributions": [
                {"name": "all", "standard_uncertainty": 1, **freedom}]})
            self.daemon.request("PUT", f"/v1/gauges-in-use/{name}",
                                {"uncertainty": name, "calibration_due": "2099-12-31"})
        part = {"nominal_mm": 25, "tolerance_class": "H7", "measured_mm": 25.0175, "measured_at": "2026-11-20T08:00:00Z"}
        band, known = {"rule": "guard_band"}, {"uncertainty_um": 1}
        warm = {"temperature_c": 21, "part_material": "steel", "temperature_uncertainty_c": 0.5}
        drawing = {"tolerance_class": None, "feature": "hole", "upper_um": 21, "lower_um": 0}
        originals = [
            {}, {**known, "degrees_of_freedom": 5, "coverage_factor": 2.5}, {**band, **known},
            {**band, **known, "degrees_of_freedom": 50}, {**band, **known, "degrees_of_freedom": 5},
            {**band, **known, "degrees_of_freedom": 5, "coverage_factor": 3}, {**band, **known, "coverage_factor": 1.5},
            {**band, "gauge": "ring"}, {**band, "gauge": "many"}, {**band, "gauge": "few", "coverage_factor": 3},
            {"rule": "conformance", **known, "degrees_of_freedom": 50, "probability": 0.8},
            {"rule": "conformance", "gauge": "many"}, {**band, **known, **warm, "degrees_of_freedom": 3},
            {**band, **known, **drawing, "degrees_of_freedom": 3}, {**drawing, "quantity": "distance", "feature": None},
            {"quantity": "width"}, {"tolerance_class": "ISO 2768-m", "quantity": "width"},
            {"tolerance_class": "ISO 2768-m", "feature": "hole"}, {"envelope": "required", "go_gauge": "fails"}]
        changes = [
            {}, {"degrees_of_freedom": 2}, {"uncertainty_um": 1.3}, {"uncertainty_um": 1.3, "degrees_of_freedom": 4},
            {"coverage_factor": 2.2}, {"rule": "simple"}, {"rule": "guard_band"}, {"rule": "conformance"},
            {"rule": "guard_band", "uncertainty_um": 0.7}, {"gauge": "few"}, {"gauge": "ring"}, {"gauge": "unknown"},
            {"temperature_c": 30}, {"temperature_uncertainty_c": 3}, {"measured_mm": 25.0105}, {"size_operator": "GG"},
            {"nominal_mm": 25.01}, {"tool": "T5"}]

        def body(*facts):
            merged = {name: value for each in facts for name, value in each.items()}
            dropped = {"coverage_factor" if merged.get("rule") == "conformance" else "probability"}
            if "uncertainty_um" in facts[-1]:
                dropped.add("degrees_of_freedom")  # those of the uncertainty before
            return {name: value for name, value in merged.items()
                    if value is not None and not (name in dropped and name not in facts[-1])}

        def facts_of(answer):
            if answer.status != 201:
                return answer.status, {(e["pointer"], e["code"]) for e in answer.json["errors"]}
            return answer.status, {name: value for name, value in answer.json.items()
                                   if name not in ("id", "received_at", "correction_of", "reason")}

        pairs = [(original, change) for original in originals for change in changes]
        stored = self.daemon.measure([body(part, original) for original, _ in pairs], {"Prefer": "return=representation"})
        for (original, change), old in zip(pairs, stored.json["measurements"], strict=True):
            with self.subTest(original=original, change=change):
                new = self.correct(old, reason="x", **{"measured_mm": part["measured_mm"], **change})
                self.assertEqual(facts_of(new), facts_of(self.daemon.measure(body(part, original, change))))

    def test_few_degrees_of_freedom_are_not_judged_by_the_factor_of_many(self):
        old = self.store(measured_mm=25.0175, rule="guard_band", uncertainty_um=1, degrees_of_freedom=50)
        self.assertEqual((old["coverage_factor"], old["verdict"]), (2.051251, "good"))
        new = self.corrected(old, measured_mm=25.0175, degrees_of_freedom=2)
        self.assertEqual((new["coverage_factor"], new["verdict"]), (4.526551, "indeterminate"))

    def test_another_uncertainty_has_not_the_degrees_of_freedom_before(self):
        old = self.store(measured_mm=25.0175, rule="guard_band", uncertainty_um=1, degrees_of_freedom=2)
        new = self.corrected(old, measured_mm=25.0175, uncertainty_um=1)
        self.assertEqual((new.get("degrees_of_freedom"), new["coverage_factor"], new["verdict"]), (None, 2, "good"))
        new = self.corrected(new, measured_mm=25.0175, uncertainty_um=1, degrees_of_freedom=50)
        self.assertEqual((new["degrees_of_freedom"], new["coverage_factor"]), (50, 2.051251))

    def test_a_designation_without_the_envelope_ends_it(self):
        given = {"designation": "25H7(E)", "measured_mm": 25.01, "go_gauge": "fails"}
        old = self.store(**given)
        self.assertEqual((old["envelope_result"], old["verdict"]), ("failed", "rework"))
        new = self.corrected(old, measured_mm=25.01, designation="25 H7")
        self.assertEqual(({"envelope", "go_gauge", "envelope_result"} & set(new), new["verdict"]), (set(), "good"))
        for stays in ({"designation": "25 H8(E)"}, {"designation": "25 H8", "envelope": "required"}, {"tolerance_class": "H8"}):
            new = self.corrected(self.store(**given), measured_mm=25.01, **stays)
            self.assertEqual((new["envelope_result"], new["verdict"]), ("failed", "rework"), stays)

    def test_a_value_that_is_no_size_loses_what_only_a_size_has(self):
        old = self.store(designation="25H7(E)", measured_mm=25.01, go_gauge="passes", size_operator="GG")
        new = self.corrected(old, measured_mm=25.01, quantity="distance", upper_um=21, lower_um=0)
        self.assertEqual(({"envelope", "go_gauge", "size_operator"} & set(new), new["quantity"]), (set(), "distance"))
        new = self.corrected(self.store(), measured_mm=2.1, designation="R2 ISO 2768-m")
        self.assertEqual(("size_operator" in new, new["quantity"]), (False, "radius"))

    def test_limits_stay_as_they_were_applied(self):
        rows = [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]
        self.daemon.request("PUT", "/v1/tables/hole/classes/Shop1", {"rows": rows})
        old = self.store(designation="25 Shop1")
        rows[0]["upper_um"] = 40
        self.daemon.request("PUT", "/v1/tables/hole/classes/Shop1", {"rows": rows})
        new = self.corrected(old, measured_mm=25.02)
        self.assertEqual((new["upper_limit_mm"], new["verdict"], new["table_revision"]),
                         (25.015, "reject", old["table_revision"]))
        # Naming the class again judges by the tables in force.
        newer = self.corrected(new, measured_mm=25.02, tolerance_class="Shop1")
        self.assertEqual((newer["upper_limit_mm"], newer["verdict"]), (25.04, "good"))

    def test_what_is_refused(self):
        old = self.store()
        count = len(self.daemon.stored())
        self.assert_field(self.correct(old, measured_mm=25.01), "/reason", "field.missing")
        self.assert_field(self.correct(old, reason="x"), "/measured_mm", "field.missing")
        self.assert_field(self.correct(old, measured_mm=25.01, reason=" "), "/reason",
                          "field.invalid")
        unclear = self.correct(old, measured_mm=25.01, reason="a\0b")
        self.assert_field(unclear, "/reason", "field.invalid")
        self.assertEqual(unclear.json["detail"], "reason must not contain a NUL character")
        self.assert_field(self.correct(old, measured_mm=25.01, reason=7), "/reason", "field.type")
        self.assert_field(self.correct(old, measured_mm=25.01, reason="x" * 2001), "/reason",
                          "field.too_long")
        self.assert_field(self.correct(old, measured_mm=None, reason="x"), "/measured_mm",
                          "field.type")
        self.assert_field(self.correct(old, measured_mm=25.01, reason="x", id="m1"), "/id",
                          "field.unknown")
        self.assert_field(self.daemon.post(f"/v1/measurements/{old['id']}/corrections", []), "",
                          "field.type")
        self.assertEqual(self.daemon.post(f"/v1/measurements/{old['id']}/corrections", "{",
                                          {"Content-Type": "application/json"}).status, 400)
        self.assert_problem(self.correct({"id": "m999999"}, measured_mm=25, reason="x"), 404,
                            "measurement.unknown")
        self.assertEqual(len(self.daemon.stored()), count)

    def test_an_idempotent_correction(self):
        old = self.store()
        headers = {"Idempotency-Key": "fix-1"}
        first = self.correct(old, headers, measured_mm=25.01, reason="typing error")
        again = self.correct(old, headers, measured_mm=25.01, reason="typing error")
        self.assertEqual((first.status, first.body), (201, again.body))
        self.assertEqual(self.correct(old, {"Prefer": "return=minimal", **headers},
                                      measured_mm=25.02, reason="other").status, 422)

    def test_the_chain_verifies(self):
        self.corrected(self.store(), measured_mm=25.01)
        verified = self.daemon.command("verify")
        self.assertEqual(verified.returncode, 0, verified.stdout)
