"""The collector: measuring logs of controls, each result stored once, whatever ends in between."""

import os
import pathlib
import random
import re
import tempfile
import shutil
import unittest

from support.daemon import Daemon, command
from support.lsv2 import Client, control_port, text
from support.ports import lasting_address
from support.waiting import wait_for

DEEP = bool(os.environ.get("TESTS_DEEP"))
# Typed by hand after the example of HEIDENHAIN's manuals.
LOG = """Measuring log for touch probe cycle 421 Hole measuring
Date: {date}
Time: {time}
Measuring program: TNC:\\PART\\CHECK1.H
Type of dimension (0 = MM / 1 = INCH): 0
------------------------------------------------
Nominal values:
Center in reference axis: 50.0000
Center in minor axis: -65.0000
Diameter: 12.0000
------------------------------------------------
Given limit values:
Maximum limit for center in reference axis: 50.1000
Minimum limit for center in reference axis: 49.9000
Maximum limit for center in minor axis: -64.9000
Minimum limit for center in minor axis: -65.1000
Maximum dimension for hole: 12.0450
Minimum dimension for hole: 12.0000
------------------------------------------------
Actual values:
Center in reference axis: 50.0810
Center in minor axis: -64.9530
Diameter: {diameter}
------------------------------------------------
Deviations:
Diameter: 0.0259
------------------------------------------------
Measuring log end
"""
PATTERN = """characteristic = bore-A
tolerance_class = H7
nominal_mm = 25
---
PART {part_id}
DIAMETER {measured_mm}
"""


def log(number, diameter="12.0259"):
    """The log of a second of its own."""
    return LOG.format(date="30-06-2025", diameter=diameter,
                      time=f"{number // 3600 % 24}:{number // 60 % 60:02}:{number % 60:02}")


def all_measurements(daemon, **filters):
    query = "".join(f"&{name}={value}" for name, value in filters.items())
    after, found = "", []
    while True:
        page = daemon.get(f"/v1/measurements?limit=1000{query}{after}").json
        found += page["measurements"]
        if not page.get("next"):
            return found
        after = f"&after={page['next']}"


class Shop:
    """Controls, and a collector that reads them."""

    def __init__(self, controls):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-shop-"))
        self.controls = [Daemon("--control-listen", lasting_address(), "--control-write") for _ in range(controls)]
        self.starts = [0] * controls
        self.ports = [0] * controls
        for index in range(controls):
            self.start_control(index)
        self.collector = Daemon("--connections", self.folder / "connections.toml", environment={"TZ": "UTC"})

    def start_control(self, index):
        self.controls[index].start()
        self.starts[index] += 1
        self.ports[index] = control_port(self.controls[index], self.starts[index])

    def connect(self, paths, patterns=()):
        connections = "".join(
            f'[[connection]]\nname = "m{index}"\nkind = "lsv2"\naddress = "127.0.0.1:{port}"\n'
            f'machine = "MILL-{index}"\npaths = {[path for path in paths]!r}\n'
            f'patterns = {[name for name in patterns]!r}\ninterval_s = 1\n'
            for index, port in enumerate(self.ports))
        (self.folder / "connections.toml").write_text(connections)

    def states(self):
        return {state["name"]: state for state in self.collector.get("/v1/connections").json["connections"]}

    def cleanup(self):
        for daemon in (*self.controls, self.collector):
            daemon.cleanup()
        shutil.rmtree(self.folder, ignore_errors=True)


