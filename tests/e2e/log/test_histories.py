"""A copy put back begins a branch: no id is given out twice, what the copy holds stays valid, and receivers that
deduplicate by id lose nothing."""

import base64
import json
import pathlib
import shutil
import unittest

from durability.test_storage import PART
from log.test_log import wait_for_size
from measurements.test_events import Reader
from support.broker import Broker
from support.daemon import Daemon
from support.receiver import Receiver
from support.waiting import wait_for


def parts(names):
    return [{**PART, "part_id": name} for name in names.split()]


class Restored(unittest.TestCase):
    def made(self, *flags, **named):
        daemon = Daemon(*flags, **named)
        self.addCleanup(daemon.cleanup)
        return daemon

    def store(self, daemon, names):
        """Stores parts one by one. @returns their ids."""
        answers = [daemon.measure(part) for part in parts(names)]
        self.assertEqual([answer.status for answer in answers], [201] * len(answers), answers)
        return [answer.json["id"] for answer in answers]

    def backup(self, daemon, name="backup.db"):
        copy = daemon.folder / name
        self.assertEqual(daemon.command("backup", copy).returncode, 0)
        return copy

    def plain_copy(self, daemon):
        """A copy of the database of a service that has ended, which goes on then."""
        copy = daemon.folder / "copy.db"
        self.assertEqual(daemon.stop(), 0)
        shutil.copy(daemon.database, copy)
        daemon.start()
        return copy

    def restore(self, daemon, copy):
        """As the guide says."""
        damaged = daemon.data / "damaged"
        damaged.mkdir()
        for file in list(daemon.data.glob("fitgauge.db*")):
            file.rename(damaged / file.name)
        shutil.copy(copy, daemon.database)

    def assert_clean(self, daemon, *flags):
        verified = daemon.command("verify", *flags)
        self.assertEqual(verified.returncode, 0, verified.stdout)

    def assert_unique(self, *ids):
        self.assertEqual(len(set(sum(ids, []))), sum(map(len, ids)), ids)

    def first_new_event(self, daemon, last):
        reader = Reader(daemon, last=last)
        self.addCleanup(reader.close)
        return reader.event()


