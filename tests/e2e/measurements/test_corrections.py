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
