"""A station that forwards its log: its centre away, itself killed, the link between them cut at random bytes."""

import json
import os
import random
import re
import shutil
import subprocess
import threading
import time
import unittest

from log.test_intake import check_proof, origin_of, records_of
from log.test_log import wait_for_size
from durability.test_storage import PART
from support.cutting_proxy import CuttingProxy
from support.daemon import FITGAUGED, SANITIZED, Daemon, command
from support.ports import lasting_address
from support.postgres import Cluster
from support.waiting import PATIENCE, wait_for

SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))
DEEP = bool(os.environ.get("TESTS_DEEP"))
ROWS, KILLS, PIECE = (100_000, 20, 5_000) if DEEP else (1_500, 4, 300)
DRAINING = PATIENCE * (4 if DEEP else 1)  # seconds


def metric(daemon, name):
    found = re.search(rf"^{name} (\S+)$", daemon.get("/metrics").text, re.MULTILINE)
    return float(found.group(1)) if found else None


def head_of(daemon, size):
    return wait_for_size(daemon, size).split("\n")[1:3]


def notes_of(daemon, record):
    return daemon.get(f"/v1/measurements/{record['id']}/notes").json.get("notes")


def note(daemon, record, text):
    answer = daemon.post(f"/v1/measurements/{record['id']}/notes", {"cause": text, "operator": "Kim"})
    assert answer.status == 201, answer
    return answer.json


