"""The data folder of each release is taken over whole: records, proofs, answers, and it goes on."""

import json
import sys
import unittest

from support import releases
from support.daemon import ROOT, Daemon

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402


class Releases(unittest.TestCase):
    def daemon_on(self, name):
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        return daemon, releases.unpack(name, daemon)

    def assert_still(self, now, then):
        """An answer may have got members at its top beside those it had, which are what they were. A change has the digits
        of its history beside its number now."""
        if then.startswith("{"):
            now, then = json.loads(now), json.loads(then)
            for change in then.get("changes", []):
                change["id"] = f"c{change['id']}-{now['last'].split('-')[1]}"
            now = {name: value for name, value in now.items() if name in then}
        self.assertEqual(now, then)

    def test_what_a_release_answered_is_answered_again(self):
        self.assertTrue(releases.names())
        for name in releases.names():
            with self.subTest(name):
                daemon, then = self.daemon_on(name)
                daemon.start()
                keys = daemon.get("/v1/log/key").text.split()
                self.assertEqual(keys, (then / "keys").read_text().split())
                records = (then / "records.ndjson").read_text().splitlines()
                self.assertGreater(len(records), 9)
                self.assertEqual(len(daemon.stored()), len(records))
                proofs = json.loads((then / "proofs.json").read_text())
                for record in records:
                    each = json.loads(record)["id"]
                    self.assertEqual(daemon.get(f"/v1/measurements/{each}").text, record)
                    self.assertIsNone(check_proof.check(record, proofs[each], keys))
                    self.assertIsNone(check_proof.check(record, daemon.get(f"/v1/measurements/{each}/proof").json, keys))
                for path, answer in json.loads((then / "answers.json").read_text()).items():
                    self.assert_still(daemon.get(path).text, answer)
                # What no release before had is kept beside it.
                for more in ({}, {"temperature_c": 21, "part_material": "steel", "temperature_uncertainty_c": 1}):
                    answer = daemon.measure({"designation": "25 H7", "measured_mm": "25.013", **more})
                    self.assertEqual((answer.status, "added_uncertainty_um" in answer.json), (201, bool(more)))
                    self.assertIsNone(check_proof.check(
                        answer.text, daemon.get(f"/v1/measurements/{answer.json['id']}/proof").json, keys))
                self.assertEqual(daemon.stop(), 0)
                verified = daemon.command("verify")
                self.assertEqual(verified.returncode, 0, verified.stdout)
                self.assertIn(" 0 findings", verified.stdout)

    def test_the_newest_folder_has_gauges_and_sizes_of_each_kind(self):
        _, then = self.daemon_on(releases.names()[-1])
        records = [json.loads(line) for line in (then / "records.ndjson").read_text().splitlines()]
        said = {(name, record[name]) for record in records for name in ("envelope_result", "size_operator", "calibration_overdue") if name in record}
        self.assertLessEqual({("envelope_result", "verified"), ("envelope_result", "failed"), ("size_operator", "LP"), ("size_operator", "GX"),
                              ("size_operator", "GG"), ("calibration_overdue", True)}, said)
        self.assertTrue({"uncertainty", "calibration_certificate", "degrees_of_freedom"} <= set().union(*records))
        answers = json.loads((then / "answers.json").read_text())
        self.assertEqual([each["status"] for each in json.loads(answers["/v1/gauges-in-use/G-07/calibrations"])["calibrations"]],
                         ["in_use", "blocked"])
        self.assertEqual(len(json.loads(answers["/v1/changes?kind=gauge"])["changes"]), 2)
        self.assertIn("cg", json.loads(answers["/v1/studies/G-07-March"])["result"])

    def test_a_value_that_was_stored_with_invented_limits_has_no_capability(self):
        """Its record stays as it was stored and proved; nothing is computed of limits of ±10⁹ mm."""
        daemon, _ = self.daemon_on("0.1.0-without-quantity")
        daemon.start()
        old = [record for record in daemon.stored() if record.get("upper_limit_mm") == 1_000_000_000]
        self.assertEqual([record["lower_limit_mm"] for record in old], [-1_000_000_000])
        for figure in ("capability?", "chart?kind=i_mr&"):
            answer = daemon.get(f"/v1/measurements/{figure}source=all&run_id={old[0]['run_id']}&characteristic=Diameter")
            self.assertEqual((answer.status, answer.json["code"]), (422, "limits.none"))

    def test_a_record_that_is_another_than_then_is_noticed(self):
        daemon, then = self.daemon_on(releases.names()[0])
        daemon.start()
        record = (then / "records.ndjson").read_text().splitlines()[0]
        proof = json.loads((then / "proofs.json").read_text())[json.loads(record)["id"]]
        other = record.replace("25.013", "25.012")
        self.assertNotEqual(record, other)
        self.assertIsNotNone(check_proof.check(other, proof, daemon.get("/v1/log/key").text.split()))


if __name__ == "__main__":
    unittest.main()
