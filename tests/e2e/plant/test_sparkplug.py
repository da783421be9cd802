"""Sparkplug B: the edge node's messages, read by the protocol compiler, and the statements of the specification."""

import base64
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import threading
import time
import unittest

from support.broker import Broker, kill_in_step
from support.daemon import ROOT, Daemon
from support.waiting import PATIENCE, wait_for

HERE = pathlib.Path(__file__).parent
SCHEMA = ROOT / "server" / "plant" / "sparkplug"
INT64, DOUBLE, BOOLEAN, STRING, DATETIME = 4, 10, 11, 12, 13
REBIRTH = "Node Control/Rebirth"
NODE = "spBv1.0/shop/{}/gauge-4"


def protoc(mode, data):
    return subprocess.run(["protoc", f"-I{SCHEMA}", f"--{mode}=fitgauge.sparkplug_wire.Payload", "sparkplug_wire.proto"],
                          input=data, capture_output=True, check=True, timeout=PATIENCE).stdout


def payload_of(data):
    """{"timestamp", "seq", "metrics": [{…}]} as the protocol compiler prints it."""
    payload = {"metrics": []}
    into = payload
    for line in protoc("decode", data).decode().splitlines():
        if line == "metrics {":
            into = {}
            payload["metrics"].append(into)
        elif line == "}":
            into = payload
        else:
            name, value = line.strip().split(": ", 1)
            into[name] = json.loads(value) if value[0] != '"' else value[1:-1]
    return payload


def value_of(metric):
    assert ("is_null" in metric) + sum(name.endswith("_value") for name in metric) == 1, metric
    return next((value for name, value in metric.items() if name.endswith("_value")), None)


class Told:
    """A message of the node, decoded."""

    def __init__(self, message):
        self.topic = message.topic
        self.space, self.group, self.type, self.node, *self.device = message.topic.split("/")
        self.payload = payload_of(message.payload)
        self.metrics = self.payload["metrics"]

    def values(self, names=None):
        """By name; in data by what the births said."""
        return {metric.get("name") or names[metric["alias"]]: value_of(metric) for metric in self.metrics}

    def __repr__(self):
        return f"{self.topic} {self.payload}"


