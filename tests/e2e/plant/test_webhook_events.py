"""Webhooks: which events they send."""

import unittest

from support.webhooks import SECRETS, Receivers, signature


class WebhookEvents(Receivers):
    def happen(self, daemon, number):
        """A measurement, a run, a note and a changed table. Returns what is told of them, in order."""
        measured = self.store(daemon, [number])[0]
        program = f"0 BEGIN PGM p{number} MM\n1 Q1 = {number}\n2 END PGM p{number} MM\n"
        self.assertIn(daemon.request("PUT", f"/v1/files/p{number}.h", program.encode()).status, (200, 201))
        run = daemon.post("/v1/runs?wait=1", {"program": f"p{number}.h"}).json
        self.assertEqual(daemon.post(f"/v1/measurements/{measured}/notes", {"text": f"note {number}"}).status, 201)
        column = f"press{number}"
        rows = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": 3}]}
        self.assertEqual(daemon.request("PUT", f"/v1/tables/shaft/classes/{column}", rows).status, 201)
        return [("measurement.recorded", measured), ("run.finished", run["id"]), ("note.added", f"note {number}"), ("table.changed", column)]

    def told(self, receiver, requests=None):
        names = {"measurement.recorded": "id", "run.finished": "id", "note.added": "text", "table.changed": "tolerance_class"}
        events = [request["event"] for request in (receiver.events if requests is None else requests)]
        return [(event["type"], event["data"][names[event["type"]]]) for event in events]

    def test_runs_notes_and_tables_are_told_where_they_are_asked_for(self):
        names = ["measurement.recorded", "run.finished", "table.changed", "note.added"]
        receiver, plain, runs, daemon = self.receiver(), self.receiver(), self.receiver(), self.daemon()
        self.happen(daemon, 0)
        self.connect(daemon, receiver, events=names, filter={"verdict": ["good"]})
        self.connect(daemon, plain, name="plain")
        self.connect(daemon, runs, name="runs", events=["run.finished"])
        happened = [each for number in range(1, 4) for each in self.happen(daemon, number)]
        receiver.wait(lambda: len(receiver.events) >= 12)
        runs.wait(lambda: len(runs.events) >= 3)
        plain.wait(lambda: len(plain.events) >= 3)
        # Each kind in its order; an event comes behind the measurements before it.
        self.assertEqual(sorted(self.told(receiver)), sorted(happened))
        for kinds in (names[:1], names[1:]):
            self.assertEqual([each for each in self.told(receiver) if each[0] in kinds], [each for each in happened if each[0] in kinds])
        for at, each in enumerate(happened):
            before = [other for other in happened[:at] if other[0] == "measurement.recorded"]
            self.assertLessEqual(set(before), set(self.told(receiver)[:self.told(receiver).index(each)]))
        self.assertEqual(self.told(plain), [each for each in happened if each[0] == "measurement.recorded"])
        self.assertEqual(self.told(runs), [each for each in happened if each[0] == "run.finished"])
        for request in receiver.events:
            headers = request["headers"]
            self.assertEqual(headers["webhook-signature"], signature(SECRETS[0], headers, request["body"]))
        self.assertEqual(len(set(receiver.ids())), 12)
        receiver.wait(lambda: self.state(daemon)["measurements"] == 3)
        bad = daemon.request("PUT", "/v1/connections/bad", {"kind": "webhook", "url": receiver.url, "secrets": SECRETS, "events": ["run.began"]})
        self.assertEqual((bad.status, bad.json["errors"][0]["pointer"]), (422, "/events"))

    def make(self, daemon, level_um, count, characteristic="bore", machine="M1", **more):
        """Parts about a level from the middle of 25 H7. Returns the id of the last."""
        scatter = (0.9, -1.1, 0.4, -0.2, 1.2, -0.7, -0.9, 0.3, 0.6, -0.5)
        rows = [{"designation": "25 H7", "measured_mm": f"{25.0105 + (level_um + scatter[i % 10]) / 1000:.4f}", "part_id": f"P{i}",
                 "characteristic": characteristic, "machine": machine, "tool": "T1", **more} for i in range(count)]
        stored = daemon.measure(rows, {"Prefer": "return=representation"})
        self.assertEqual(stored.status, 201, stored)
        return stored.json["measurements"][-1]["id"]

    def test_offsets_are_told_for_each_machine_when_their_state_is_another(self):
        receiver, other, daemon = self.receiver(), self.receiver(), self.daemon()
        self.make(daemon, 0, 20)  # before the connection: their offset comes with the next value
        offsets = ["compensation.changed", "compensation.failed"]
        self.connect(daemon, receiver, events=offsets, filter={"verdict": ["reject"]})
        self.connect(daemon, other, name="other", events=["measurement.recorded", offsets[0]], filter={"machine": "M2"})

        def next_told(state, newest, machine="M1"):
            receiver.wait(lambda: len(receiver.events) == len(told) + 1)
            request = receiver.events[-1]
            event = request["event"]
            told.append((event["type"], request["headers"]["webhook-id"]))
            self.assertEqual(told[-1], (offsets[state == "limits.mixed"], "c" + newest[1:]))
            self.assertEqual([event["data"][name] for name in ("characteristic", "machine")], ["bore", machine])
            self.assertEqual(event["data"].get("state", event["data"].get("code")), state)
            self.assertEqual(request["headers"]["webhook-signature"], signature(SECRETS[0], request["headers"], request["body"]))
            return event["data"]

        told = []
        next_told("wait", self.make(daemon, 0, 1))
        moved = next_told("propose", self.make(daemon, 8, 6))
        self.assertEqual(moved, daemon.get("/v1/measurements/compensation?characteristic=bore&machine=M1").json)
        next_told("wait", self.make(daemon, 0, 1, machine="M2"), "M2")
        for name in ("mes", "other"):
            self.wait_for_kept_position(daemon, 28, name)
        daemon.kill()
        daemon.start()
        # What was told is not kept: the state comes again with the next value, and is that of M1 alone.
        next_told("propose", self.make(daemon, 8, 1))
        other_size = self.make(daemon, 0, 1, designation="25 H8")
        next_told("limits.mixed", other_size)
        # Set aside, it is no value of the proposal.
        note = daemon.post(f"/v1/measurements/{other_size}/notes", {"cause": "another part", "measure": "set aside"})
        self.assertEqual(note.status, 201)
        next_told("propose", self.make(daemon, 8, 1))
        other.wait(lambda: len(other.events) == 2)
        self.assertEqual([request["event"]["type"] for request in other.events], ["measurement.recorded", "compensation.changed"])
        self.assertEqual(self.state(daemon)["behind"], 0)

    def test_an_offset_that_nobody_takes_comes_again_and_measurements_without_a_characteristic_have_none(self):
        answers = [503, 204]
        receiver, daemon = self.receiver(lambda event: answers.pop(0) if answers else 204), self.daemon()
        self.connect(daemon, receiver, events=["compensation.changed"])
        self.store(daemon, range(3))
        newest = self.make(daemon, 8, 10)
        receiver.wait(lambda: receiver.events)
        self.assertEqual([request["headers"]["webhook-id"] for request in receiver.attempts], ["c" + newest[1:]] * 2)
        self.assertEqual(receiver.attempts[0]["body"], receiver.attempts[1]["body"])

    def test_events_go_on_where_they_stood_after_a_kill_and_what_is_refused_is_a_dead_letter(self):
        refused = []

        def answer(event):
            if event["type"] == "table.changed" and event["data"]["tolerance_class"] == "press2":
                return 422
            if not refused:
                refused.append(event)
                return 500
            return 204

        receiver, daemon = self.receiver(answer), self.daemon()
        names = ["measurement.recorded", "run.finished", "table.changed", "note.added"]
        self.connect(daemon, receiver, events=names)
        happened = []
        for number in range(1, 6):
            happened += self.happen(daemon, number)
            if number % 2 == 0:
                daemon.kill()
                daemon.start()
        happened.remove(("table.changed", "press2"))
        receiver.wait(lambda: len(receiver.distinct()) >= len(happened))
        first = {request["headers"]["webhook-id"]: request for request in reversed(receiver.events)}
        told = self.told(receiver, [first[each] for each in receiver.distinct()])
        self.assertEqual(sorted(told), sorted(happened))
        self.assertEqual([each for each in told if each[0] != "measurement.recorded"],
                         [each for each in happened if each[0] != "measurement.recorded"])
        # A page's dead letters are kept when its last event is told.
        receiver.wait(lambda: self.state(daemon)["dead_letters"])
        letters = self.state(daemon)["dead_letters"]
        self.assertEqual([letter["reason"] for letter in letters], ["the receiver answers 422"])
        self.assertRegex(letters[0]["measurement"], "^e[0-9]+-[0-9a-f]{16}$")

    def test_the_filter_decides(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver, filter={"machine": "M3", "verdict": ["reject", "rework"]})
        self.store(daemon, [1], measured="25.03")
        self.store(daemon, [2], machine="M3")
        ids = self.store(daemon, [3], measured="25.03", machine="M3") + self.store(daemon, [4], measured="24.9", machine="M3")
        self.store(daemon, [5], machine="M3")
        receiver.wait(lambda: self.state(daemon)["position"] == 5)
        self.assertEqual(receiver.ids(), ids)
        late = self.receiver()
        self.connect(daemon, late, name="late", start="beginning", filter={"part_id": "P2"})
        late.wait(lambda: len(late.events) == 1)

    def test_a_correction_is_told_too(self):
        receiver, daemon = self.receiver(), self.daemon()
        self.connect(daemon, receiver)
        first = self.store(daemon, [1])[0]
        second = daemon.post(f"/v1/measurements/{first}/corrections", {"measured_mm": "25.02", "reason": "misread"}).json["id"]
        receiver.wait(lambda: len(receiver.events) == 2)
        self.assertEqual(receiver.ids(), [first, second])
        self.assertEqual(receiver.events[1]["event"]["data"]["correction_of"], first)


if __name__ == "__main__":
    unittest.main()
