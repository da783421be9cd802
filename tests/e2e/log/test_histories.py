"""A copy put back begins a branch: no id is given out twice, what the copy holds stays valid, and receivers that
deduplicate by id lose nothing."""

import base64
import pathlib
import re
import shutil
import unittest

from durability.test_storage import PART
from log.test_forwarding import metric, note, notes_of
from log.test_log import wait_for_size
from measurements.test_events import Reader
from support.daemon import Daemon
from support.ports import lasting_address
from support.postgres import Cluster
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

    def test_a_checkpoint_of_nothing_says_so(self):
        daemon = self.made().start()
        empty = daemon.folder / "empty"
        empty.write_text(wait_for_size(daemon, 0))
        self.store(daemon, "d1")
        verified = daemon.command("verify", "--checkpoint", empty)
        self.assertEqual(verified.returncode, 0)
        self.assertIn("covers 0 of them", verified.stdout)

    def test_a_copy_of_the_files_beside_the_kept_checkpoint(self):
        daemon = self.made().start()
        kept = self.store(daemon, "d1 d2")
        daemon.stop()
        copy = daemon.folder / "copy.db"
        shutil.copy(daemon.database, copy)
        daemon.start()
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
        daemon.stop()
        copy = daemon.folder / "copy.db"
        shutil.copy(daemon.database, copy)
        daemon.start()
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
        self.assertEqual(daemon.stop(), 0)
        copy = daemon.folder / "copy.db"
        shutil.copy(daemon.database, copy)
        daemon.start()
        self.plan(daemon, "B")
        self.assertEqual(daemon.stop(), 0)
        known = daemon.data / "fitgauge.changes.checkpoint"
        heads.append(known.read_text())
        self.assertEqual([head.split("\n")[1] for head in heads], ["1", "2"])
        self.restore(daemon, copy)
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 1)
        self.assertIn("fitgauge.changes.checkpoint has signed 2 changes, 1 are there", verified.stdout)
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