class Collecting(unittest.TestCase):
    def shop(self, controls, *paths, **named):
        shop = Shop(controls)
        self.addCleanup(shop.cleanup)
        shop.connect(paths, **named)
        return shop

    def put(self, control, path, content):
        data = content if isinstance(content, bytes) else content.encode()
        self.assertIn(control.request("PUT", f"/v1/files/{path}", data).status, (200, 201))

    def settle(self, shop, name="m0", count=3):
        """Until that many attempts more have ended."""
        since = shop.states()[name]["attempts"]
        return wait_for(lambda: (state := shop.states()[name])["attempts"] >= since + count and state)

    def test_a_log_that_grows_is_stored_log_by_log(self):
        shop = self.shop(1, "TNC:\\nc_prog\\TCHPR*.TXT")
        shop.collector.start()
        self.put(shop.controls[0], "nc_prog/TCHPR421.TXT", log(1))
        self.put(shop.controls[0], "nc_prog/other.txt", log(2))
        wait_for(lambda: len(all_measurements(shop.collector)) == 3)
        self.put(shop.controls[0], "nc_prog/TCHPR421.TXT", log(1) + log(2, "12.0500"))
        wait_for(lambda: len(all_measurements(shop.collector)) == 6)
        self.put(shop.controls[0], "nc_prog/TCHPR421.TXT", log(2, "12.0500") + log(2, "12.0500") + log(3)[:600])
        state = self.settle(shop)
        found = all_measurements(shop.collector)
        self.assertEqual([(row["characteristic"], row["measured_mm"], row["verdict"]) for row in found], [

            ("Centre, main axis", 50.081, "good"), ("Centre, secondary axis", -64.953, "good"), ("Diameter", 12.0259, "good"),
            ("Centre, main axis", 50.081, "good"), ("Centre, secondary axis", -64.953, "good"), ("Diameter", 12.05, "reject"),
            ("Centre, main axis", 50.081, "good"), ("Centre, secondary axis", -64.953, "good"), ("Diameter", 12.05, "reject")])
        self.assertEqual({(row["machine"], row["source"], row["cycle"], row["operation"]) for row in found},
                         {("MILL-0", "gauge", 421, "TNC:\\PART\\CHECK1.H")})
        self.assertEqual(found[2]["measured_at"], "2025-06-30T00:00:01Z")
        self.assertEqual(found[2]["upper_limit_mm"], 12.045)
        self.assertEqual((state["state"], state["measurements"], state["unreadable"], state["values_kept"]), ("ok", 9, 0, 0))
        # The files themselves lie whole on the collector's disk.
        kept = shop.collector.get("/v1/files/collected/m0/nc_prog/TCHPR421.TXT").body
        self.assertEqual(kept, shop.controls[0].get("/v1/files/nc_prog/TCHPR421.TXT").body)
        metrics = shop.collector.get("/metrics").text
        self.assertIn('fitgauge_connection_up{connection="m0"} 1', metrics)
        self.assertIn('fitgauge_connection_measurements_total{connection="m0"} 9', metrics)
        # A restart fetches again and stores nothing again.
        self.assertEqual(shop.collector.stop(), 0)
        shop.collector.start()
        state = wait_for(lambda: (now := shop.states()["m0"])["files"] and now)
        self.assertEqual((state["measurements"], len(all_measurements(shop.collector))), (0, 9))

    def test_a_diameter_without_limits_is_stored_beside_judged_centres(self):
        shop = self.shop(1, "TNC:\\nc_prog\\TCHPR*.TXT")
        shop.collector.start()
        free = re.sub("M..imum dimension for hole.*\n", "", log(1))
        self.put(shop.controls[0], "nc_prog/TCHPR421.TXT", free)
        *centres, diameter = wait_for(lambda: len(rows := all_measurements(shop.collector)) == 3 and rows)
        self.assertEqual([each["verdict"] for each in centres], ["good", "good"])
        self.assertEqual({name: diameter[name] for name in ("basis", "characteristic", "quantity", "size_operator", "nominal_mm", "measured_mm")},
                         {"basis": "none", "characteristic": "Diameter", "quantity": "diameter", "size_operator": "GG",
                          "nominal_mm": 12, "measured_mm": 12.0259})
        self.assertFalse({"upper_limit_mm", "lower_limit_mm", "rule", "verdict", "excess_um", "uncertainty_um"} & diameter.keys())
        self.assertEqual(self.settle(shop)["values_kept"], 0)

    def test_files_of_fn_16_are_read_by_a_pattern(self):
        shop = self.shop(1, "TNC:\\logs\\*.txt", patterns=["bore.pattern"])
        (shop.folder / "bore.pattern").write_text(PATTERN)
        shop.collector.start()
        self.put(shop.controls[0], "logs/a.txt", "PART SN-1\nDIAMETER 25.013\nPART SN-2\nDIAMETER  24.999\n")
        wait_for(lambda: len(all_measurements(shop.collector)) == 2)
        self.put(shop.controls[0], "logs/a.txt", "PART SN-1\nDIAMETER 25.013\nPART SN-2\nDIAMETER  24.999\nPART SN-3\nDIAMETER -1\n")
        state = self.settle(shop)
        found = all_measurements(shop.collector)
        self.assertEqual([(row["part_id"], row["designation"], row["verdict"]) for row in found],
                         [("SN-1", "25 H7", "good"), ("SN-2", "25 H7", "rework")])
        self.assertEqual(state["unreadable"], 1)
        shop.collector.wait_for_log("result 3: a measured size must be above 0")

    def test_limits_of_a_pattern_are_of_its_nominal_size(self):
        shop = self.shop(1, "TNC:\\logs\\*.txt", patterns=["um.pattern", "mm.pattern", "free.pattern"])
        for name, limits in (("um", "upper_um = 21\nlower_um = 0\nnominal_mm = 25\n"),
                             ("mm", "upper_mm = 25.021\nlower_mm = 25\nnominal_mm = 25\n"), ("free", "")):
            (shop.folder / f"{name}.pattern").write_text(f"{limits}---\n{name} {{measured_mm}} {{part_id}}\n")
        shop.collector.start()
        for name in ("um", "mm", "free"):
            self.put(shop.controls[0], f"logs/{name}.txt", f"{name} 99.9 {name}\n")
        found = wait_for(lambda: len(rows := all_measurements(shop.collector)) == 3 and rows)
        facts = {row["part_id"]: [row.get(name) for name in ("verdict", "nominal_mm", "upper_limit_mm", "deviation_um")]
                 for row in found}
        self.assertEqual(facts, {"um": ["reject", 25, 25.021, 74900], "mm": ["reject", 25, 25.021, 74900],
                                 "free": [None] * 4})

    def test_what_no_reader_understands_is_kept_and_said(self):
        shop = self.shop(1, "TNC:\\logs\\*")
        shop.collector.start()
        content = b"any\xff thing\n" * 40
        self.put(shop.controls[0], "logs/NOTE.A", content)
        wait_for(lambda: shop.states()["m0"]["unreadable"])
        self.assertEqual(shop.collector.get("/v1/files/collected/m0/logs/NOTE.A").body, content)
        self.settle(shop)
        self.assertEqual(shop.states()["m0"]["unreadable"], 1)
        shop.collector.wait_for_log('"event":"log_not_understood"')
        self.assertEqual(shop.collector.log.count('"event":"log_not_understood"'), 1)
        self.assertEqual(all_measurements(shop.collector), [])

    def test_logs_of_running_programs_are_collected(self):
        """Cycles 421 and 444 on the virtual control: sizes, coordinates, and a deviation below zero."""
        shop = self.shop(1, "TNC:\\nc_prog\\*.TXT", "TNC:\\nc_prog\\*.html")
        shop.collector.start()
        program = ("BEGIN PGM BORE MM\nTOOL CALL 30 Z\n"
                   "TCH PROBE 421 MEASURE HOLE ~\nQ273=+50 ~\nQ274=+50 ~\nQ262=+25 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\n"
                   "Q320=+2 ~\nQ260=+50 ~\nQ301=+0 ~\nQ275=+25.021 ~\nQ276=+25 ~\nQ279=+0.1 ~\nQ280=+0.1 ~\nQ281=+1 ~\n"
                   "Q309=+0 ~\nQ330=+0\n"
                   "TCH PROBE 444 PROBING IN 3-D ~\nQ263=+10 ~\nQ264=+10 ~\nQ294=+0.02 ~\nQ581=+0 ~\nQ582=+0 ~\nQ583=+1 ~\n"
                   "Q320=+0 ~\nQ260=+30 ~\nQS400=\"0.1-0.1\" ~\nQ309=+0\nEND PGM BORE MM\n")
        self.put(shop.controls[0], "nc_prog/bore.h", program)
        setup = {"workpiece": {"features": [
            {"type": "block", "min_mm": [0, 0, -30], "max_mm": [100, 100, 0]},
            {"type": "bore", "center_mm": [50, 50], "diameter_mm": 25.0131, "top_mm": 0, "depth_mm": 20}]}}
        self.assertEqual(shop.controls[0].request("PUT", "/v1/setups/cell", setup).status, 201)
        self.assertEqual(shop.controls[0].stop(), 0)
        shop.controls[0].flags += ["--control-setup", "cell"]
        shop.start_control(0)
        with Client(shop.ports[0]) as client:
            client.login("PLCDEBUG", "DNC").ask("C_MC", b"\0\0\0\1" + text("Fitgauge.program") + text("TNC:\\nc_prog\\bore.h"))
            wait_for(lambda: client.state() != 0)
            self.assertEqual(client.state(), 2, shop.controls[0].get("/v1/runs?limit=1").json)
        found = wait_for(lambda: len(rows := all_measurements(shop.collector)) == 4 and rows)
        self.assertEqual({(row["characteristic"], row["measured_mm"], row["verdict"]) for row in found},
                         {("Centre, main axis", 50, "good"), ("Centre, secondary axis", 50, "good"),
                          ("Diameter", 25.0131, "good"), ("Deviation along the surface normal", -0.02, "good")})

    def test_a_machine_that_is_away_is_said_and_tried_again(self):
        shop = self.shop(2, "TNC:\\nc_prog\\*.TXT")
        shop.controls[0].kill()
        shop.collector.start()
        self.put(shop.controls[1], "nc_prog/a.txt", log(1))
        wait_for(lambda: len(all_measurements(shop.collector)) == 3)
        state = wait_for(lambda: (now := shop.states()["m0"])["failures"] and now)
        self.assertEqual((state["state"], state["lag_s"], state["last_success_at"]), ("failing", None, None))
        self.assertIn("cannot be reached", state["last_error"])
        wait_for(lambda: shop.states()["m1"]["state"] == "ok")
        shop.start_control(0)
        self.put(shop.controls[0], "nc_prog/b.txt", log(1))
        wait_for(lambda: len(all_measurements(shop.collector)) == 6)
        wait_for(lambda: shop.states()["m0"]["state"] == "ok")
        shop.collector.wait_for_log('"event":"connection_recovered"')
        self.assertEqual(shop.collector.log.count('"event":"connection_failing"'), 1)

    def test_each_result_is_stored_once_whoever_is_killed(self):
        """Controls and collector are killed again and again while logs are written."""
        machines, logs, kills = (20, 500, 50) if DEEP else (3, 20, 6)
        shop = self.shop(machines, "TNC:\\nc_prog\\TCHPR*.TXT")
        shop.collector.start()
        fate = random.Random(17)
        steps = sorted(fate.sample(range(1, 200), kills))
        written = [0] * machines
        for step in range(200):
            for index, control in enumerate(shop.controls):
                due = logs * (step + 1) // 200
                if written[index] == due:
                    continue
                for file in range(2):
                    of_file = range(file, due, 2)
                    self.put(control, f"nc_prog/TCHPR42{file + 1}.TXT", "".join(log(number) for number in of_file))
                written[index] = due
            if step in steps:
                if fate.random() < 0.5:
                    shop.collector.kill()
                    shop.collector.start()
                else:
                    victim = fate.randrange(machines)
                    shop.controls[victim].kill()
                    shop.start_control(victim)
        total = machines * logs * 3
        wait_for(lambda: len(all_measurements(shop.collector)) >= total, seconds=300)
        for index in range(machines):
            self.settle(shop, f"m{index}", 2)
        found = all_measurements(shop.collector)
        self.assertEqual(len(found), total)
        unique = {(row["machine"], row["measured_at"], row["characteristic"]) for row in found}
        self.assertEqual(len(unique), total)