class Sparkplug(unittest.TestCase):
    def setUp(self):
        self.broker = Broker("allow_anonymous true", "queue_qos0_messages true")
        self.addCleanup(self.broker.cleanup)
        self.broker.start()
        self.seen = self.broker.subscribe("spBv1.0/shop/#")
        self.broker.save()
        self.daemon = Daemon()
        self.addCleanup(self.daemon.cleanup)
        self.daemon.start()

    def connect(self, status=201, **more):
        answer = self.daemon.request("PUT", "/v1/connections/scada", {
            "kind": "sparkplug", "broker": f"mqtt://127.0.0.1:{self.broker.port}", "group": "shop", "node": "gauge-4",
            "longest_wait_s": 1, **more})
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def state(self):
        return self.daemon.get("/v1/connections/scada").json

    def measure(self, number, machine="M3", **more):
        return self.daemon.measure({"designation": "25 H7", "measured_mm": 25.013, "part_id": f"P{number}", "machine": machine,
                                    "characteristic": "bore", **more}).json["id"]

    def told(self, *types):
        messages = [Told(m) for m in list(self.seen.messages) if "/NCMD/" not in m.topic]
        return [m for m in messages if not types or m.type in types]

    def wait_told(self, kind, count=1):
        wait_for(lambda: sum(f"/{kind}/" in m.topic for m in list(self.seen.messages)) >= count,
                 lambda: (self.state(), self.seen.messages))

    def command(self, *metrics):
        text = f"timestamp: {int(time.time() * 1000)} " + " ".join(f"metrics {{ {metric} }}" for metric in metrics)
        self.broker.publish(NODE.format("NCMD"), protoc("encode", text.encode()), qos=0)

    def ids(self):
        names = {metric["alias"]: metric["name"] for m in self.told("DBIRTH") for metric in m.metrics}
        return [m.values(names)["id"] for m in self.told("DDATA")]

    def check_stream(self):
        """What must hold of all messages of a node, in their order. @returns them."""
        told = self.told()
        names, born, seq, session = {}, set(), None, None
        for m in told:
            self.assertEqual((m.space, m.group, m.node), ("spBv1.0", "shop", "gauge-4"))
            self.assertEqual(len(m.device), 1 if m.type[0] == "D" else 0)
            self.assertLess(abs(m.payload["timestamp"] / 1000 - time.time()), 600)
            self.assertTrue(all("timestamp" in metric for metric in m.metrics))
            if m.type == "NDEATH":
                self.assertNotIn("seq", m.payload)
                self.assertEqual([(metric["name"], metric["datatype"]) for metric in m.metrics], [("bdSeq", INT64)])
                self.assertEqual(value_of(m.metrics[0]), session)
                born, seq = set(), None
                continue
            if m.type == "NBIRTH":
                seq = -1
                born = {""}
                names = {}
                session = m.values()["bdSeq"]
                self.assertIs(m.values()[REBIRTH], False)
                self.assertEqual([("alias" in metric, metric["datatype"]) for metric in m.metrics],
                                 [(False, INT64), (False, BOOLEAN), (True, INT64)])
            seq = (seq + 1) % 256
            self.assertEqual(m.payload["seq"], seq)
            device = "".join(m.device)
            if m.type in ("NBIRTH", "DBIRTH"):
                self.assertIn("", born)
                born.add(device)
                for metric in m.metrics:
                    self.assertIn("name", metric)
                    self.assertIn(metric["datatype"], (INT64, DOUBLE, BOOLEAN, STRING, DATETIME))
                    if "alias" in metric:
                        self.assertIn(names.setdefault(metric["alias"], (device, metric["name"])), [(device, metric["name"])])
            elif m.type == "DDEATH":
                born.remove(device)
                self.assertEqual(m.metrics, [])
            else:
                self.assertIn(device, born)
                for metric in m.metrics:
                    self.assertTrue({"name", "datatype"}.isdisjoint(metric))
                    self.assertEqual(names[metric["alias"]][0], device)
        return told

    def received(self):
        """(QoS, retained, topic) of each PUBLISH of the node, as the broker logged it."""
        return re.findall(r"Received PUBLISH from fitgauge-\w+-scada \(d0, q(\d), r(\d), m\d+, '([^']*)'", self.broker.log)


