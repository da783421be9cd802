"""Server-Sent Events: what happens is told once, in order, and again to a reader that comes back."""

import json
import socket
import threading
import time

from support.contract import Contract
from support.daemon import SANITIZED, Daemon, DaemonTest
from support.waiting import wait_for

PART = {"designation": "25 H7", "measured_mm": 25.013, "part_id": "SN-1"}


class Reader:
    """One reader of /v1/events."""

    def __init__(self, daemon, query="", last=None):
        self.connection = daemon.connect()
        self.connection.request("GET", f"/v1/events{query}",
                                headers={"Last-Event-ID": last} if last else {})
        self.response = self.connection.getresponse()
        self.last = None

    def lines(self):
        """The lines of the next block."""
        lines = []
        while True:
            line = self.response.readline().decode()
            if not line:
                raise EOFError
            line = line.rstrip("\n")
            if not line:
                return lines
            lines.append(line)

    def event(self):
        """The next event, as (type, data); comments and bare ids are passed over."""
        while True:
            fields = dict(line.split(": ", 1) for line in self.lines() if not line.startswith(":"))
            self.last = fields.get("id", self.last)
            if "data" in fields:
                return fields["event"], json.loads(fields["data"])

    def events(self, count):
        return [self.event() for _ in range(count)]

    def begin(self):
        """Reads the first block, the position of a reader that has not come back."""
        block, = self.lines()
        self.last = block.removeprefix("id: ")
        return self

    def close(self):
        self.connection.close()


