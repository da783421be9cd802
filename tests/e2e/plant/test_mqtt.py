"""MQTT: each measurement once at least and in order, whatever the broker, the network and the power do."""

import json
import pathlib
import subprocess
import tempfile
import threading
import unittest

from support.broker import Broker, Forgetful, kill_in_step
from support.certificates import certificate
from support.daemon import Daemon
from support.ports import free_port
from support.waiting import wait_for

TOPIC = "plant/{machine}/{characteristic}"


def part(number, **more):
    return {"designation": "25 H7", "measured_mm": "25.01", "part_id": f"P{number}", "machine": "M3", "characteristic": "bore",
            **more}


def distinct(items):
    return list(dict.fromkeys(items))


class Mqtt(unittest.TestCase):
    def broker(self, *lines, **named):
        broker = Broker(*lines, **named)
        self.addCleanup(broker.cleanup)
        return broker.start()

    def daemon(self, *flags):
        daemon = Daemon(*flags)
        self.addCleanup(daemon.cleanup)
        return daemon.start()

    def connect(self, daemon, port, status=201, name="dash", **more):
        body = {"kind": "mqtt", "broker": f"mqtt://127.0.0.1:{port}", "topic": TOPIC, "longest_wait_s": 1, **more}
        answer = daemon.request("PUT", f"/v1/connections/{name}", body)
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def state(self, daemon, name="dash"):
        return daemon.get(f"/v1/connections/{name}").json

    def store(self, daemon, numbers, **more):
        return [daemon.measure(part(number, **more)).json["id"] for number in numbers]

    def ids(self, subscriber):
        return [json.loads(m.payload)["id"] for m in subscriber.messages if m.topic.startswith("plant/")]