class Node(Sparkplug):
    def test_births_data_and_death(self):
        made = self.connect()
        self.assertEqual((made["kind"], made["direction"], made["group"]), ("sparkplug", "out", "shop"))
        first = self.measure(1, order="WO-17", measured_at="2026-11-20T08:00:00.5Z")
        self.wait_told("NDATA")
        told = self.check_stream()
        self.assertEqual([m.type for m in told], ["NBIRTH", "DBIRTH", "DDATA", "NDATA"])
        nbirth, dbirth, ddata, ndata = told
        self.assertEqual(nbirth.values(), {"bdSeq": 0, REBIRTH: False, "position": None})
        self.assertEqual(dbirth.topic, NODE.format("DBIRTH") + "/M3:bore")
        self.assertEqual(set(dbirth.values().values()), {None})  # nothing was told of it yet
        names = {metric["alias"]: metric["name"] for m in told[:2] for metric in m.metrics if "alias" in metric}
        types = {metric["name"]: metric["datatype"] for metric in dbirth.metrics}
        self.assertEqual({types[name] for name in ("measured_mm", "deviation_um", "upper_limit_mm")}, {DOUBLE})
        self.assertEqual((types["measured_at"], types["verdict"]), (DATETIME, STRING))
        self.assertEqual(len({name.lower() for name in types}), len(types))
        record = self.daemon.get(f"/v1/measurements/{first}").json
        values = ddata.values(names)
        for name in values.keys() - {"measured_at"}:
            self.assertEqual(values[name], record.get(name), name)
        self.assertEqual(values["measured_at"], 1795161600500)  # `date -d 2026-11-20T08:00:00Z +%s`, and half a second
        self.assertEqual({metric["timestamp"] for metric in ddata.metrics}, {1795161600500})
        self.assertEqual(ndata.values(names), {"position": 1})
        self.assertEqual({(q, r) for q, r, _ in self.received()}, {("0", "0")})
        log = self.broker.log
        self.assertRegex(log, r"as fitgauge-\w+-scada \(p2, c1, k30")
        self.assertRegex(log, r"Will message specified \(\d+ bytes\) \(r0, q1\)\.\n.*spBv1.0/shop/NDEATH/gauge-4")
        self.assertRegex(log, r"Received SUBSCRIBE from fitgauge-\w+-scada\n.*spBv1.0/shop/NCMD/gauge-4 \(QoS 1\)")
        self.assertLess(log.index("NCMD/gauge-4 (QoS 1)"), log.index("NBIRTH"))
        self.assertNotIn("DCMD", log)
        self.assertEqual(self.daemon.stop(), 0)
        self.wait_told("NDEATH")
        self.check_stream()
        self.assertEqual(self.received()[-1], ("1", "0", NODE.format("NDEATH")))  # it says so itself, and then leaves
        wait_for(lambda: "Received DISCONNECT" in self.broker.log.split("'spBv1.0/shop/NDEATH/gauge-4'")[-1])

    def test_sessions_are_numbered_over_kills(self):
        self.connect()
        for number in range(3):
            self.wait_told("NBIRTH", number + 1)
            self.daemon.kill()
            self.wait_told("NDEATH", number + 1)  # the broker says it
            self.daemon.start()
        self.wait_told("NBIRTH", 4)
        self.check_stream()
        self.assertEqual([m.values()["bdSeq"] for m in self.told("NBIRTH")], [0, 1, 2, 3])
        self.assertEqual([m.values()["bdSeq"] for m in self.told("NDEATH")], [0, 1, 2])
        self.assertNotIn(("1", "0", NODE.format("NDEATH")), self.received())

    def test_numbers_go_round_and_devices_are_their_own(self):
        ids = [self.measure(number, f"M{number % 3}", characteristic="a/b" if number % 2 else "c") for number in range(300)]
        self.connect(start="beginning")
        self.wait_told("DDATA", 300)
        wait_for(lambda: self.state()["position"] == 300)
        told = self.check_stream()
        self.assertEqual(self.ids(), ids)
        self.assertGreater(len(told), 256)
        self.assertEqual({m.device[0] for m in told if m.type == "DBIRTH"},
                         {f"M{n}:{c}" for n in range(3) for c in ("a%2Fb", "c")})
        self.assertEqual(sum(m.type == "DBIRTH" for m in told), 6)

    def test_a_host_asks_for_births(self):
        self.connect()
        last = [self.measure(number, f"M{number % 2}") for number in range(4)][2:]
        self.wait_told("DDATA", 4)
        wait_for(lambda: self.state()["position"] == 4)
        for metrics in (['name: "Node Control/Rebirth" boolean_value: false'], ['name: "Other" boolean_value: true'], []):
            self.command(*metrics)  # no request
        self.broker.publish(NODE.format("NCMD"), b"\xff\xff no payload", qos=0)
        self.command('name: "Node Control/Rebirth" boolean_value: true')
        self.wait_told("DBIRTH", 4)
        self.measure(5)
        self.wait_told("DDATA", 5)
        told = self.check_stream()
        at = [n for n, m in enumerate(told) if m.type == "NBIRTH"]
        self.assertEqual(len(at), 2)
        self.assertEqual([m.type for m in told[at[1]:at[1] + 3]], ["NBIRTH", "DBIRTH", "DBIRTH"])
        self.assertEqual([m.values()["id"] for m in told[at[1] + 1:at[1] + 3]], last)  # as they were told last
        self.assertEqual([told[n].values()["bdSeq"] for n in at], [0, 0])
        self.assertEqual(told[at[1]].values()["position"], 4)

    def test_too_many_devices(self):
        self.connect(most_devices=2)
        for number, machine in enumerate(("A", "B", "A", "C", "B")):
            self.measure(number, machine)
            self.wait_told("DDATA", number + 1)
        told = self.check_stream()
        self.assertEqual([(m.type, m.device[0]) for m in told if m.type in ("DBIRTH", "DDEATH")], [
            ("DBIRTH", "A:bore"), ("DBIRTH", "B:bore"), ("DDEATH", "B:bore"), ("DBIRTH", "C:bore"), ("DDEATH", "A:bore"),
            ("DBIRTH", "B:bore")])
        self.assertEqual({(q, r) for q, r, _ in self.received()}, {("0", "0")})

    def test_bad_settings_are_named(self):
        problem = self.daemon.request("PUT", "/v1/connections/x", {
            "kind": "sparkplug", "broker": "mqtt://h", "group": "a/b", "node": "+", "device": "{machine}/{part_id}",
            "primary_host": "", "most_devices": 0, "version": "5"})
        self.assertEqual((problem.status, sorted(e["pointer"] for e in problem.json["errors"])), (422, [
            "/device", "/group", "/most_devices", "/node", "/primary_host", "/version"]))
        problem = self.daemon.request("PUT", "/v1/connections/x", {
            "kind": "sparkplug", "broker": "mqtt://h", "group": "STATE", "node": "n"})
        self.assertEqual([e["pointer"] for e in problem.json["errors"]], ["/group"])