class Folders(Restored):
    def test_the_guide_loses_nothing_at_a_receiver_that_deduplicates(self):
        receiver, daemon = Receiver(), self.made("--allow-private-addresses").start()
        self.addCleanup(receiver.close)
        connected = daemon.request("PUT", "/v1/connections/mes", {
            "kind": "webhook", "url": receiver.url, "events": ["measurement.recorded", "note.added"],
            "secrets": ["whsec_" + base64.b64encode(bytes(32)).decode()], "longest_wait_s": 1})
        self.assertEqual(connected.status, 201, connected)
        kept = self.store(daemon, "d1 d2 d3")
        daemon.post(f"/v1/measurements/{kept[0]}/notes", {"text": "kept"})
        copy = self.backup(daemon)
        lost = self.store(daemon, "d4 d5")
        daemon.post(f"/v1/measurements/{lost[0]}/notes", {"text": "lost"})
        wait_for(lambda: len(receiver.distinct()) == 7, receiver.ids)
        reader = Reader(daemon, last="m0.e0")
        self.addCleanup(reader.close)
        places = []
        for _ in range(7):
            reader.event()
            places.append(reader.last)
        cursor = daemon.get("/v1/measurements?limit=3").json["next"]
        self.assertEqual(daemon.stop(), 0)
        self.restore(daemon, copy)
        daemon.start()
        new = self.store(daemon, "n6 n7 n8")
        daemon.post(f"/v1/measurements/{new[0]}/notes", {"text": "new"})
        self.assert_unique(kept, lost, new)
        wait_for(lambda: {event["event"]["data"]["part_id"] for event in receiver.events
                          if event["event"]["type"] == "measurement.recorded"} >= {"n6", "n7", "n8"}, receiver.ids)
        wait_for(lambda: len(receiver.distinct()) == 11, receiver.ids)
        # A replay begins at an event of the copy too, and at none that went beyond.
        of_kept, of_lost, of_new = (name for name in receiver.distinct() if name.startswith("e"))
        for place, status in ((of_new, 200), (of_lost, 422), (of_kept, 200)):
            answer = daemon.post("/v1/connections/mes/replay", {"from": place})
            self.assertEqual(answer.status, status, answer)
        # What the copy holds has its id, and its place; what went beyond is foreign.
        self.assertEqual([record["id"] for record in daemon.stored()], kept + new)
        for known in kept:
            self.assertEqual(daemon.get(f"/v1/measurements/{known}").json["id"], known)
        after = daemon.get(f"/v1/measurements?after={kept[-1]}").json["measurements"]
        self.assertEqual([record["id"] for record in after], new)
        for gone in lost:
            self.assertEqual(daemon.get(f"/v1/measurements/{gone}").status, 404)
            answer = daemon.get(f"/v1/measurements?after={gone}")
            self.assertEqual((answer.status, answer.json["code"]), (400, "cursor.invalid"))
        answer = daemon.get(f"/v1/measurements?limit=3&after={cursor}")
        self.assertEqual((answer.status, answer.json["code"]), (400, "cursor.invalid"), "as of m5")
        self.assertEqual(self.first_new_event(daemon, places[2])[1]["id"], new[0])
        for place in places[4:]:
            self.assertEqual(self.first_new_event(daemon, place)[0], "resync")
        self.assertEqual(daemon.get("/readyz").status, 200)
        daemon.wait_for_log('"event":"log_branched"')
        wait_for_size(daemon, 6)
        for record in kept + new:
            self.assertEqual(daemon.get(f"/v1/measurements/{record}/proof").status, 200)
        self.assert_clean(daemon)
        # Another start is none of a copy.
        daemon.stop()
        daemon.start()
        self.assertEqual(self.store(daemon, "n9")[0].split("-")[1], new[0].split("-")[1])
        self.assertEqual(daemon.log.count('"event":"log_branched"'), 1)

    def test_a_reader_of_changes_misses_nothing_and_repeats_nothing(self):
        daemon = self.made().start()
        read = lambda query: daemon.get(f"/v1/changes?{query}")

        def put(*names):
            for name in names:
                budget = {"contributions": [{"name": name, "standard_uncertainty": 0.8}]}
                self.assertEqual(daemon.request("PUT", f"/v1/uncertainties/{name}", budget).status, 201)

        self.assertIsNone(read("").json["last"])
        put("a", "b")
        kept = read("limit=1").json
        self.assertEqual(kept["next"], kept["last"])
        copy = self.backup(daemon)
        held = read("").json["last"]
        put("c", "d")
        lost = read(f"after={held}").json
        self.assertEqual([change["name"] for change in lost["changes"]], ["c", "d"])
        self.assertEqual(read(f"after={lost['last']}").json, {"changes": [], "next": None, "last": lost["last"]})
        self.assertEqual(daemon.stop(), 0)
        self.restore(daemon, copy)
        daemon.start()
        put("e", "f", "g")
        new = read(f"after={held}").json
        self.assertEqual([change["name"] for change in new["changes"]], ["e", "f", "g"])
        self.assertEqual([change["name"] for change in read(f"after={kept['next']}").json["changes"]], ["b", "e", "f", "g"])
        self.assertNotEqual(new["last"].split("-")[1], held.split("-")[1])
        # No id is given out twice, and what is of a history before keeps its own.
        lost_ids = [change["id"] for change in lost["changes"]]
        listed = [change["id"] for change in read("").json["changes"]]
        self.assertEqual(listed[:2], [kept["changes"][0]["id"], held])
        self.assertEqual(len({*listed, *lost_ids}), 5 + 2)
        self.assertEqual([change["name"] for change in read(f"after={listed[2]}").json["changes"]], ["f", "g"])
        # The numbers of the lost ones are given to others: as a cursor neither is known.
        for cursor in (lost["last"], *lost_ids, "4", "c9-" + new["last"].split("-")[1], "x"):
            answer = read(f"after={cursor}")
            self.assertEqual((answer.status, answer.json["code"]), (400, "cursor.invalid"), cursor)
        self.assertEqual(len(read(f"after={kept['changes'][0]['id']}").json["changes"]), 4)
        daemon.stop()
        daemon.start()
        self.assertEqual(read(f"after={new['last']}").json["changes"], [])
        self.assert_clean(daemon)

    def test_a_backup_at_once_after_a_write_covers_it(self):
        daemon = self.made().start()
        self.store(daemon, "d1 d2 d3")
        copy = self.backup(daemon)
        self.assertEqual(pathlib.Path(f"{copy}.checkpoint").read_text().split("\n")[1], "3")
        self.store(daemon, "d4 d5")
        wait_for_size(daemon, 5)
        self.assertEqual(daemon.stop(), 0)
        self.restore(daemon, copy)
        daemon.start()
        daemon.wait_for_log("has signed 5 measurements, and the database has 3")

    def test_a_backup_says_what_its_checkpoint_covers(self):
        daemon = self.made().start()
        self.store(daemon, "d1 d2")
        wait_for_size(daemon, 2)
        daemon.stop()
        self.assertIn("covers the 2 measurements", daemon.command("backup", daemon.folder / "signed.db").stdout)
        daemon.start()
        self.store(daemon, "d3")
        wait_for_size(daemon, 3)
        daemon.stop()
        self.restore(daemon, daemon.folder / "signed.db")
        newer = daemon.data / "fitgauge.checkpoint"
        verified = daemon.command("verify", "--checkpoint", newer)
        self.assertEqual(verified.returncode, 1)
        self.assertIn(f"{newer} covers 3 measurements, and the database has only 2: it is newer than this copy\n",
                      verified.stdout)
        made = daemon.command("backup", daemon.folder / "older.db")
        self.assertIn("covers 3 measurements, and the database has only 2", made.stdout)
        (daemon.data / "fitgauge.checkpoint").unlink()
        made = daemon.command("backup", daemon.folder / "unsigned.db")
        self.assertIn("unsigned.db: it has no checkpoint", made.stdout)

    def test_a_first_start_that_is_lost_gives_no_id_twice(self):
        daemon = self.made().start()
        lost = self.store(daemon, "d1 d2 d3")
        wait_for_size(daemon, 3)
        daemon.kill()
        for suffix in ("-wal", "-shm"):
            pathlib.Path(f"{daemon.database}{suffix}").unlink()
        daemon.start()
        daemon.wait_for_log('"event":"log_branched"')
        self.assertEqual(daemon.stored(), [])
        self.assert_unique(lost, self.store(daemon, "n1 n2 n3"))
        for gone in lost:
            self.assertEqual(daemon.get(f"/v1/measurements/{gone}").status, 404)
        wait_for_size(daemon, 3)
        self.assertEqual(daemon.stop(), 0)
        self.assert_clean(daemon)
        daemon.start()
        self.assertEqual(daemon.log.count('"event":"log_branched"'), 1)

    def test_the_database_of_a_sibling_begins_a_branch(self):
        first, second = self.made().start(), self.made()
        self.store(first, "d1 d2")
        wait_for_size(first, 2)
        self.assertEqual(first.stop(), 0)
        shutil.copytree(first.data, second.data)
        for daemon, names in ((first, "d3 d4 d5"), (second, "e3 e4 e5 e6")):
            daemon.start()
            self.store(daemon, names)
            self.assertEqual(daemon.stop(), 0)
        shutil.copy(second.database, first.database)
        first.start()
        first.wait_for_log("has signed other measurements under this name")
        stored = [record["id"] for record in first.stored()]
        new = self.store(first, "n7 n8")
        self.assertFalse({record.split("-")[1] for record in stored} & {record.split("-")[1] for record in new})
        self.assertEqual(first.stop(), 0)
        self.assert_clean(first)
        first.start()
        self.assertEqual(first.log.count('"event":"log_branched"'), 1)

    def test_a_subscriber_that_deduplicates_by_id_loses_nothing(self):
        broker, daemon = Broker(), self.made().start()
        self.addCleanup(broker.cleanup)
        seen = broker.start().subscribe("shop/#")
        connected = daemon.request("PUT", "/v1/connections/dash", {
            "kind": "mqtt", "broker": f"mqtt://127.0.0.1:{broker.port}", "topic": "shop/{machine}", "longest_wait_s": 1})
        self.assertEqual(connected.status, 201, connected)

        def parts_by_id():
            records = [json.loads(message.payload) for message in list(seen.messages)]
            return {record["id"]: record["part_id"] for record in reversed(records)}  # the first of an id counts

        kept = self.store(daemon, "d1 d2 d3")
        wait_for(lambda: len(parts_by_id()) == 3, lambda: seen.messages)
        copy = self.backup(daemon)
        lost = self.store(daemon, "d4 d5")
        wait_for(lambda: len(parts_by_id()) == 5, lambda: seen.messages)
        self.assertEqual(daemon.stop(), 0)
        self.restore(daemon, copy)
        daemon.start()
        new = self.store(daemon, "n4 n5 n6")
        ids = dict(zip(kept + lost + new, "d1 d2 d3 d4 d5 n4 n5 n6".split()))
        wait_for(lambda: len(parts_by_id()) >= len(ids), lambda: seen.messages)
        self.assertEqual(parts_by_id(), ids)

    def test_a_checkpoint_of_nothing_says_so(self):
        daemon = self.made().start()
        empty = daemon.folder / "empty"
        empty.write_text(wait_for_size(daemon, 0))
        self.store(daemon, "d1")
        verified = daemon.command("verify", "--checkpoint", empty)
        self.assertEqual(verified.returncode, 0)
        self.assertIn("covers 0 of them", verified.stdout)
        one = daemon.folder / "one"
        one.write_text(wait_for_size(daemon, 1))
        self.store(daemon, "d2")
        wait_for_size(daemon, 2)
        self.assertIn(f"{one} covers 1 of 2 measurements\n", daemon.command("verify", "--checkpoint", one).stdout)

    def test_a_copy_of_the_files_beside_the_kept_checkpoint(self):
        daemon = self.made().start()
        kept = self.store(daemon, "d1 d2")
        copy = self.plain_copy(daemon)
        lost = self.store(daemon, "d3")
        wait_for_size(daemon, 3)
        daemon.stop()
        self.restore(daemon, copy)
        daemon.start()
        self.assert_unique(kept, lost, self.store(daemon, "n3"))
        # A copy from before the branch, below a checkpoint of it.
        wait_for_size(daemon, 3)
        daemon.stop()
        shutil.rmtree(daemon.data / "damaged")
        self.restore(daemon, copy)
        daemon.start()
        third = self.store(daemon, "n4")
        self.assert_unique(kept, lost, third)
        self.assertEqual([record["id"] for record in daemon.stored()], kept + third)
        self.assert_clean(daemon)

    def test_what_is_stored_just_before_the_end_is_known_to_the_folder(self):
        daemon = self.made().start()
        kept = self.store(daemon, "d1")
        copy = self.plain_copy(daemon)
        lost = self.store(daemon, "d2 d3")
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual((daemon.data / "fitgauge.checkpoint").read_text().split("\n")[1], "3")
        self.restore(daemon, copy)
        daemon.start()
        self.assert_unique(kept, lost, self.store(daemon, "n2 n3"))

    def plan(self, daemon, name):
        answer = daemon.request("PUT", f"/v1/plans/{name}",
                                {"characteristics": [{"name": "bore", "designation": "25 H7"}]})
        self.assertEqual(answer.status, 201, answer)

    def changes_head(self, daemon):
        return daemon.get("/v1/log/changes/checkpoint").text

    def test_a_copy_that_lacks_changes_alone_begins_a_branch(self):
        daemon = self.made().start()
        kept = self.store(daemon, "d1")
        self.plan(daemon, "A")
        heads = [self.changes_head(daemon)]
        copy = self.plain_copy(daemon)
        self.plan(daemon, "B")
        self.assertEqual(daemon.stop(), 0)
        known = daemon.data / "fitgauge.changes.checkpoint"
        heads.append(known.read_text())
        self.assertEqual([head.split("\n")[1] for head in heads], ["1", "2"])
        self.restore(daemon, copy)
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 1)
        self.assertIn("fitgauge.changes.checkpoint has signed 2 changes, but only 1 are stored", verified.stdout)
        daemon.start()
        daemon.wait_for_log("this folder has signed 2 changes, and the database has 1")
        self.plan(daemon, "C")
        heads.append(self.changes_head(daemon))
        self.assertEqual(len({head.split("\n")[0] for head in heads}), 2, "one name has one tree")
        self.assertEqual([record["id"] for record in daemon.stored()], kept)
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual(known.read_text(), heads[2])
        for head, status in zip(heads, (0, 1, 0), strict=True):
            (daemon.folder / "head").write_text(head)
            verified = daemon.command("verify", "--checkpoint", daemon.folder / "head")
            self.assertEqual(verified.returncode, status, verified.stdout)
        self.assertIn("/changes: 2 changes, root ", verified.stdout)

    def test_a_correction_of_what_the_copy_holds(self):
        daemon = self.made().start()
        kept = self.store(daemon, "d1 d2")
        copy = self.backup(daemon)
        self.store(daemon, "d3")
        daemon.stop()
        self.restore(daemon, copy)
        daemon.start()
        corrected = daemon.post(f"/v1/measurements/{kept[0]}/corrections", {"measured_mm": 25.011, "reason": "misread"})
        self.assertEqual(corrected.status, 201, corrected)
        self.assertEqual(corrected.json["correction_of"], kept[0])
        self.assertEqual(daemon.get(f"/v1/measurements/{kept[0]}").json["corrected_by"], corrected.json["id"])
        self.assert_clean(daemon)


if __name__ == "__main__":
    unittest.main()
