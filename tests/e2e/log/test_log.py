"""The log: checkpoints, proofs and tiles, held against what others compute; rows altered, swapped and cut off."""

import base64
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from durability.test_storage import PART, StorageTest
from support.daemon import ROOT, Daemon, DaemonTest, command
from support.seals import alter, sealed_anew
from support.waiting import wait_for

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402 - what an auditor runs

MODULES = pathlib.Path("/usr/share/gocode/src/golang.org/x/mod/sumdb")
DEEP = bool(os.environ.get("TESTS_DEEP"))  # 100 pairs of checkpoints, 1,000 proofs and 100 tamperings
UNTRIGGERED = ("DROP TRIGGER measurements_are_not_updated", "DROP TRIGGER measurements_are_not_deleted")


def flip(text):
    """Base64 of the same bytes but one bit."""
    data = bytearray(base64.b64decode(text))
    data[5] ^= 1
    return base64.b64encode(data).decode()


def wait_for_size(daemon, size):
    """The checkpoint, once it covers so many measurements."""
    def note():
        text = daemon.get("/v1/log/checkpoint").text
        return text if int(text.split("\n")[1]) >= size else None
    return wait_for(note, f"a checkpoint of {size}")


class Log(DaemonTest):
    flags = ("--origin-name", "plant-3/press-7")

    def proof_of(self, record):
        answer = self.daemon.get(f"/v1/measurements/{record['id']}/proof")
        self.assertEqual(answer.status, 200, answer)
        return answer.json

    def keys(self):
        return self.daemon.get("/v1/log/key").text.split()

    def test_every_kind_of_record_is_proved_by_the_checker_of_auditors(self):
        def body(**more):
            return self.daemon.measure({**PART, **more}).text

        drawing = {"nominal_mm": 30, "feature": "shaft", "upper_um": 0.001, "lower_um": -12345.891}
        records = [
            body(),
            body(comment='"\\\b\f\n\r\t\x01\x7f Ø 25 \U0001f600 \ue000', unit="line 2", temperature_c=-0.000001),
            body(rule="guard_band", uncertainty_um=0.8, coverage_factor=1.96, measured_at="2026-11-20T08:00:00.123+01:00"),
            self.daemon.measure({**drawing, "measured_mm": 0.000001}).text,
            self.daemon.measure({**drawing, "measured_mm": 100000000, "nominal_mm": 99999999.999999}).text]
        first = json.loads(records[0])
        records.append(self.daemon.post(f"/v1/measurements/{first['id']}/corrections",
                                        {"measured_mm": 25.5, "reason": "misread"}).text)
        many = self.daemon.measure([PART] * 300, {"Prefer": "return=representation"}).json["measurements"]
        # The corrected record shows its correction now, which is no part of what was hashed.
        records.append(self.daemon.get(f"/v1/measurements/{first['id']}").text)
        self.assertIn("corrected_by", records[-1])
        for record in records:
            proof = self.proof_of(json.loads(record))
            self.assertIsNone(check_proof.check(record, proof, self.keys()), record)
            if "corrected_by" not in record:
                self.assertEqual(check_proof.canonical(json.loads(record, parse_float=check_proof.decimal.Decimal)),
                                 record, "an answer is canonical as it is")
        for record in many[::37]:
            self.assertIsNone(check_proof.check(json.dumps(record), self.proof_of(record), self.keys()))

        record, proof = records[1], self.proof_of(json.loads(records[1]))
        wrong = [(record.replace("line 2", "line 3"), proof), (record, {**proof, "index": proof["index"] ^ 1}),
                 (record, {**proof, "hashes": [flip(proof["hashes"][0]), *proof["hashes"][1:]]}),
                 (record, {**proof, "checkpoint": proof["checkpoint"][:-10] + "AAAAAAAA=\n"})]
        for altered, false_proof in wrong:
            self.assertIsNotNone(check_proof.check(altered, false_proof, self.keys()))
        self.assertIsNotNone(check_proof.check(record, proof, []))

    def test_ids_and_names_say_where_they_are_from(self):
        with_id = self.daemon.measure(PART).json["id"]
        checkpoint = self.daemon.get("/v1/log/checkpoint").text
        name = checkpoint.split("\n")[0]
        self.assertRegex(name, "^fitgauge/plant-3/press-7/[0-9a-f]{8}$")
        self.assertEqual(with_id.split("-")[1][:8], name[-8:])
        self.assertTrue(self.keys()[0].startswith(name + "+"))
        other = Daemon()
        self.addCleanup(other.cleanup)
        other.start()
        foreign = other.measure(PART).json["id"]
        self.assertNotEqual(foreign.split("-")[1], with_id.split("-")[1])
        self.assert_problem(self.daemon.get(f"/v1/measurements/{foreign}"), 404, "measurement.unknown")
        self.assert_problem(self.daemon.get(f"/v1/measurements/{foreign}/proof"), 404, "measurement.unknown")
        self.assertEqual(other.stop(), 0)

    def test_what_the_log_does_not_have(self):
        wait_for_size(self.daemon, 1)
        for tile in ("0/x999/000", "entries/x999/000", "8/000", "0/000.p/0", "0/1", "x"):
            self.assert_problem(self.daemon.get(f"/v1/log/tile/{tile}"), 404, "resource.not_found")
        self.assert_problem(self.daemon.get("/v1/measurements/m99999999/proof"), 404, "measurement.unknown")

    def test_readiness_and_log_name_the_head(self):
        self.daemon.measure(PART)
        ready = self.daemon.get("/readyz").json["log"]
        self.assertEqual(set(ready), {"name", "size", "root"})
        self.daemon.wait_for_log('"event":"log_head"')