class Host(Sparkplug):
    def say(self, online, timestamp, host="scada-1"):
        self.broker.publish(f"spBv1.0/STATE/{host}", json.dumps({"online": online, "timestamp": timestamp}).encode(), retain=True)

    def wait_for_refusals(self, said):
        """Once it has `said` messages of the broker, three more looks find no host: the last two began after them."""
        wait_for(lambda: len(re.findall(r"Received PUBACK from fitgauge-\w+-scada", self.broker.log)) >= said, self.state)
        before = self.state()["failures"]
        wait_for(lambda: self.state()["failures"] >= before + 3, self.state)

    def test_nothing_goes_out_without_the_primary_host(self):
        self.say(True, 1, host="scada-2")
        self.say(False, 10)
        self.connect(primary_host="scada-1")
        self.assertIn("primary host scada-1 is not online", self.daemon.connection_in("scada", "failing")["last_error"])
        ids = [self.measure(1)]
        self.say(True, 9)  # older than the last
        for payload in (b"ONLINE", b"{}", b'{"online":"true","timestamp":11}', b'{"online":true}', b'{"online":true,"timestamp":"x"}'):
            self.broker.publish("spBv1.0/STATE/scada-1", payload)
        self.wait_for_refusals(7)
        self.assertEqual(self.told(), [])
        self.say(True, 11)
        self.wait_told("DDATA")
        self.say(False, 10)  # older: the session goes on
        ids.append(self.measure(2))
        self.wait_told("DDATA", 2)
        self.assertEqual(self.told("NDEATH"), [])
        self.say(False, 11)
        self.wait_told("NDEATH")
        self.assertEqual(self.received()[-1], ("1", "0", NODE.format("NDEATH")))
        wait_for(lambda: "Received DISCONNECT from fitgauge-" in self.broker.log.split("'spBv1.0/shop/NDEATH/gauge-4'")[-1])
        ids.append(self.measure(3))
        self.wait_for_refusals(11)
        self.assertEqual(len(self.told("DDATA")), 2)
        self.say(True, 12)
        self.wait_told("DDATA", 3)  # what the host missed is not lost
        self.check_stream()
        self.assertEqual(self.ids(), ids)


    def test_what_is_published_where_the_host_speaks_takes_little_memory(self):
        self.daemon.stop()
        self.daemon.environment |= {"ASAN_OPTIONS": "quarantine_size_mb=1"}  # else it keeps what is freed
        self.daemon.start()
        self.connect(primary_host="scada-1")
        wait_for(lambda: self.state()["state"] == "failing")  # it looks at what has come once a second
        before = self.daemon.memory("VmHWM")
        payload = self.daemon.folder / "payload"
        for size in (19, 23):  # 128 MiB each
            payload.write_bytes(bytes(1 << size))
            subprocess.run(["mosquitto_pub", "-p", str(self.broker.port), "-t", "spBv1.0/STATE/scada-1", "-q", "1", "-f", payload,
                            "--repeat", str((1 << 27) >> size)], check=True, timeout=PATIENCE)
        self.say(True, 1)
        self.measure(1)
        self.wait_told("DDATA")
        self.assertLess(self.daemon.memory("VmHWM") - before, 48 << 20)