class Stations(Restored):
    def setUp(self):
        self.centre = self.made("--origin-name", "centre", listen=lasting_address()).start()
        self.station = self.made("--origin-name", "press", "--forward-to", f"http://{self.centre.listen}").start()

    def there(self):
        return {record["id"]: record["part_id"] for record in self.centre.stored()}

    def drained(self):
        wait_for(lambda: metric(self.station, "fitgauge_outbox_rows") == 0, lambda: self.station.log)

    def copied(self, kind):
        """@returns what puts the folder back as it is now."""
        if kind == "backup":
            copy = self.backup(self.station)
        else:
            self.station.stop()
            copy = self.station.folder / "copy"
            shutil.copytree(self.station.data, copy)
            self.station.start()

        def put_back():
            shutil.rmtree(self.station.data)
            if kind == "backup":
                self.station.data.mkdir()
                shutil.copy(copy, self.station.database)
            else:
                shutil.copytree(copy, self.station.data)
        return put_back

    def put_back(self, kind, centre_is_there):
        kept = self.store(self.station, "s1 s2 s3")
        record = {"id": kept[0]}
        said = [note(self.station, record, "kept")]
        put_back = self.copied(kind)
        lost = self.store(self.station, "s4 s5")
        said += [note(self.station, record, "lost"), note(self.station, record, "lost too")]
        self.drained()
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.station.stop()
        if not centre_is_there:
            self.centre.stop()
        put_back()
        self.station.start()
        said.append(note(self.station, record, "new"))
        new = self.store(self.station, "x1 x2 x3")
        if not centre_is_there:
            self.centre.start()
        new += self.store(self.station, "x4")
        self.assert_unique(kept, lost, new)
        self.drained()
        names = dict(zip(kept + lost + new, "s1 s2 s3 s4 s5 x1 x2 x3 x4".split()))
        self.assertEqual(self.there(), names)
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.assertEqual(notes_of(self.station, record), [said[0], said[3]])
        self.assertEqual(self.station.get("/readyz").status, 200)
        self.centre.wait_for_log('"event":"log_branched"')
        self.assertNotIn('"event":"log_forked"', self.centre.log)
        self.assert_clean(self.centre)
        self.assert_clean(self.station)
        for record in kept + lost + new:
            self.assertEqual(self.centre.get(f"/v1/measurements/{record}/proof").status, 200)
        # The centre corrects on either side of the branch, and the station hears of it.
        for record in (kept[1], lost[1], new[1]):
            made = self.centre.post(f"/v1/measurements/{record}/corrections", {"measured_mm": 25.02, "reason": "x"})
            self.assertEqual(made.status, 201, made)
        for record in (kept[1], new[1]):
            wait_for(lambda one=record: "corrected_by" in self.station.get(f"/v1/measurements/{one}").json,
                     lambda: self.station.log)
        self.assert_clean(self.station)

    def test_a_backup_with_the_centre(self):
        self.put_back("backup", True)

    def test_a_backup_without_the_centre(self):
        self.put_back("backup", False)

    def test_a_copy_of_the_folder_with_the_centre(self):
        self.put_back("copy", True)

    def test_a_copy_of_the_folder_without_the_centre(self):
        self.put_back("copy", False)

    def test_a_correction_of_what_lies_below_the_branch_reaches_the_centre(self):
        kept = self.store(self.station, "s1 s2")
        copy = self.backup(self.station)
        self.store(self.station, "s3")
        self.drained()
        self.station.stop()
        self.restore(self.station, copy)
        self.station.start()
        correction = {"measured_mm": 25.02, "reason": "x"}
        made = self.station.post(f"/v1/measurements/{kept[0]}/corrections", correction)
        self.assertEqual(made.status, 201, made)
        again = self.station.post(f"/v1/measurements/{made.json['id']}/corrections", correction)
        self.assertEqual(again.status, 201, again)
        self.drained()
        for (of, by) in ((kept[0], made), (made.json["id"], again)):
            self.assertEqual(self.centre.get(f"/v1/measurements/{of}").json["corrected_by"], by.json["id"])
        self.assert_clean(self.station)
        self.assert_clean(self.centre)

    def test_what_the_centre_lacks_of_the_history_below_goes_first(self):
        self.store(self.station, "s1")
        self.drained()
        self.centre.stop()
        self.store(self.station, "s2 s3")
        copy = self.backup(self.station)
        self.store(self.station, "s4")
        self.station.stop()
        self.restore(self.station, copy)
        self.station.start()
        self.store(self.station, "x1")
        self.centre.start()
        self.drained()
        self.assertEqual(sorted(self.there().values()), ["s1", "s2", "s3", "x1"])
        self.assert_clean(self.centre)

    def test_a_centre_that_was_put_back_gives_out_new_ids_and_is_filled_up(self):
        first = self.store(self.station, "s1")
        own = self.store(self.centre, "c1")
        copy = self.backup(self.centre)
        second = self.store(self.station, "s2")
        said = note(self.station, {"id": first[0]}, "worn")
        lost = self.store(self.centre, "c2")
        self.drained()
        self.centre.stop()
        self.restore(self.centre, copy)
        self.centre.start()
        new = self.store(self.centre, "c3")
        self.assert_unique(first, own, second, lost, new)
        wait_for(lambda: "s2" in self.there().values(), lambda: self.station.log)
        wait_for(lambda: notes_of(self.centre, {"id": first[0]}) == [said], lambda: self.station.log)
        self.assert_clean(self.centre)
        made = self.centre.post(f"/v1/measurements/{first[0]}/corrections", {"measured_mm": 25.02, "reason": "x"})
        wait_for(lambda: "corrected_by" in self.station.get(f"/v1/measurements/{first[0]}").json,
                 lambda: self.station.log)
        self.assertEqual(self.station.get(f"/v1/measurements/{first[0]}").json["corrected_by"], made.json["id"])

    def restored_centre(self):
        """The centre stores what the station has stored meanwhile, and its copy from before is put back."""
        copy = self.backup(self.centre)
        lost = self.store(self.station, "s4 s5")
        self.drained()
        self.centre.stop()
        self.restore(self.centre, copy)
        return lost

    def test_a_copy_of_the_folder_beside_a_centre_that_was_put_back(self):
        kept = self.store(self.station, "s1 s2 s3")
        self.drained()
        put_back = self.copied("copy")
        lost = self.restored_centre()
        self.station.stop()
        put_back()
        self.centre.start()
        self.station.start()
        new = self.store(self.station, "x1 x2")
        self.assert_unique(kept, lost, new)
        self.station.wait_for_log("and may have lost measurements")
        self.drained()
        self.assertEqual(self.there(), dict(zip(kept + new, "s1 s2 s3 x1 x2".split())))
        self.assert_clean(self.centre)
        self.assert_clean(self.station)

    def test_a_station_that_was_there_when_its_centre_was_put_back_goes_on(self):
        kept = self.store(self.station, "s1 s2 s3")
        self.drained()
        lost = self.restored_centre()
        self.centre.start()
        wait_for(lambda: len(self.there()) == 5, lambda: self.station.log)
        self.station.stop()
        self.station.start()
        new = self.store(self.station, "s6")
        self.assertEqual({one.split("-")[1] for one in kept + lost + new}, {kept[0].split("-")[1]})
        self.assertNotIn('"event":"log_branched"', self.station.log)

    def put_the_centre_back(self, station_sends_first):
        record = {"id": self.store(self.station, "s1 s2")[0]}
        self.drained()
        self.centre.stop()
        copy = self.centre.folder / "copy"
        shutil.copytree(self.centre.data, copy)
        self.centre.start()
        said = [note(self.station, record, "x1"), note(self.station, record, "x2")]
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.centre.stop()
        self.station.stop()
        self.station.start()  # a branch, of which the notes are none
        self.station.wait_for_log('"event":"log_branched"')
        names = {one["id"]: one["part_id"] for one in self.station.stored()}
        names[self.store(self.station, "s3")[0]] = "s3"
        self.centre.start()
        # It sends its notes between two questions of what the centre has.
        asked = re.escape('fitgauge_http_requests_total{route="/v1/log/revisions",method="GET",status="200"}')
        wait_for(lambda: (metric(self.centre, asked) or 0) >= 2, lambda: self.station.log)
        self.assertEqual(self.there(), names)
        self.centre.stop()
        shutil.rmtree(self.centre.data)
        shutil.copytree(copy, self.centre.data)
        if station_sends_first:
            names[self.store(self.station, "s4")[0]] = "s4"
        self.centre.start()
        wait_for(lambda: self.there() == names, lambda: self.station.log)
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.assert_clean(self.centre)

    def test_notes_of_a_branch_for_a_centre_that_lacks_what_lies_below(self):
        empty = self.backup(self.centre)
        below = {"id": self.store(self.station, "s1 s2")[0]}
        copy = self.backup(self.station)
        self.station.stop()
        self.restore(self.station, copy)
        self.station.start()
        said = note(self.station, below, "below")
        above = {"id": self.store(self.station, "s3")[0]}
        later = note(self.station, above, "above")
        for _ in range(2):
            wait_for(lambda: len(self.there()) == 3, lambda: self.station.log)
            wait_for(lambda: notes_of(self.centre, above) == [later], lambda: self.station.log)
            wait_for(lambda: notes_of(self.centre, below) == [said], lambda: self.station.log)
            self.centre.stop()
            for left in self.centre.data.glob("damaged*"):
                shutil.rmtree(left)
            self.restore(self.centre, empty)
            self.centre.start()
        self.assert_clean(self.centre)

    def test_notes_from_before_a_branch_for_a_centre_that_was_put_back(self):
        self.put_the_centre_back(station_sends_first=False)

    def test_notes_from_before_a_branch_for_a_centre_whose_lack_a_batch_finds(self):
        self.put_the_centre_back(station_sends_first=True)

    def test_two_folders_that_go_on_under_one_history(self):
        self.store(self.station, "s1")
        self.drained()
        self.station.stop()
        twin = self.made("--origin-name", "press", "--forward-to", f"http://{self.centre.listen}")
        shutil.copytree(self.station.data, twin.data)
        self.station.start()
        twin.start()
        self.store(self.station, "first")
        self.drained()
        self.store(twin, "twin")
        wait_for(lambda: twin.get("/readyz").status == 503, lambda: twin.log)
        self.assertEqual(twin.get("/readyz").json["code"], "log.forked")
        for restarted in (False, True):
            if restarted:
                twin.stop()
                twin.start()
            for body in (PART, [PART] * 300):
                answer = twin.measure(body)
                self.assertEqual((answer.status, answer.json["code"]), (503, "log.forked"))
            for path in ("plans/P", "setups/S", "files/a.h", "uncertainties/U", "tables/hole/classes/H7"):
                answer = twin.request("PUT", f"/v1/{path}", {})
                self.assertEqual((answer.status, answer.json["code"]), (503, "log.forked"), path)
            self.assertEqual(twin.post("/v1/statistics/summary", {"values": [1, 2]}).status, 200, "nothing is stored")
            self.assertEqual(len(twin.stored()), 2, "what is there is read")
        self.store(self.station, "second")
        self.drained()
        self.assertEqual(sorted(self.there().values()), ["first", "s1", "second"])


class SharedDatabases(Restored):
    def test_daemons_on_a_database_that_was_put_back(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        cluster.query("CREATE DATABASE live")
        daemon, other = (self.made("--database", cluster.address("live")) for _ in range(2))
        daemon.start()
        kept = self.store(daemon, "d1 d2")
        wait_for_size(daemon, 2)
        daemon.stop()
        cluster.query("CREATE DATABASE copy TEMPLATE live")
        daemon.start()
        lost = self.store(daemon, "d3")
        wait_for_size(daemon, 3)
        daemon.stop()
        cluster.query("DROP DATABASE live")
        cluster.query("ALTER DATABASE copy RENAME TO live")
        daemon.start()
        other.start()
        new = self.store(daemon, "n3") + self.store(other, "n4")
        self.assert_unique(kept, lost, new)
        self.assertEqual(len({record.split("-")[1] for record in new}), 1, "one branch")
        for each in (daemon, other):
            self.assertEqual([record["id"] for record in each.stored()], kept + new)
            self.assertEqual(each.get(f"/v1/measurements?after={lost[0]}").json["code"], "cursor.invalid")
        self.assert_clean(daemon, "--database", cluster.address("live"))


if __name__ == "__main__":
    unittest.main()
