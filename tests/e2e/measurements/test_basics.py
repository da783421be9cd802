"""One measurement: what is stored, what is answered, what survives."""

from support.daemon import DaemonTest

PART = {"designation": "25 H7", "measured_mm": 25.0215, "part_id": "SN-1"}


class OneMeasurement(DaemonTest):
    def test_the_answer_is_the_stored_record(self):
        answer = self.daemon.measure(PART)
        self.assertEqual(answer.status, 201, answer)
        record = answer.json
        self.assertEqual(answer.headers["location"], f"/v1/measurements/{record['id']}")
        self.assertEqual(record["verdict"], "reject")
        self.assertEqual(record["excess_um"], 0.5)
        self.assertEqual(record["upper_limit_mm"], 25.021)
        self.assertEqual(record["source"], "gauge")
        self.assertEqual(record["measured_at"], record["received_at"])
        self.assertEqual(self.daemon.get(answer.headers["location"]).body, answer.body)

    def test_fields_that_were_not_given_are_left_out(self):
        record = self.daemon.measure(PART).json
        for field in ("order", "uncertainty_um", "temperature_c", "caller", "correction_of"):
            self.assertNotIn(field, record)

    def test_an_unknown_measurement_is_404(self):
        for name in ("m999999999", "m0", "m01", "m-1", "x", "1"):
            self.assert_problem(self.daemon.get(f"/v1/measurements/{name}"), 404,
                                "measurement.unknown")


class AfterAKill(DaemonTest):
    def test_an_acknowledged_measurement_is_there_again(self):
        answer = self.daemon.measure(PART)
        self.daemon.kill()
        self.daemon.start()
        self.assertEqual(self.daemon.get(answer.headers["location"]).body, answer.body)
        self.assertEqual(self.daemon.command("verify").returncode, 0)