class Lost(Sparkplug):
    def test_a_broker_that_is_killed_and_stopped_under_load_misses_nothing(self):
        self.connect()
        ids, over = [], threading.Event()

        def load():
            while not over.is_set():
                ids.append(self.measure(len(ids)))

        count = lambda: sum("/DDATA/" in m.topic for m in list(self.seen.messages))  # noqa: E731
        writer = threading.Thread(target=load)
        writer.start()
        kill = lambda: kill_in_step(self.broker, self.daemon, self.seen, NODE.format("NCMD") + "/in-step")  # noqa: E731
        for end in (kill, self.broker.stop, kill):
            told = count()
            wait_for(lambda: count() > told + 30, self.state)
            failures = self.state()["failures"]
            end()
            wait_for(lambda: self.state()["failures"] > failures, self.state)
            self.broker.start()
        told = count()
        wait_for(lambda: count() > told + 30, self.state)
        over.set()
        writer.join()
        wait_for(lambda: self.state()["position"] == len(ids), self.state)
        wait_for(lambda: len(set(self.ids())) == len(ids), lambda: (len(set(self.ids())), len(ids)))
        self.assertEqual(list(dict.fromkeys(self.ids())), ids)


@unittest.skipUnless(os.environ.get("TESTS_DEEP") and shutil.which("npm"), "TESTS_DEEP=1 and npm run it")
class Reader(Sparkplug):
    """The package sparkplug-payload of the Eclipse Foundation reads what is sent."""

    def test_it_reads_what_is_sent(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-sparkplug-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        shutil.copytree(HERE / "sparkplug", folder, dirs_exist_ok=True)
        subprocess.run(["npm", "install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts",
                        "--loglevel=error"], cwd=folder, check=True, timeout=240)
        self.connect()
        record = self.daemon.get(f"/v1/measurements/{self.measure(1)}").json
        self.wait_told("NDATA")
        self.command('name: "Node Control/Rebirth" boolean_value: true')
        self.wait_told("DBIRTH", 2)
        self.assertEqual(self.daemon.stop(), 0)
        self.wait_told("NDEATH")
        lines = "\n".join(base64.b64encode(m.payload).decode() for m in self.seen.messages if "/NCMD/" not in m.topic)
        done = subprocess.run(["node", "decode.mjs"], cwd=folder, input=lines, capture_output=True, text=True, check=True, timeout=120)
        nbirth, dbirth, ddata, ndata, _, again, ndeath = map(json.loads, done.stdout.splitlines())
        values = lambda payload: {metric["name"]: metric["value"] for metric in payload["metrics"]}  # noqa: E731
        types = lambda payload: {metric["name"]: metric["type"] for metric in payload["metrics"]}  # noqa: E731
        self.assertEqual((types(nbirth), values(nbirth)), ({"bdSeq": "Int64", REBIRTH: "Boolean", "position": "Int64"},
                                                           {"bdSeq": 0, REBIRTH: False, "position": None}))
        self.assertEqual([payload.get("seq") for payload in (nbirth, dbirth, ddata, ndata)], [0, 1, 2, 3])
        self.assertEqual(values(ndeath), {"bdSeq": 0})
        self.assertEqual([metric["alias"] for metric in ddata["metrics"]], [metric["alias"] for metric in dbirth["metrics"]])
        self.assertEqual({types(dbirth)[name] for name in ("id", "verdict", "part_id")}, {"String"})
        self.assertEqual((types(dbirth)["measured_mm"], types(dbirth)["measured_at"]), ("Double", "DateTime"))
        told = values(again)  # in data, which has no types, it leaves the values out
        for name in told.keys() - {"measured_at"}:
            self.assertEqual(told[name], record.get(name), name)


class Statements(unittest.TestCase):
    def test_each_is_tested_or_says_why_not(self):
        with open(HERE / "sparkplug_statements.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len({row["statement"] for row in rows}), len(rows))
        source = pathlib.Path(__file__).read_text()
        for row in rows:
            self.assertNotEqual(bool(row["test"]), bool(row["why not"]), row)
            if row["test"]:
                self.assertIn(f"def {row['test']}(", source, row)


if __name__ == "__main__":
    unittest.main()
