"""What a centre takes of a station's log: batches put by hand, whole, altered, in the wrong place and twice."""

import gzip
import json
import re
import shutil
import sqlite3
import sys
import unittest

from log.test_log import flip, wait_for_size
from durability.test_storage import PART
from support.contract import Contract
from support.daemon import ROOT, Daemon, DaemonTest, command
from support.waiting import wait_for

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402 - what an auditor runs

NDJSON = {"Content-Type": "application/x-ndjson"}


def origin_of(records):
    return json.loads(records[0])["id"].split("-")[1]


def records_of(station):
    """The records as they were first answered: a list shows no later correction."""
    return station.get("/v1/measurements?format=ndjson&source=all&history=all").text.splitlines()


def batch(station, records, answers=(), note=None):
    """The body of a batch that ends where the station's log ends."""
    heading = {"checkpoint": note or wait_for_size(station, len(records)),
               "key": station.get("/v1/log/key").text.split()[0]}
    lines = [json.dumps(heading), *records, *(json.dumps({"answer": answer}) for answer in answers)]
    return "\n".join(lines) + "\n"


class Intake(unittest.TestCase):
    """The daemon is the centre; the station is another one, which does not know of it."""

    def setUp(self):
        self.daemon = self.started()
        self.station = self.started()

    def started(self):
        daemon = Daemon("--origin-name", "plant-3/press-7")
        self.addCleanup(daemon.cleanup)
        return daemon.start()

    def put(self, body, origin, place=1, headers=NDJSON):
        answer = self.daemon.request("PUT", f"/v1/log/{origin}/{place}", body, headers)
        contract = Contract(self.daemon.get("/openapi.json").json)
        self.assertIsNone(contract.check(contract.operation("putLogBatch")[2], answer), answer)
        return answer

    def take(self, station=None, skip=0):
        """Forwards what the station has behind its first rows."""
        station = station or self.station
        records = records_of(station)
        note = wait_for_size(station, len(records))
        answer = self.put(batch(station, records[skip:], note=note), origin_of(records), skip + 1)
        self.assertEqual(answer.status, 200, answer)
        return records, answer.json

    def assert_refused(self, answer, status, code):
        self.assertEqual((answer.status, answer.json.get("code")), (status, code), answer)

    def assert_clean(self, daemon=None):
        verified = command("verify", "--data", (daemon or self.daemon).data)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        return verified.stdout

    def fill(self, station):
        first = station.measure({**PART, "part_id": "P-1", "order": "WO-1"}).json
        station.measure({**PART, "rule": "guard_band", "uncertainty_um": 0.8, "coverage_factor": 1.96})
        station.measure({**PART, "rule": "conformance", "uncertainty_um": 0.8, "probability": 0.9})
        station.measure({"nominal_mm": 30, "feature": "shaft", "upper_um": 0.001, "lower_um": -12345.891,
                         "measured_mm": 29.99, "comment": '"\\\n\x01\x7f Ø 25 \U0001f600'})
        station.measure({**PART, "temperature_c": 23.5, "scale_temperature_c": 21, "part_material": "steel",
                         "scale_expansion_um_per_m_k": 8, "temperature_uncertainty_c": "0.5", "rule": "guard_band",
                         "scale_expansion_uncertainty_um_per_m_k": "0.3", "uncertainty_um": 0.8})
        columns = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}
        self.assertLess(station.request("PUT", "/v1/tables/hole/classes/Q7", columns,
                                        {"Content-Type": "application/json"}).status, 300)
        station.measure({"designation": "25 Q7", "measured_mm": 25.001})
        station.post(f"/v1/measurements/{first['id']}/corrections", {"measured_mm": 25.5, "reason": "misread"})
        station.measure([PART] * 300)
        return first

    def test_every_kind_of_record_arrives_and_is_proved(self):
        first = self.fill(self.station)
        self.daemon.measure(PART)
        records, head = self.take()
        note = self.station.get("/v1/log/checkpoint").text
        self.assertEqual([str(head["size"]), head["root"]], note.split("\n")[1:3])
        own = self.daemon.measure([PART] * 3, {"Prefer": "return=representation"}).json["measurements"]
        listed = records_of(self.daemon)
        self.assertEqual(listed[1:-3], records, "in the order of arrival, behind what was there")
        self.assertEqual([json.loads(line)["id"].split("-")[0] for line in listed[-3:]],
                         [record["id"].split("-")[0] for record in own])
        # What the list shows, each record shows, with the same filters.
        shown = self.daemon.get(f"/v1/measurements/{first['id']}").json
        self.assertEqual(shown["corrected_by"], json.loads(records[6])["id"])
        for query, count in {"": 1, "&history=all": 2}.items():
            found = self.daemon.get(f"/v1/measurements?order=WO-1{query}").json["measurements"]
            self.assertEqual([record["id"] for record in found],
                             [first["id"], shown["corrected_by"]][-count:], "it was corrected")
        behind = self.daemon.get(f"/v1/measurements?limit=1&after={json.loads(records[7])['id']}").json
        self.assertEqual(behind["measurements"][0]["id"], json.loads(records[8])["id"])
        groups = self.daemon.get("/v1/measurements/summary?group_by=tolerance_class").json["groups"]
        self.assertEqual(sum(group["count"] for group in groups), len(listed) - 1)
        # The proof is the station's, and the centre signs beside it.
        wait_for_size(self.daemon, 4)
        for line in [*records[:8], *listed[-3:]]:
            record = json.loads(line)
            proof = self.daemon.get(f"/v1/measurements/{record['id']}/proof").json
            forwarded = line in records
            keys = (self.station if forwarded else self.daemon).get("/v1/log/key").text.split()
            self.assertIsNone(check_proof.check(line, proof, keys), line)
            self.assertEqual(proof["checkpoint"].count("\n— "), 2 if forwarded else 1)
        self.assertEqual(self.daemon.get(f"/v1/measurements/{own[-1]['id']}/proof").json["index"], 3)
        self.daemon.stop()
        self.assertIn(f"plant-3/press-7/{origin_of(records)[:8]}: {len(records)} measurements", self.assert_clean())
        self.daemon.start()
        self.assertEqual(records_of(self.daemon), listed)
        self.station.measure([PART] * 600)
        self.take(skip=len(records))
        self.daemon.measure(PART)
        self.assert_clean()

    def test_a_batch_that_was_altered_is_refused_whole(self):
        self.fill(self.station)
        records = records_of(self.station)
        origin = origin_of(records)
        note = wait_for_size(self.station, len(records))
        whole = batch(self.station, records, note=note)
        swapped = [records[1], records[0], *records[2:]]
        foreign = "0" * 16 if origin[0] != "0" else "1" * 16
        altered = {
            "a value": (whole.replace('"measured_mm":25.013', '"measured_mm":25.014', 1), "log.root_mismatch"),
            "two rows": (batch(self.station, swapped, note=note), "log.root_mismatch"),
            "a row less": (batch(self.station, records[:-1], note=note), "request.invalid"),
            "the root": (batch(self.station, records, note=re.sub(r"\n[^\n]+=\n\n", lambda root: "\n" + flip(
                root.group().strip()) + "\n\n", note)), "log_note.unverified"),
            "no heading": ("\n".join(records), "request.invalid"),
            "a member more": (whole.replace('{"basis"', '{"aaa":1,"basis"', 1), "log.root_mismatch"),
            "no JSON": (whole.replace('"basis"', 'basis', 1), "json.malformed"),
        }
        for what, (body, code) in altered.items():
            with self.subTest(what):
                answer = self.put(body, origin)
                self.assertIn(answer.status, (400, 422))
                self.assertEqual(answer.json["code"], code, answer)
        self.assert_refused(self.put(whole, foreign), 403, "log.key_unknown")
        self.assertEqual(self.put(whole, "xyz").status, 422)
        self.assertEqual(records_of(self.daemon), [], "nothing of it was stored")
        # The negative control: as it is, it is taken; compressed too.
        packed = self.put(gzip.compress(whole.encode()), origin, 1, {**NDJSON, "Content-Encoding": "gzip"})
        self.assertEqual(packed.status, 200, packed)

    def test_a_batch_goes_on_where_the_log_ends_and_nowhere_else(self):
        self.station.measure([PART] * 10)
        records, head = self.take()
        origin = origin_of(records)
        self.station.measure([PART] * 5)
        longer = records_of(self.station)
        note = wait_for_size(self.station, len(longer))
        for place, rows in ((1, longer), (5, longer[4:]), (13, longer[12:])):
            answer = self.put(batch(self.station, rows, note=note), origin, place)
            self.assert_refused(answer, 409, "log.position")
            self.assertEqual(answer.json["head"], head)
        self.assert_refused(self.put(batch(self.station, records, note=self.note_at(10)), origin), 409, "log.position")
        self.take(skip=10)
        self.assertEqual(records_of(self.daemon), longer, "each once")
        self.assert_clean()

    def note_at(self, size):
        """The checkpoint of an earlier size, as the centre has kept it."""
        with sqlite3.connect(f"file:{self.daemon.database}?mode=ro", uri=True) as database:
            note, = database.execute("SELECT checkpoint FROM origins WHERE size = ?", (size,)).fetchone()
        return note

    def test_a_copied_folder_is_refused_and_named(self):
        self.station.measure([PART] * 4)
        self.take()
        self.station.stop()
        twin = Daemon("--origin-name", "plant-3/press-7")
        self.addCleanup(twin.cleanup)
        shutil.copytree(self.station.data, twin.data)
        twin.start()
        self.station.start()
        self.station.measure({**PART, "part_id": "first"})
        twin.measure({**PART, "part_id": "twin"})
        records, _ = self.take(skip=4)
        for more in (1, 3):  # as long as what is here, and longer
            theirs = records_of(twin)
            note = wait_for_size(twin, len(theirs))
            answer = self.put(batch(twin, theirs[4:], note=note), origin_of(records), 5)
            self.assert_refused(answer, 409, "log.forked")
            twin.measure([PART] * more)
        self.daemon.wait_for_log('"event":"log_forked"', times=2)
        self.assertEqual(records_of(self.daemon), records)
        self.assertEqual(records_of(twin)[4], theirs[4], "the other history stays where it is")
        with sqlite3.connect(f"file:{self.daemon.database}?mode=ro", uri=True) as database:
            self.assertEqual(database.execute("SELECT count(*) FROM origin_forks").fetchone(), (2,))
        self.station.measure(PART)
        self.take(skip=5)
        self.assert_clean()

    def test_the_centre_is_no_station_of_its_own_copy(self):
        self.daemon.measure(PART)
        answer = self.put(batch(self.daemon, records_of(self.daemon)), origin_of(records_of(self.daemon)))
        self.assert_refused(answer, 409, "log.forked")

    def test_a_new_key_is_taken_where_the_old_one_hands_over(self):
        self.station.measure(PART)
        records, _ = self.take()
        origin = origin_of(records)
        self.station.stop()
        self.assertEqual(command("log-key", "--data", self.station.data).returncode, 0)
        self.station.start()
        self.station.measure(PART)
        records = records_of(self.station)
        body = batch(self.station, records[1:], note=wait_for_size(self.station, 2))
        self.assert_refused(self.put(body, origin, 2), 403, "log.key_unknown")
        kept, = [path.read_text() for path in self.station.data.glob("fitgauge.checkpoint.*")]
        heading, rest = body.split("\n", 1)
        signed_again = kept.replace("next key", "other key")
        for note, status in ((signed_again, 403), (kept, 200)):
            answer = self.put(json.dumps({**json.loads(heading), "hand_overs": [note]}) + "\n" + rest, origin, 2)
            self.assertEqual(answer.status, status, answer)
        self.station.stop()
        (self.station.data / "fitgauge.log.key").unlink()
        self.station.start()
        self.station.measure(PART)
        body = batch(self.station, records_of(self.station)[2:], note=wait_for_size(self.station, 3))
        self.assert_refused(self.put(body, origin, 3), 403, "log.key_unknown")
        self.assert_clean()

    def test_answers_of_idempotency_keys_come_with_their_rows(self):
        stored = self.station.post("/v1/measurements", PART, {"Idempotency-Key": "k-1"})
        records = records_of(self.station)
        with sqlite3.connect(f"file:{self.station.database}?mode=ro", uri=True) as database:
            digest, = database.execute("SELECT hex(body_digest) FROM idempotent_answers").fetchone()
        answer = {"caller": "", "method": "POST", "path": "/v1/measurements", "key": "k-1",
                  "request_sha256": digest.lower(), "status": 201, "content_type": "application/json",
                  "location": stored.headers["location"], "body": stored.text}
        wrong = self.put(batch(self.station, records, [{**answer, "status": 500}]), origin_of(records))
        self.assert_refused(wrong, 422, "log.record_invalid")
        self.assertEqual(self.put(batch(self.station, records, [answer]), origin_of(records)).status, 200)
        again = self.daemon.post("/v1/measurements", PART, {"Idempotency-Key": "k-1"})
        self.assertEqual((again.status, again.text), (201, stored.text))
        self.assertEqual(len(records_of(self.daemon)), 1)