@unittest.skipUnless(shutil.which("go") and MODULES.is_dir(), "needs the packages golang-go and golang-golang-x-mod-dev")
class OtherVerifier(DaemonTest):
    """golang.org/x/mod/sumdb judges a running daemon."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-go-"))
        cls.addClassCleanup(shutil.rmtree, folder, ignore_errors=True)
        cls.verifier = folder / "verify"
        source = pathlib.Path(__file__).parent / "verify_log.go"
        built = subprocess.run(["go", "build", "-o", str(cls.verifier), str(source)], capture_output=True, text=True,
                               check=False, env={**os.environ, "GO111MODULE": "off", "GOPATH": "/usr/share/gocode",
                                                 "GOCACHE": os.path.join(tempfile.gettempdir(), "fitgauge-go")})
        if built.returncode != 0:
            raise AssertionError(built.stderr)

    def test_checkpoints_proofs_and_tiles(self):
        notes = [self.daemon.get("/v1/log/checkpoint").text]
        size = 0
        for rows in (1, 2, 250, 3, 255, 800) + DEEP * (7, 1, 1, 511, 2, 30, 4, 9):
            self.daemon.measure([PART] * rows)
            size += rows
            notes.append(wait_for_size(self.daemon, size))
        ids = [row["id"] for row in self.daemon.stored()]
        asked = {"key": self.daemon.get("/v1/log/key").text.strip(), "notes": notes,
                 "url": f"http://127.0.0.1:{self.daemon.port}", "ids": ids[::1 if DEEP else 13] + ids[-1:]}
        judged = subprocess.run([str(self.verifier)], input=json.dumps(asked), capture_output=True, text=True,
                                check=False, timeout=120)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)
        said = json.loads(judged.stdout)
        self.assertEqual(said["records"], size)
        self.assertEqual(said["inclusions"], len(asked["ids"]))
        self.assertEqual(said["consistencies"], len(notes) * (len(notes) - 1) // 2)
        self.assertEqual(said["forged_accepted"], 0)
        self.assertGreaterEqual(said["forged_refused"], 4)


class Tampered(StorageTest):
    """What is done to the file past the service, and what `verify` says of it."""

    ROWS = 300

    def setUp(self):
        self.daemon = self.make_daemon()
        self.daemon.start()
        self.assertEqual(self.daemon.measure([PART] * self.ROWS).status, 201)
        self.kept = self.daemon.folder / "kept"
        self.kept.write_text(wait_for_size(self.daemon, self.ROWS))
        self.assertEqual(self.daemon.stop(), 0)

    def verify(self, *files):
        flags = [flag for file in files for flag in ("--checkpoint", file)]
        return self.daemon.command("verify", *flags)

    def assert_found(self, text, *files):
        verified = self.verify(*files)
        self.assertEqual(verified.returncode, 1, verified.stdout + verified.stderr)
        self.assertIn(text, verified.stdout)

    def test_a_whole_log_has_no_findings(self):
        self.assertIn("give --checkpoint FILE", self.verify().stdout)
        verified = self.verify(self.kept)
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
        self.assertIn(f": {self.ROWS} measurements, root ", verified.stdout)
        self.assertNotIn("--checkpoint FILE", verified.stdout)
        # An older one is no finding.
        self.daemon.start()
        self.daemon.measure(PART)
        wait_for_size(self.daemon, self.ROWS + 1)
        self.assertEqual(self.daemon.stop(), 0)
        self.assertEqual(self.verify(self.kept).returncode, 0)

    def test_an_altered_and_a_swapped_row(self):
        alter(self.daemon.database, *UNTRIGGERED, "UPDATE measurements SET measured_nm = 25014000 WHERE id = 17",
              "UPDATE measurements SET id = 900 WHERE id = 20", "UPDATE measurements SET id = 20 WHERE id = 21",
              "UPDATE measurements SET id = 21 WHERE id = 900")
        verified = self.verify(self.kept).stdout
        for row in (17, 20, 21):
            self.assertIn(f"measurement {row} was altered", verified)

    def test_a_row_altered_together_with_its_leaf(self):
        with_leaf = "UPDATE measurements SET hash = (SELECT hash FROM measurements WHERE id = {1}) WHERE id = {0}"
        alter(self.daemon.database, *UNTRIGGERED, with_leaf.format(3, 4))
        self.assert_found("measurement 3 was altered")

        record = self.daemon_record(280, "UPDATE measurements SET comment = 'x' WHERE id = 280")
        leaf = check_proof.leaf_of(record).hex()
        alter(self.daemon.database, f"UPDATE measurements SET hash = x'{leaf}' WHERE id = 280",
              with_leaf.format(3, 2))
        verified = self.verify(self.kept).stdout
        self.assertNotIn("measurement 280 was", verified)
        self.assertIn(f"measurements up to {self.ROWS} differ from the ones that", verified)

    def daemon_record(self, row, statement):
        """The record of a row after an alteration, as the service shows it."""
        alter(self.daemon.database, statement)
        self.daemon.start()
        record = self.daemon.get(f"/v1/measurements/m{row}").text
        self.assertEqual(self.daemon.stop(), 0)
        return record

    def test_rows_cut_off(self):
        alter(self.daemon.database, *UNTRIGGERED, "DELETE FROM measurements WHERE id > 290")
        self.assert_found("the newest are missing")
        # Their ids are never given out again: it does not start.
        self.assert_refused(self.daemon, "contains 290", "newest measurements are missing")

    def test_rows_cut_off_with_all_that_the_folder_knows_of_them(self):
        (self.daemon.data / "fitgauge.checkpoint").unlink()
        alter(self.daemon.database, *UNTRIGGERED, "DELETE FROM measurements WHERE id > 256", "UPDATE log SET size = 256", sealed_anew("log"),
              "DELETE FROM measurement_nodes", "DELETE FROM measurement_postings", "DELETE FROM measurement_aggregates",
              "DELETE FROM measurement_values")
        self.assertNotIn("cut off", self.verify().stdout, "the folder alone cannot tell")
        self.assert_found("the newest are missing", self.kept)

    def test_what_the_log_says_of_itself(self):
        for change in ("UPDATE log SET size = 12", "UPDATE log_keys SET vkey = 'x' || vkey",
                       "UPDATE log_nodes SET hash = zeroblob(32)", "DELETE FROM log_nodes"):
            with self.subTest(change):
                copy = self.make_daemon()
                shutil.copytree(self.daemon.data, copy.data)
                alter(copy.database, change)
                self.assertEqual(copy.command("verify").returncode, 1)

    def test_a_row_taken_out_of_the_middle(self):
        alter(self.daemon.database, *UNTRIGGERED, "DELETE FROM measurements WHERE id = 100")
        self.assert_found("measurements 100 to 100 are missing")

    def test_another_log_and_a_broken_checkpoint(self):
        other = self.stopped_with(2)
        self.assert_found("is not a checkpoint of this log", other.data / "fitgauge.checkpoint")
        self.kept.write_text(self.kept.read_text().replace(f"\n{self.ROWS}\n", f"\n{self.ROWS - 1}\n"))
        self.assert_found("is not a checkpoint of this log", self.kept)
        self.assertEqual(self.verify(self.daemon.folder / "none").returncode, 2)
        self.assertEqual(command("verify", "--data", self.daemon.folder / "none").returncode, 2)

    def test_everything_rewritten_with_a_new_key(self):
        twin = self.make_daemon()
        twin.start()
        twin.measure([PART] * self.ROWS)
        wait_for_size(twin, self.ROWS)
        self.assertEqual(twin.stop(), 0)
        self.assertEqual(twin.command("verify").returncode, 0)
        self.daemon = twin
        self.assert_found("is not a checkpoint of this log", self.kept)

    def test_an_older_copy_put_back(self):
        copy = self.daemon.folder / "copy.db"
        self.assertEqual(self.daemon.command("backup", copy).returncode, 0)
        self.assertEqual(pathlib.Path(f"{copy}.checkpoint").read_text(), self.kept.read_text())
        self.daemon.start()
        self.daemon.measure([PART] * 10)
        later = wait_for_size(self.daemon, self.ROWS + 10)
        self.kept.write_text(later)
        self.assertEqual(self.daemon.stop(), 0)
        for name in ("fitgauge.db-wal", "fitgauge.db-shm"):
            (self.daemon.data / name).unlink(missing_ok=True)
        shutil.copy(copy, self.daemon.database)
        self.assert_found("an older copy was restored")
        self.daemon.start()
        self.assertEqual(self.daemon.stop(), 0)
        self.assertIn('"event":"log_branched"', self.daemon.log)
        self.assert_found("an older copy was restored", self.kept)
        # Up to the branch the earlier checkpoints hold.
        verified = self.daemon.command("verify", "--checkpoint", f"{copy}.checkpoint")
        self.assertEqual(verified.returncode, 0, verified.stdout)


class Tamperings(StorageTest):
    """Tamperings of each kind in turn, at a row by chance: a checkpoint kept elsewhere shows all. $SEED repeats them."""

    ROWS = 300
    KINDS = ("alter", "swap", "delete", "cut", "older", "rewrite")
    CHANGES = ("measured_nm = measured_nm + 1", "received_at = received_at - 1", "part_id = 'SN-2'", "comment = ' '",
               "operator = '7'", "upper_deviation_nm = upper_deviation_nm + 1", "caller = 'x'", "cycle = 421")

    def stored(self, rows):
        daemon = self.make_daemon()
        daemon.start()
        self.assertEqual(daemon.measure([PART] * rows).status, 201)
        note = wait_for_size(daemon, rows)
        return daemon, note

    def tamper(self, chance, what, data, older, twin):
        """Does one thing to a copy of the folder. @returns what."""
        row, other = chance.sample(range(1, self.ROWS), 2)
        hide = ("UPDATE log SET size = (SELECT max(id) FROM measurements)", sealed_anew("log"), "DELETE FROM measurement_nodes",
                "DELETE FROM measurement_postings", "DELETE FROM measurement_aggregates",
                "DELETE FROM measurement_values")
        swap = [f"UPDATE measurements SET id = {to} WHERE id = {at}" for at, to in ((row, 900), (other, row), (900, other))]
        change = f"UPDATE measurements SET {chance.choice(self.CHANGES)} WHERE id = {row}"
        if what in ("older", "rewrite"):
            shutil.rmtree(data)
            shutil.copytree(older if what == "older" else twin, data)
            return what
        (data / "fitgauge.checkpoint").unlink()
        statements = {"alter": [change], "swap": swap, "delete": [f"DELETE FROM measurements WHERE id = {row}"],
                      "cut": [f"DELETE FROM measurements WHERE id > {row}", *hide]}[what]
        alter(data / "fitgauge.db", *UNTRIGGERED, *statements)
        return f"{what}: {statements[0]}"

    def test_each_is_found(self):
        count, seed = 100 if DEEP else 12, int(os.environ.get("SEED", time.time_ns() % 1_000_000))
        print(f"seed {seed}, {count} tamperings")
        chance = random.Random(seed)
        daemon, _ = self.stored(self.ROWS - 50)
        self.assertEqual(daemon.stop(), 0)
        older = daemon.folder / "older"
        shutil.copytree(daemon.data, older)
        daemon.start()
        daemon.measure([PART] * 50)
        kept = daemon.folder / "kept"
        kept.write_text(wait_for_size(daemon, self.ROWS))
        self.assertEqual(daemon.stop(), 0)
        twin, _ = self.stored(self.ROWS)
        self.assertEqual(twin.stop(), 0)
        # The controls: an untouched folder is clean, and so are by themselves those that the checkpoint alone tells.
        self.assertEqual(daemon.command("verify", "--checkpoint", kept).returncode, 0)
        for whole in (older, twin.data):
            self.assertEqual(command("verify", "--data", whole).returncode, 0)
        for number in range(count):
            data = daemon.folder / f"copy-{number}"
            shutil.copytree(daemon.data, data)
            what = self.tamper(chance, self.KINDS[number % len(self.KINDS)], data, older, twin.data)
            verified = command("verify", "--data", data, "--checkpoint", kept)
            self.assertEqual(verified.returncode, 1, f"{what}\n{verified.stdout}{verified.stderr}")
            shutil.rmtree(data)


class Names(StorageTest):
    """A package starts its service before anybody can name the station."""

    def name_of(self, daemon):
        return daemon.get("/v1/log/checkpoint").text.split("\n")[0]

    def test_an_empty_log_takes_another_name(self):
        daemon = self.make_daemon()
        daemon.start()
        bore = {"name": "bore", "designation": "25 H7"}
        self.assertEqual(daemon.request("PUT", "/v1/plans/4711", {"characteristics": [bore]}).status, 201)
        first = self.name_of(daemon)
        self.assertRegex(first, "^fitgauge/station/[0-9a-f]{8}$")
        self.assertEqual(daemon.stop(), 0)
        daemon.flags = ["--origin-name", "plant-3/press-7"]
        daemon.start()
        name = self.name_of(daemon)
        self.assertRegex(name, "^fitgauge/plant-3/press-7/[0-9a-f]{8}$")
        daemon.wait_for_log(f"{first} continues as {name}")
        self.assertEqual(daemon.measure(PART).json["id"].split("-")[1][:8], name[-8:])
        self.assertEqual(daemon.stop(), 0)
        self.assertNotIn("log_name_kept", daemon.log)
        self.assertEqual(daemon.command("verify").returncode, 0)

    def test_a_log_with_measurements_keeps_its_name_and_logs_so(self):
        daemon = self.stopped_with(1)
        daemon.flags = ["--origin-name", "press-8"]
        daemon.start()
        name = self.name_of(daemon)
        self.assertRegex(name, "^fitgauge/station/")
        daemon.wait_for_log(f"the measurement log is {name} and stays so: origin-name press-8 is for an empty log")
        self.assertEqual(daemon.stop(), 0)
        daemon.flags = []
        daemon.start()
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual(daemon.log.count('"event":"log_name_kept"'), 1, daemon.log)


class Keys(StorageTest):
    def test_a_lost_key(self):
        daemon = self.stopped_with(3)
        key = daemon.data / "fitgauge.log.key"
        self.assertEqual(key.stat().st_mode & 0o777, 0o600)
        key.unlink()
        daemon.start()
        keys = daemon.get("/v1/log/key").text.split()
        self.assertEqual(len(keys), 2)
        daemon.wait_for_log('"event":"log_key_lost"')
        record = daemon.measure(PART)
        proof = daemon.get(f"/v1/measurements/{record.json['id']}/proof").json
        self.assertIsNone(check_proof.check(record.text, proof, keys[:1]))
        self.assertIsNotNone(check_proof.check(record.text, proof, keys[1:]))
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual(daemon.command("verify").returncode, 0)

    def test_a_new_key_signs_beside_the_old_one_once(self):
        daemon = self.stopped_with(3)
        self.assertEqual(daemon.command("log-key").returncode, 0)
        daemon.start()
        new, old = daemon.get("/v1/log/key").text.split()
        hand_over, = daemon.data.glob("fitgauge.checkpoint.*")
        for key in (new, old):
            self.assertTrue(check_proof.is_signed(hand_over.read_text(), [key]))
        daemon.measure(PART)
        note = wait_for_size(daemon, 4)
        self.assertTrue(check_proof.is_signed(note, [new]))
        self.assertFalse(check_proof.is_signed(note, [old]))
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual(len((daemon.data / "fitgauge.log.key").read_text().splitlines()), 1)
        self.assertEqual(len(list(daemon.data.glob("fitgauge.checkpoint.*"))), 1, "the hand-over is kept")

    def test_a_key_that_cannot_be_read_refuses_the_start(self):
        daemon = self.stopped_with(1)
        (daemon.data / "fitgauge.log.key").write_text("PRIVATE+KEY+nonsense\n")
        self.assert_refused(daemon, "fitgauge.log.key", "move the file away")


if __name__ == "__main__":
    unittest.main()
