"""A station or its centre put back: what one has, the other gets, under ids that were never given out before."""

import re
import shutil
import unittest

from durability.test_storage import PART
from log.test_forwarding import metric, note, notes_of
from log.test_histories import Restored
from support.ports import lasting_address
from support.waiting import wait_for


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

    def test_a_copy_of_the_folder_that_lacks_only_a_note(self):
        record = {"id": self.store(self.station, "s1")[0]}
        self.drained()
        put_back = self.copied("copy")
        said = [note(self.station, record, "lost")]
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.station.stop()
        put_back()
        self.station.start()
        said.append(note(self.station, record, "new"))
        self.assertNotEqual(said[0]["id"], said[1]["id"])
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)

    def test_a_copy_of_the_folder_from_before_a_branch(self):
        """The centre lacks what came after the copy, and has a branch."""
        kept = self.store(self.station, "s1")
        put_back, backup = self.copied("copy"), self.backup(self.station)
        self.drained()
        self.centre.stop()
        lost = self.store(self.station, "s2")
        self.station.stop()
        self.restore(self.station, backup)
        self.centre.start()
        self.station.start()
        branch = self.store(self.station, "b2")
        self.drained()
        self.station.stop()
        put_back()
        self.station.start()
        self.assert_unique(kept, lost, branch, self.store(self.station, "x2"))
        self.station.wait_for_log("the centre has a branch of this log")

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

    def test_a_centre_put_back_while_its_station_branched_gets_what_lies_below_the_branch(self):
        self.store(self.station, "s1")
        self.drained()
        before = self.backup(self.centre)
        self.store(self.station, "s2 s3")
        self.drained()
        copy = self.backup(self.station)
        self.station.stop()
        self.centre.stop()
        self.restore(self.station, copy)
        self.restore(self.centre, before)
        self.station.start()  # branches: its centre is away
        self.station.wait_for_log('"event":"log_branched"')
        self.centre.start()
        wait_for(lambda: sorted(self.there().values()) == ["s1", "s2", "s3"], lambda: self.station.log)
        self.assert_clean(self.centre)
        self.assert_clean(self.station)

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

    def test_notes_that_a_centre_lost_come_before_the_next(self):
        record = {"id": self.store(self.station, "s1")[0]}
        said = [note(self.station, record, "kept")]
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        copy = self.backup(self.centre)
        said += [note(self.station, record, "lost"), note(self.station, record, "lost too")]
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.centre.stop()
        self.restore(self.centre, copy)
        said.append(note(self.station, record, "next"))
        self.centre.start()
        wait_for(lambda: said[-1] in notes_of(self.centre, record), lambda: self.station.log)
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        self.assert_clean(self.centre)

    def test_notes_of_a_branch_without_records(self):
        record = {"id": self.store(self.station, "s1")[0]}
        self.drained()
        said = []
        for text in ("of the first branch", "of the second", "of the third"):
            self.centre.stop()
            copy = self.backup(self.station, f"{text}.db")
            self.station.stop()
            for left in self.station.data.glob("damaged*"):
                shutil.rmtree(left)
            self.restore(self.station, copy)
            self.station.start()
            said.append(note(self.station, record, text))
            if text == "of the second":
                self.centre.start()
                wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
                self.centre.stop()
        new = self.store(self.station, "s2")
        self.centre.start()
        wait_for(lambda: notes_of(self.centre, record) == said, lambda: self.station.log)
        wait_for(lambda: new[0] in self.there(), lambda: self.station.log)
        self.assert_clean(self.centre)

    def test_two_folders_that_go_on_under_one_history(self):
        self.store(self.station, "s1")
        self.drained()
        self.station.stop()
        watched = self.station.folder / "watched"
        watched.mkdir()
        twin = self.made("--origin-name", "press", "--forward-to", f"http://{self.centre.listen}",
                         "--connection-folders", watched)
        shutil.copytree(self.station.data, twin.data)
        self.station.start()
        twin.start()
        connected = twin.request("PUT", "/v1/connections/cmm", {
            "kind": "folder_in", "folder": str(watched), "interval_s": 1, "rest_s": 1})
        self.assertEqual(connected.status, 201, connected)
        self.store(self.station, "first")
        self.drained()
        self.store(twin, "twin")
        wait_for(lambda: twin.get("/readyz").status == 503, lambda: twin.log)
        self.assertEqual(twin.get("/readyz").json["code"], "log.forked")
        (watched / "cmm.csv").write_text("designation,measured_mm\n25 H7,25.01\n")
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
            self.assertIn("ids would repeat", twin.connection_in("cmm", "failing")["last_error"])
            self.assertEqual([file.name for file in watched.iterdir()], ["cmm.csv"], "it is no wrong file")
        self.store(self.station, "second")
        self.drained()
        self.assertEqual(sorted(self.there().values()), ["first", "s1", "second"])


if __name__ == "__main__":
    unittest.main()