class IntakeWithKeys(DaemonTest):
    flags = ("--auth", "keys")

    def test_only_a_station_and_an_administrator_forward(self):
        token = {}
        for role in ("viewer", "operator", "station", "admin"):
            made = command("--data", self.daemon.data, "key", "create", "--name", f"a-{role}", "--role", role)
            self.assertEqual(made.returncode, 0, made.stderr)
            token[role] = re.search(r"fg_[0-9a-f]+", made.stdout).group()
        station = Daemon().start()
        self.addCleanup(station.cleanup)
        station.measure(PART)
        records = records_of(station)
        for role, statuses in {"viewer": (403,), "operator": (403,), "station": (200,), "admin": (409,)}.items():
            self.assertIn(self.put_as(token[role], batch(station, records), records), statuses, role)
        self.assertEqual(self.put_as("fg_none", batch(station, records), records), 401)
        posted = self.daemon.post("/v1/measurements", PART, {"Authorization": f"Bearer {token['station']}"})
        self.assertEqual(posted.status, 403, "a station forwards, and measures at its own place")

    def put_as(self, token, body, records):
        def status():
            return self.daemon.request("PUT", f"/v1/log/{origin_of(records)}/1", body,
                                       {**NDJSON, "Authorization": f"Bearer {token}"}).status
        # Keys are loaded every two seconds.
        return status() if token == "fg_none" else wait_for(lambda: (found := status()) != 401 and found, "a new key")


if __name__ == "__main__":
    unittest.main()