class Publishing(Mqtt):
    def test_runs_and_tables_go_to_a_topic_of_their_own(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe()
        self.connect(daemon, broker.port, events=["measurement.recorded", "run.finished", "table.changed", "compensation.changed"],
                     events_topic="plant-events/4")
        measured = self.store(daemon, [1])[0]
        daemon.request("PUT", "/v1/files/p.h", b"0 BEGIN PGM p MM\n1 Q1 = 1\n2 END PGM p MM\n")
        run = daemon.post("/v1/runs?wait=1", {"program": "p.h"}).json
        daemon.request("PUT", "/v1/tables/shaft/classes/press2", {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 15, "lower_um": 3}]})
        events = lambda: [m for m in seen.messages if m.topic.startswith("plant-events/")]
        wait_for(lambda: len(events()) == 3, lambda: self.state(daemon))
        self.assertEqual(self.ids(seen), [measured])
        kinds = ["compensation.changed", "run.finished", "table.changed"]
        told = sorted(events(), key=lambda m: m.topic)
        self.assertEqual([(m.topic, m.qos, m.retain) for m in told], [(f"plant-events/4/{kind}", 1, False) for kind in kinds])
        offset, finished, changed = (json.loads(m.payload) for m in told)
        self.assertEqual((offset["id"], offset["data"]["state"], offset["data"]["machine"]), ("c" + measured[1:], "wait", "M3"))
        self.assertEqual((finished["data"]["id"], changed["data"]["tolerance_class"]), (run["id"], "press2"))
        self.assertEqual(len({finished["id"], changed["id"]}), 2)

    def test_each_measurement_is_its_record_in_order_and_the_last_one_stays(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe()
        self.store(daemon, range(3))  # before the connection: not told
        made = self.connect(daemon, broker.port)
        self.assertEqual((made["direction"], made["position"], made["topic"]), ("out", 3, TOPIC))
        ids = self.store(daemon, range(3, 40))
        wait_for(lambda: len(self.ids(seen)) == 37, lambda: self.state(daemon))
        self.assertEqual(self.ids(seen), ids)
        told = [m for m in seen.messages if m.topic.startswith("plant/")]
        self.assertEqual({(m.topic, m.qos, m.retain) for m in told}, {("plant/M3/bore", 1, False)})
        self.assertEqual(json.loads(told[0].payload), daemon.get(f"/v1/measurements/{ids[0]}").json)
        wait_for(lambda: self.state(daemon)["position"] == 40)
        state = self.state(daemon)
        self.assertEqual((state["state"], state["behind"], state["measurements"], state["last_error"]), ("ok", 0, 37, None))
        late = broker.subscribe("plant/#")
        wait_for(lambda: late.messages)
        self.assertEqual([(json.loads(m.payload)["id"], m.retain) for m in late.messages], [(ids[-1], True)])
        self.connect(daemon, broker.port, 200, retain=False)
        newest = self.store(daemon, [40])
        wait_for(lambda: len(late.messages) == 2)
        after = broker.subscribe("plant/#")
        wait_for(lambda: after.messages)
        self.assertEqual([json.loads(m.payload)["id"] for m in late.messages + after.messages], [ids[-1], *newest, ids[-1]])

    def test_topics_keep_texts_apart(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe("plant/#")
        self.connect(daemon, broker.port, topic="plant/{machine}/{part_id}/{verdict}/{tolerance_class}")
        texts = ["a/b", "a+b", "a#", "100 %", "Bohrung Ø", "-", "$SYS", "\u0001", "%2F"]
        for text in texts:
            daemon.measure({"designation": "25 H7", "measured_mm": 26, "part_id": text})
        wait_for(lambda: len(seen.messages) == len(texts), lambda: (seen.messages, self.state(daemon)))
        levels = ["a%2Fb", "a%2Bb", "a%23", "100 %25", "Bohrung Ø", "%2D", "$SYS", "%01", "%252F"]
        self.assertEqual([m.topic for m in seen.messages], [f"plant/-/{level}/reject/H7" for level in levels])

    def test_status_and_last_will(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe("+/status")
        self.connect(daemon, broker.port)
        said = lambda: [m.payload for m in seen.messages]  # noqa: E731
        wait_for(lambda: said() == [b"online"])
        self.assertRegex(seen.messages[0].topic, r"^fitgauge-[0-9a-f]{8}-dash/status$")
        daemon.kill()
        wait_for(lambda: said() == [b"online", b"offline"])  # the broker says it
        daemon.start()
        wait_for(lambda: said()[2:] == [b"online"])
        self.assertEqual(daemon.stop(), 0)
        wait_for(lambda: said()[3:] == [b"offline"])  # the service says it
        self.assertEqual(len({m.topic for m in seen.messages}), 1)
        daemon.start()
        self.connect(daemon, broker.port, 200, status_topic="line/4/fitgauge", client_id="gauge-4")
        other = broker.subscribe("line/#")
        wait_for(lambda: [m.payload for m in other.messages] == [b"online"])
        self.assertIn("gauge-4", broker.log)

    def test_mqtt_5(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe("plant/#")
        self.connect(daemon, broker.port, version="5")
        ids = self.store(daemon, range(10))
        wait_for(lambda: len(seen.messages) == 10)
        self.assertEqual(self.ids(seen), ids)
        self.assertRegex(broker.log, r"as fitgauge-\w+-dash \(p5,")

    def test_what_the_broker_does_not_allow_is_an_error(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        acl = pathlib.Path(folder.name) / "acl"
        acl.write_text("topic readwrite fitgauge/#\n")
        broker, daemon = self.broker("allow_anonymous true", f"acl_file {acl}"), self.daemon()
        self.connect(daemon, broker.port, version="5", status_topic="fitgauge/s")
        self.store(daemon, [1])
        state = daemon.connection_in("dash", "failing")  # the first refusal is repeated at once and does not count
        self.assertIn("authori", state["last_error"])
        self.assertEqual(state["behind"], 1)


class Lost(Mqtt):
    def test_a_broker_that_is_killed_and_stopped_under_load_misses_nothing(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe("plant/#", options=("-t", "in-step"))
        broker.save()
        self.connect(daemon, broker.port)
        ids, over = [], threading.Event()

        def load():
            while not over.is_set():
                ids.extend(self.store(daemon, [len(ids)]))

        writer = threading.Thread(target=load)
        writer.start()
        kill = lambda: kill_in_step(broker, daemon, seen, "in-step")  # noqa: E731
        for end in (kill, broker.stop, kill):
            told = len(seen.messages)
            wait_for(lambda: len(seen.messages) > told + 50, lambda: self.state(daemon))
            end()
            daemon.connection_in("dash", "failing")
            broker.start()
        told = len(seen.messages)
        wait_for(lambda: len(seen.messages) > told + 50, lambda: self.state(daemon))
        over.set()
        writer.join()
        wait_for(lambda: len(set(self.ids(seen))) == len(ids), lambda: (len(set(self.ids(seen))), len(ids)))
        self.assertEqual(distinct(self.ids(seen)), ids)
        wait_for(lambda: self.state(daemon)["position"] == len(ids))
        self.assertEqual(self.state(daemon)["dead_letters"], [])

    def test_a_service_that_is_killed_misses_nothing(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe("plant/#")
        self.connect(daemon, broker.port)
        ids = []
        for first in range(0, 80, 20):
            ids += self.store(daemon, range(first, first + 20))
            if first == 20:
                wait_for(lambda: len(seen.messages) > 25)
            daemon.kill()
            daemon.start()
        wait_for(lambda: len(set(self.ids(seen))) == 80, lambda: self.state(daemon))
        self.assertEqual(distinct(self.ids(seen)), ids)

    def test_what_is_not_acknowledged_comes_again(self):
        port = free_port()
        forgetful, daemon = Forgetful(port, acknowledges=lambda number: number <= 3, most=7), self.daemon()
        ids = self.store(daemon, range(10))
        self.connect(daemon, port, status_topic="plant/status", start="beginning")
        wait_for(lambda: len(forgetful.taken) >= 20, lambda: self.state(daemon))
        said = [json.loads(payload)["id"] for topic, payload in forgetful.taken if topic == "plant/M3/bore"]
        # Three were acknowledged: the first is the status. Each new connection begins behind them.
        self.assertEqual(said[:6], ids[:6])
        self.assertEqual(said[6:12], ids[2:8])
        wait_for(lambda: self.state(daemon)["position"] == 2)
        forgetful.close()
        broker = self.broker(port=port)
        wait_for(lambda: self.state(daemon)["position"] == 10, lambda: self.state(daemon))
        last = broker.subscribe("plant/M3/bore")
        wait_for(lambda: last.messages)
        self.assertEqual(self.ids(last), ids[-1:])

    def test_writers_do_not_wait_for_it(self):
        port = free_port()
        silent, daemon = Forgetful(port), self.daemon()
        self.addCleanup(silent.close)
        self.store(daemon, range(50))
        self.connect(daemon, port, start="beginning")
        self.connect(daemon, free_port(), name="away")
        wait_for(lambda: silent.taken)
        self.store(daemon, range(50, 60))
        most = 1 + 32  # over each connection the status, and no more than it may be ahead
        wait_for(lambda: len(silent.taken) >= most, lambda: self.state(daemon))
        self.assertEqual(self.state(daemon)["position"], 0)
        self.assertIn("cannot be reached", daemon.connection_in("away", "failing")["last_error"])
        self.assertLessEqual(len(silent.taken), most * silent.connects)
        self.assertEqual(daemon.stop(), 0)  # nor does the end of the service

    def test_it_comes_back_without_a_measurement(self):
        broker, daemon = self.broker(), self.daemon()
        self.connect(daemon, broker.port)
        daemon.connection_in("dash", "ok")
        broker.kill()
        daemon.connection_in("dash", "failing")
        broker.start()
        daemon.connection_in("dash", "ok")
        wait_for(lambda: "connection_recovered" in daemon.log)


class Access(Mqtt):
    def test_user_and_password(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        words = pathlib.Path(folder.name) / "passwords"
        words.write_text("gauge:secret-word\n")
        subprocess.run(["mosquitto_passwd", "-U", words], check=True)
        broker, daemon = self.broker("allow_anonymous false", f"password_file {words}"), None
        daemon = self.daemon()
        refused = self.connect(daemon, broker.port, user="gauge", password="wrong")
        self.assertEqual((refused["user"], refused["password_set"]), ("gauge", True))
        self.assertRegex(daemon.connection_in("dash", "failing")["last_error"], "refuses: .*[Aa]uthori[sz]ed")
        self.connect(daemon, broker.port, 200, user="gauge", password="secret-word")
        daemon.connection_in("dash", "ok")
        self.connect(daemon, broker.port, 200, user="gauge", retain=False)  # without it: the one there is
        daemon.connection_in("dash", "ok")
        said = daemon.get("/v1/connections").text + daemon.log
        self.assertNotIn("secret-word", said)
        self.assertTrue(self.state(daemon)["password_set"])
        # It goes nowhere else.
        elsewhere = self.connect(daemon, free_port(), 200, user="gauge")
        self.assertNotIn("password_set", elsewhere)

    def test_tls(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        place = pathlib.Path(folder.name)
        pem, key = certificate(place, "shop", 1)
        other, _ = certificate(place, "other", 2)
        broker = self.broker("allow_anonymous true", listener=(f"certfile {pem}", f"keyfile {key}"))
        daemon = self.daemon("--connection-folders", place)
        for host, file, word in (("localhost", pem, "ok"), ("localhost", other, "failing"), ("127.0.0.1", pem, "failing"),
                                 ("localhost", None, "failing")):
            name = f"c-{host.replace('.', '-')}-{file.stem if file else 'system'}"
            self.connect(daemon, 1, name=name, broker=f"mqtts://{host}:{broker.port}", **({"ca_file": str(file)} if file else {}))
            state = daemon.connection_in(name, word)
            if word == "failing":
                self.assertIn("TLS", state["last_error"])
                self.assertFalse(daemon.post(f"/v1/connections/{name}/test", None).json["ok"])
        problem = daemon.request("PUT", "/v1/connections/x", {
            "kind": "mqtt", "broker": "mqtts://localhost", "topic": "a", "ca_file": "/etc/ssl/certs/ca-certificates.crt"})
        self.assertEqual([e["pointer"] for e in problem.json["errors"]], ["/ca_file"])

    def test_the_test_button_leaves_the_connection_alone(self):
        broker, daemon = self.broker(), self.daemon()
        seen = broker.subscribe()
        self.connect(daemon, broker.port)
        daemon.connection_in("dash", "ok")
        self.assertEqual(daemon.post("/v1/connections/dash/test", None).json,
                         {"ok": True, "detail": "the broker accepts the connection"})
        ids = self.store(daemon, [1])
        wait_for(lambda: self.ids(seen) == ids)
        self.assertEqual([m.payload for m in seen.messages if m.topic.endswith("status")], [b"online"])
        broker.kill()
        said = daemon.post("/v1/connections/dash/test", None).json
        self.assertFalse(said["ok"])
        self.assertIn("cannot be reached", said["detail"])

    def test_bad_settings_are_named(self):
        daemon = self.daemon()
        problem = daemon.request("PUT", "/v1/connections/x", {
            "kind": "mqtt", "broker": "tcp://h", "topic": "{colour}", "password": "p", "ca_file": "ca.pem", "client_id": "a b",
            "version": "4", "status_topic": "a/+", "retain": 1, "start": "soon", "colour": "red"})
        self.assertEqual((problem.status, sorted({e["pointer"] for e in problem.json["errors"]})), (422, [
            "/broker", "/ca_file", "/client_id", "/colour", "/retain", "/start", "/status_topic", "/topic", "/user", "/version"]))
        for broker in ("mqtt://", "mqtt://a:b@h", "mqtt://h:0", "mqtt://h:1/x", "mqtt://h:65536", "h:1883"):
            problem = daemon.request("PUT", "/v1/connections/x", {"kind": "mqtt", "broker": broker, "topic": "a"})
            self.assertEqual([e["pointer"] for e in problem.json["errors"]], ["/broker"], broker)
        for topic in ("", "plant/+", "a#", "$SYS/x", "{machine}/x", "a/{machine", "a}", "a/{comment}", "a\u0001", "x" * 501):
            problem = daemon.request("PUT", "/v1/connections/x", {"kind": "mqtt", "broker": "mqtt://h", "topic": topic})
            self.assertEqual([e["pointer"] for e in problem.json["errors"]], ["/topic"], topic)


if __name__ == "__main__":
    unittest.main()