class Forwarding(unittest.TestCase):
    def setUp(self):
        self.centre = self.made("--origin-name", "centre", listen=lasting_address()).start()

    def made(self, *flags, **named):
        daemon = Daemon(*flags, **named)
        self.addCleanup(daemon.cleanup)
        return daemon

    def station(self, port, *flags, host="127.0.0.1"):
        return self.made("--origin-name", "plant-3/press-7", "--forward-to", f"http://{host}:{port}", *flags)

    def wait_for_rows(self, count):
        wait_for(lambda: len(records_of(self.centre)) >= count, f"{count} rows at the centre")

    def wait_until_drained(self, station):
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox", DRAINING)

    def assert_same(self, station):
        """The centre holds exactly the station's rows, each once and in their order, under the same root."""
        records = records_of(station)
        self.assertEqual(records_of(self.centre), records)
        last = records[-1].split('"id":"')[1].split('"')[0]
        proof = self.centre.get(f"/v1/measurements/{last}/proof").json
        self.assertEqual(proof["checkpoint"].split("\n")[1:3], head_of(station, len(records)))
        verified = command("verify", "--data", self.centre.data)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        return records

    def test_a_value_is_at_the_centre_soon_after_it_was_stored(self):
        station = self.station(self.centre.port).start()
        self.assertEqual(metric(station, "fitgauge_outbox_rows"), 0)
        record = station.measure({**PART, "part_id": "P-1"}, {"Idempotency-Key": "k-1"}).json
        self.wait_for_rows(1)
        self.assertEqual(self.centre.get(f"/v1/measurements/{record['id']}").json, record)
        again = self.centre.measure({**PART, "part_id": "P-1"}, {"Idempotency-Key": "k-1"})
        self.assertEqual(again.json, record, "the answer came with its row")
        station.post(f"/v1/measurements/{record['id']}/corrections", {"measured_mm": 25.5, "reason": "misread"})
        self.wait_for_rows(2)
        self.assertIn("corrected_by", self.centre.get(f"/v1/measurements/{record['id']}").json)
        self.wait_until_drained(station)
        self.assertEqual(metric(station, "fitgauge_outbox_oldest_seconds"), 0)
        self.assert_same(station)

    def test_notes_of_a_station_are_at_the_centre_once_and_in_their_order(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        for engine in ("sqlite", "postgres"):
            with self.subTest(engine=engine):
                flags = ["--database", cluster.address()] if engine == "postgres" else []
                self.centre = self.made("--origin-name", "centre", *flags, listen=lasting_address()).start()
                station = self.station(self.centre.port).start()
                record = station.measure(PART).json
                made = [note(station, record, "worn")]
                wait_for(lambda: notes_of(self.centre, record) == made, "the note at the centre")  # noqa: B023
                own = note(self.centre, record, "seen at the centre")
                correction = self.centre.post(f"/v1/measurements/{record['id']}/corrections",
                                              {"measured_mm": 25.001, "reason": "misread"}).json
                wait_for(lambda: station.get(f"/v1/measurements/{correction['id']}").status == 200, "it")  # noqa: B023
                self.centre.kill()
                made.append(note(station, record, "while the centre is away"))
                later = station.measure(PART).json
                others = [(later, note(station, later, "on a record that waits too")),
                          (correction, note(station, correction, "on what the centre has corrected"))]
                station.kill()
                station.start()
                made.append(note(station, record, "after a restart"))
                self.centre.start()
                wait_for(lambda: notes_of(self.centre, record) == [made[0], own, *made[1:]], "all of them")  # noqa: B023
                for noted, said in others:
                    self.assertEqual(notes_of(self.centre, noted), [said])
                self.assertEqual(notes_of(station, record), made, "the centre's own stays there")
                stored = re.findall('"cause":"([^"]*)"', self.centre.get("/v1/measurements?notes=only&history=all").text)
                self.assertEqual(len(stored), 6, stored)
                for daemon, at in ((self.centre, flags), (station, [])):
                    daemon.stop()
                    verified = daemon.command("verify", *at)
                    self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_nothing_is_lost_or_doubled_however_the_link_and_both_ends_fail(self):
        print(f"seed {SEED}")
        chance = random.Random(SEED)
        proxy = CuttingProxy(self.centre.port, SEED, longest=400_000 if DEEP else 60_000)
        self.addCleanup(proxy.close)
        station = self.station(proxy.port).start()
        self.centre.kill()
        stored = 0
        while stored < ROWS:
            parts = [{**PART, "part_id": f"{chance.getrandbits(128):032x}"} for _ in range(PIECE)]
            self.assertEqual(station.measure(parts).status, 201)
            stored += PIECE
        self.assertEqual(wait_for(lambda: metric(station, "fitgauge_outbox_rows"), "a full outbox"), stored)
        wait_for(lambda: metric(station, "fitgauge_outbox_oldest_seconds"), "an age")
        noted = [station.measure(PART).json]
        stored += 1
        for kill in range(KILLS):
            if kill % 2:
                station.kill()
                station.start()
                noted.append(station.measure(PART).json)
                stored += 1
            note(station, noted[-1], f"kill {kill}")
            if kill % 3 == 0:
                if self.centre.process.poll() is None:
                    self.centre.kill()
                self.centre.start()
                proxy.port_behind = self.centre.port
            wanted = proxy.passed + chance.randrange(20_000)
            wait_for(lambda: proxy.passed >= wanted or metric(station, "fitgauge_outbox_rows") == 0, "bytes on the link")
        wait_for(lambda: proxy.cut, "a connection that was cut")
        proxy.cuts = False
        begun = time.monotonic()
        self.wait_until_drained(station)
        print(f"{stored} rows; {proxy.cut} connections cut; drained after {time.monotonic() - begun:.1f} s")
        self.assertEqual(len(self.assert_same(station)), stored)
        for record in noted:
            wait_for(lambda one=record: notes_of(self.centre, one) == notes_of(station, one), "the notes")
        self.assertEqual(sum(len(notes_of(self.centre, record)) for record in noted), KILLS)

    def test_a_station_that_was_away_sends_what_the_centre_lacks_and_no_more(self):
        station = self.station(self.centre.port).start()
        station.measure([PART] * 20)
        self.wait_for_rows(20)
        self.wait_until_drained(station)
        station.stop()
        self.centre.stop()
        backup = self.centre.folder / "backup"
        shutil.copytree(self.centre.data, backup)
        other = self.made("--origin-name", "centre")
        # The centre lost what came after its copy was made: the station's log fills it up again.
        station.start()
        station.measure([PART] * 10)
        other.data = backup
        other.listen = self.centre.listen
        other.start()
        self.centre = other
        self.wait_for_rows(30)
        self.wait_until_drained(station)
        self.assert_same(station)

    def test_a_folder_that_was_copied_is_named_at_both_ends(self):
        station = self.station(self.centre.port).start()
        station.measure([PART] * 3)
        self.wait_for_rows(3)
        self.wait_until_drained(station)
        station.stop()
        twin = self.station(self.centre.port)
        shutil.copytree(station.data, twin.data)
        station.start()
        twin.start()
        station.measure({**PART, "part_id": "first"})
        self.wait_for_rows(4)
        twin.measure({**PART, "part_id": "twin"})
        twin.wait_for_log('"event":"forward_refused"')
        twin.wait_for_log("copied and started twice")
        self.centre.wait_for_log('"event":"log_forked"')
        self.assertEqual(metric(twin, "fitgauge_outbox_rows"), 1)
        self.assertEqual(twin.measure(PART).json["code"], "log.forked")
        station.measure(PART)
        self.wait_for_rows(5)
        self.wait_until_drained(station)
        self.assert_same(station)
        self.assertEqual(len(records_of(twin)), 4)

    def test_a_whole_folder_moves_into_a_centre_and_its_proofs_stay(self):
        folder = self.made("--origin-name", "old-service").start()
        kept = folder.folder / "kept"
        first = folder.measure([PART] * 1200, {"Prefer": "return=representation"}).json["measurements"][0]
        folder.post(f"/v1/measurements/{first['id']}/corrections", {"measured_mm": 25.5, "reason": "misread"})
        said = note(folder, first, "worn")
        records = records_of(folder)
        kept.write_text(wait_for_size(folder, 1201))
        keys = folder.get("/v1/log/key").text.split()

        def forward(port, *flags):
            # It waits a minute for a centre that is not there.
            return command("forward", *flags, "--data", folder.data, "--forward-to", f"http://127.0.0.1:{port}", timeout=120)

        self.assertNotEqual(forward(self.centre.port, "--all").returncode, 0, "the service has the folder")
        folder.stop()
        self.assertEqual(forward(self.centre.port).returncode, 2, "--all is said")
        self.assertEqual(command("forward", "--all", "--data", folder.data).returncode, 2, "where to?")
        # The first try ends half way; the second goes on from there.
        proxy = CuttingProxy(self.centre.port, SEED, longest=30_000)
        self.addCleanup(proxy.close)
        half = subprocess.Popen([FITGAUGED, "forward", "--all", "--data", folder.data, "--forward-to",
                                 f"http://127.0.0.1:{proxy.port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(lambda: proxy.cut, "a connection that was cut")
        half.kill()
        half.wait()
        for _ in range(2):  # once more changes nothing
            done = forward(self.centre.port, "--all")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("1201 measurements, root", done.stdout)
            self.assertEqual(records_of(self.centre), records)
            self.assertEqual(notes_of(self.centre, first), [said])
        for line in (records[0], records[700], records[-1]):
            proof = self.centre.get(f"/v1/measurements/{json.loads(line)['id']}/proof").json
            self.assertIsNone(check_proof.check(line, proof, keys))
        self.assertEqual(proof["checkpoint"].split("\n")[1:3], kept.read_text().split("\n")[1:3])
        verified = command("verify", "--data", self.centre.data, "--checkpoint", kept)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        # A twin that went on elsewhere is refused, with its rows counted.
        twin = self.made("--origin-name", "old-service")
        shutil.copytree(folder.data, twin.data)
        for daemon in (folder, twin):
            daemon.start()
            daemon.measure({**PART, "part_id": str(daemon.port)})
            daemon.stop()
        self.assertEqual(forward(self.centre.port, "--all").returncode, 0)
        refused = command("forward", "--all", "--data", twin.data, "--forward-to", f"http://127.0.0.1:{self.centre.port}")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertIn("1 measurements have not reached", refused.stdout)
        self.assertEqual(forward(1, "--all").returncode if DEEP else 1, 1, "nobody there")

    def test_a_station_goes_on_with_a_new_key_of_its_log(self):
        station = self.station(self.centre.port).start()
        station.measure(PART)
        self.wait_for_rows(1)
        for _ in range(2):
            station.stop()
            self.assertEqual(station.command("log-key").returncode, 0)
            station.start()
        station.measure(PART)
        self.wait_for_rows(2)
        self.wait_until_drained(station)
        self.assert_same(station)

    def test_a_key_is_sent_and_one_of_another_role_is_refused(self):
        centre = self.made("--auth", "keys").start()
        tokens = {}
        for role in ("operator", "station"):
            made = centre.command("key", "create", "--name", role, "--role", role)
            tokens[role] = re.search(r"fg_[0-9a-f]+", made.stdout).group()
        key_file = centre.folder / "key"
        key_file.write_text(tokens["operator"] + "\n")
        station = self.station(centre.port, "--forward-key-file", key_file, host="localhost").start()
        station.measure(PART)
        station.wait_for_log('"event":"forward_refused"')
        key_file.write_text(tokens["station"] + "\n")
        wait_for(lambda: metric(station, "fitgauge_outbox_rows") == 0, "an empty outbox")

    def test_a_key_that_the_centre_does_not_know_yet_is_sent_again(self):
        folder = self.made().start()
        folder.measure(PART)
        folder.stop()
        proxy = CuttingProxy(self.centre.port, SEED, cuts=False)
        self.addCleanup(proxy.close)
        proxy.refusals = 2
        forward = ("forward", "--all", "--data", folder.data, "--forward-to", f"http://127.0.0.1:{proxy.port}")
        done = command(*forward)
        self.assertEqual((done.returncode, proxy.refusals), (0, 0), done.stdout + done.stderr)
        self.assertEqual(len(records_of(self.centre)), 1)
        proxy.refusals = 1_000_000
        folder.start()
        folder.measure(PART)
        folder.stop()
        refused = command(*forward)
        self.assertEqual(refused.returncode, 1)
        self.assertIn("401", refused.stdout)

    def test_a_failure_ends_when_the_centre_has_the_note_whose_answer_was_lost(self):
        proxy = CuttingProxy(self.centre.port, SEED, cuts=False)
        self.addCleanup(proxy.close)
        station = self.station(proxy.port).start()
        record = station.measure(PART).json
        self.wait_until_drained(station)
        proxy.unanswered = b"PUT "
        said = note(station, record, "worn")
        station.wait_for_log('"event":"forward_failed"')
        station.wait_for_log('"event":"forward_goes_on"')
        self.assertEqual(notes_of(self.centre, record), [said])

    def test_settings_that_would_send_in_the_clear_are_refused(self):
        for flags, word in {("--forward-to", "http://centre.example"): "forward-insecure",
                            ("--forward-to", "centre.example"): "https://host",
                            ("--forward-to", "https://centre.example/v1"): "https://host",
                            ("--forward-key-file", "/etc/hostname"): "forward-to",
                            ("--forward-to", "https://centre.example", "--forward-key-file", "/no/file"):
                                "cannot read"}.items():
            checked = command(*flags, "--check-config")
            self.assertEqual(checked.returncode, 2, checked)
            self.assertIn(word, checked.stderr)
        for flags in (("--forward-to", "https://centre.example:8286/"), ("--forward-to", "http://[::1]:8286"),
                      ("--forward-to", "http://centre.example", "--forward-insecure")):
            self.assertEqual(command(*flags, "--check-config").returncode, 0, flags)


class Stations(unittest.TestCase):
    def test_many_stations_forward_to_one_centre_at_once(self):
        centre = Daemon("--origin-name", "centre").start()
        self.addCleanup(centre.cleanup)
        count, rows = (20, 5_000) if DEEP else (3 if SANITIZED else 5, 200)
        stations = []
        for _ in range(count):
            station = Daemon("--origin-name", "press", "--forward-to", f"http://127.0.0.1:{centre.port}")
            self.addCleanup(station.cleanup)
            stations.append(station.start())

        def fill(station):
            for _ in range(0, rows, 100):
                station.measure([PART] * 100)
                centre.measure(PART)

        threads = [threading.Thread(target=fill, args=(station,)) for station in stations]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        total = count * (rows + rows // 100)
        wait_for(lambda: len(records_of(centre)) == total, "the rows of all", DRAINING)
        for station in stations:
            wait_for(lambda one=station: metric(one, "fitgauge_outbox_rows") == 0, "an empty outbox")
        there = {}
        for line in records_of(centre):
            there.setdefault(origin_of([line]), []).append(line)
        for station in stations:
            records = records_of(station)
            self.assertEqual(there.pop(origin_of(records)), records)
        self.assertEqual(sum(map(len, there.values())), count * rows // 100, "the centre's own")
        verified = centre.command("verify")
        self.assertEqual(verified.returncode, 0, verified.stdout)


if __name__ == "__main__":
    unittest.main()