class Events(DaemonTest):
    def reader(self, *arguments, **named):
        reader = Reader(self.daemon, *arguments, **named)
        self.addCleanup(reader.close)
        return reader

    def test_a_measurement_is_told_when_it_is_stored(self):
        reader = self.reader().begin()
        self.assertEqual(reader.response.getheader("Content-Type"), "text/event-stream")
        record = self.daemon.measure(PART).json
        self.assertEqual(reader.event(), ("measurement.recorded", record))

    def test_a_reject_is_told_too(self):
        reader = self.reader().begin()
        records = [self.daemon.measure({**PART, "measured_mm": value}).json
                   for value in (25.03, 24.99, 25.01)]
        self.assertEqual(reader.events(4), [
            ("measurement.recorded", records[0]), ("verdict.reject", records[0]),
            ("measurement.recorded", records[1]), ("measurement.recorded", records[2])])

    def test_a_reader_may_stop_between_the_two_events_of_a_reject(self):
        reader = self.reader().begin()
        record = self.daemon.measure({**PART, "measured_mm": 25.03}).json
        self.assertEqual(reader.event()[0], "measurement.recorded")
        for again in (self.reader(last=reader.last), self.reader(f"?last_event_id={reader.last}")):
            self.assertEqual(again.event(), ("verdict.reject", record))

    def test_a_correction_is_an_event(self):
        record = self.daemon.measure(PART).json
        reader = self.reader().begin()
        self.daemon.post(f"/v1/measurements/{record['id']}/corrections",
                         {"measured_mm": 25.02, "reason": "x"})
        self.assertEqual(reader.event()[1]["correction_of"], record["id"])

    def test_a_changed_table_is_an_event_and_already_in_force(self):
        reader = self.reader().begin()
        column = "/v1/tables/shaft/classes/press2"
        rows = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": 3}]}
        for method, body in (("PUT", rows), ("DELETE", None)):
            self.daemon.request(method, column, body)
            kind, change = reader.event()
            self.assertEqual((kind, change["feature"], change["tolerance_class"]), ("table.changed", "shaft", "press2"))
            self.assertEqual(self.daemon.request("GET", "/readyz").json["table_revision"], change["table_revision"])
        self.assertEqual(self.daemon.request("DELETE", column).status, 404)
        record = self.daemon.measure(PART).json
        self.assertEqual(reader.event(), ("measurement.recorded", record))  # what was refused is none

    def test_each_event_fits_the_choice_of_its_type(self):
        contract = Contract(self.daemon.get("/openapi.json").json)
        choices = contract.resolve({"$ref": "#/components/schemas/Event"})["oneOf"]
        reader = self.reader("?source=all", last="nonsense")
        record = self.daemon.measure({**PART, "measured_mm": 25.03}).json
        self.daemon.post(f"/v1/measurements/{record['id']}/notes", {"cause": "Insert worn"})
        column = {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": 3}]}
        self.daemon.request("PUT", "/v1/tables/shaft/classes/press3", column)
        self.daemon.request("PUT", "/v1/files/e.h", b"BEGIN PGM E MM\nEND PGM E MM\n")
        self.assertEqual(self.daemon.post("/v1/runs", {"program": "e.h"}).status, 201)
        types = []
        for kind, data in reader.events(6):
            types.append(kind)
            contract.validate(data, {"$ref": "#/components/schemas/Event"})
            contract.validate(data, next(choice for choice in choices if kind in choice["title"].split(", ")))
        self.assertEqual(set(types), set(", ".join(choice["title"] for choice in choices).split(", ")))

    def test_a_reader_that_comes_back_misses_nothing_and_reads_nothing_twice(self):
        reader = self.reader().begin()
        rows = [{**PART, "part_id": f"SN-{i}", "measured_mm": 25.03 if i % 3 == 0 else 25.01}
                for i in range(30)]
        self.daemon.measure(rows)
        expected = []
        for row in rows:
            expected.append(("measurement.recorded", row["part_id"]))
            if row["measured_mm"] == 25.03:
                expected.append(("verdict.reject", row["part_id"]))
        seen = []
        while len(seen) < len(expected):  # a new connection for every event
            kind, record = reader.event()
            seen.append((kind, record["part_id"]))
            reader.close()
            reader = self.reader(last=reader.last)
        self.assertEqual(seen, expected)
        self.daemon.measure({**PART, "part_id": "SN-last"})
        self.assertEqual(reader.event()[1]["part_id"], "SN-last")

    def test_the_id_may_be_in_the_query(self):
        reader = self.reader().begin()
        record = self.daemon.measure(PART).json
        again = self.reader(f"?last_event_id={reader.last.replace('+', '%2B')}")
        self.assertEqual(again.event(), ("measurement.recorded", record))

    def test_ids_of_all_events_differ(self):
        reader = self.reader().begin()
        self.daemon.measure([{**PART, "measured_mm": 25.1}] * 20)
        ids = []
        for _ in range(40):
            reader.event()
            ids.append(reader.last)
        self.assertEqual(len(set(ids)), 40)

    def test_an_id_that_is_none_gets_resync_and_what_follows(self):
        for last in ("nonsense", "m1", "m999999999.e0", "m1.e999999", "m-1.e0", "m1.e0x"):
            with self.subTest(last):
                reader = self.reader(last=last)
                self.assertEqual(reader.event()[0], "resync")
                record = self.daemon.measure(PART).json
                self.assertEqual(reader.event(), ("measurement.recorded", record))

    def test_many_readers_under_load_all_read_everything(self):
        readers = [self.reader().begin() for _ in range(20)]
        posted = []
        def post(worker):
            connection = self.daemon.connect()
            for i in range(25):
                posted.append(self.daemon.measure({**PART, "part_id": f"W{worker}-{i}"},
                                                  connection=connection).json["id"])
            connection.close()
        threads = [threading.Thread(target=post, args=(w,)) for w in range(4)]
        for thread in threads:
            thread.start()
        seen = [[record["id"] for _, record in reader.events(100)] for reader in readers]
        for thread in threads:
            thread.join()
        for ids in seen:
            self.assertEqual(ids, sorted(posted, key=lambda name: int(name[1:].partition("-")[0])))

    def test_head_and_other_methods(self):
        self.assertEqual(self.daemon.request("HEAD", "/v1/events").status, 200)
        self.assertEqual(self.daemon.post("/v1/events", {}).status, 405)


class Retention(DaemonTest):
    flags = ("--event-retention", "100")

    def test_too_far_behind_is_resync(self):
        reader = Reader(self.daemon).begin()
        reader.close()
        self.daemon.measure([PART] * 100)
        back = Reader(self.daemon, last=reader.last)
        self.assertEqual([kind for kind, _ in back.events(100)], ["measurement.recorded"] * 100)
        back.close()
        self.daemon.measure(PART)
        gone = Reader(self.daemon, last=reader.last)
        self.assertEqual(gone.event()[0], "resync")
        self.daemon.measure({**PART, "part_id": "after"})
        self.assertEqual(gone.event()[1]["part_id"], "after")
        gone.close()


class AfterARestart(DaemonTest):
    def test_events_are_told_across_a_kill(self):
        reader = Reader(self.daemon).begin()
        record = self.daemon.measure(PART).json
        reader.close()
        self.daemon.kill()
        self.daemon.start()
        back = Reader(self.daemon, last=reader.last)
        self.assertEqual(back.event(), ("measurement.recorded", record))
        back.close()

    def test_a_stop_is_not_held_up_by_readers(self):
        def took(count):
            daemon = Daemon()
            self.addCleanup(daemon.cleanup)
            daemon.start()
            readers = [Reader(daemon).begin() for _ in range(count)]
            began = time.monotonic()
            self.assertEqual(daemon.stop(), 0, daemon.log)
            taken = time.monotonic() - began
            for reader in readers:
                reader.close()
            daemon.cleanup()
            return taken

        # The service waits for 7 s for an answer that is under way, always; a busy machine takes as long by chance.
        alone = took(0)
        wait_for(lambda: took(10) < alone + 5, "a stop as soon as without readers")


class SlowReaders(DaemonTest):
    def test_a_reader_that_takes_nothing_slows_no_writer_and_costs_no_memory(self):
        sockets = []
        for _ in range(20):
            slow = socket.create_connection(("127.0.0.1", self.daemon.port))
            slow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            slow.sendall(b"GET /v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")
            self.addCleanup(slow.close)
            sockets.append(slow)
        rows = [{**PART, "comment": "x" * 1000} for _ in range(5000)]
        for _ in range(3):
            self.assertEqual(self.daemon.measure(rows).status, 201)
        record = self.daemon.measure(PART)
        self.assertEqual(record.status, 201)
        # 20 readers that are 24 MB behind hold a page each.
        self.assertLess(self.daemon.memory("VmRSS"), (800 if SANITIZED else 400) << 20)
        # One that goes on reading gets everything, or is told that it was dropped.
        fast = Reader(self.daemon, last="m0.e0")
        self.assertEqual(fast.events(15_001)[-1], ("measurement.recorded", record.json))
        fast.close()