class Settings(unittest.TestCase):
    GOOD = '[[connection]]\nname = "m3"\nkind = "lsv2"\naddress = "10.0.0.7"\npaths = ["TNC:\\\\logs\\\\*.TXT"]\n'

    def refusal(self, content):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "connections.toml"
            path.write_text(content)
            done = command("--check-config", "--data", pathlib.Path(folder) / "data", "--connections", path)
            return done.returncode, re.sub(r"\S*connections\.toml", "FILE", done.stderr)

    def test_what_cannot_be_meant_ends_the_start(self):
        self.assertEqual(self.refusal(self.GOOD)[0], 0)
        for change, said in (
                (("m3", "m 3"), "FILE:2: the name of a connection must have"),
                (("lsv2", "post"), "FILE:3: unknown kind of connection 'post'"),
                (("10.0.0.7", "10.0.0.7:x"), "FILE:4: address must be HOST or HOST:PORT; got '10.0.0.7:x'"),
                (("TNC:", "PLC:"), "a path must be a folder of TNC:"),
                (("paths", "path"), "FILE:5: unknown field path"),
                (("[[connection]]", "[[connections]]"), "must contain only [[connection]]")):
            with self.subTest(change):
                code, error = self.refusal(self.GOOD.replace(*change, 1))
                self.assertEqual(code, 2)
                self.assertIn(said, error)
        self.assertIn("occurs twice", self.refusal(self.GOOD * 2)[1])
        self.assertIn("cannot read the pattern file", self.refusal(self.GOOD + 'patterns = ["none"]\n')[1])

    def test_a_pattern_gives_limits_with_their_nominal_size(self):
        with tempfile.NamedTemporaryFile("w", suffix=".pattern") as pattern:
            pattern.write("upper_um = 21\nlower_um = 0\n---\nTEIL {part_id}\nDURCHM {measured_mm} MM\n")
            pattern.flush()
            code, error = self.refusal(self.GOOD + f'patterns = ["{pattern.name}"]\n')
        self.assertEqual(code, 2)
        self.assertIn("upper_um needs nominal_mm: add a line 'nominal_mm = …' above ---", error)


if __name__ == "__main__":
    unittest.main()
