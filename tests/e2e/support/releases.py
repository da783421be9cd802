"""Data folders as releases left them, and how one is made.

    python3 -m support.releases 1.0.0      (in tests/e2e, with FITGAUGED)

writes releases/1.0.0.tar.gz: the data folder, and what its daemon answered of it: `records.ndjson` with every record,
`proofs.json` with the proof of each by its id, `keys` of the log, and `answers.json` with other answers by their path."""

import io
import json
import re
import sys
import tarfile

from support.daemon import ROOT, Daemon

FOLDER = ROOT / "tests" / "e2e" / "releases"
PROGRAM = """0 BEGIN PGM HOLE MM
1 TOOL CALL 30 Z
2 L Z+50 R0 FMAX
3 TCH PROBE 421 MEASURE HOLE ~
Q273=+0 ;CENTER IN 1ST AXIS ~
Q274=+0 ;CENTER IN 2ND AXIS ~
Q262=+25 ;NOMINAL DIAMETER ~
Q325=+0 ;STARTING ANGLE ~
Q247=+90 ;STEPPING ANGLE ~
Q261=-5 ;MEASURING HEIGHT ~
Q320=+2 ;SET-UP CLEARANCE ~
Q260=+20 ;CLEARANCE HEIGHT ~
Q301=+0 ;MOVE TO CLEARANCE ~
Q275=+25.021 ;MAXIMUM LIMIT ~
Q276=+25 ;MINIMUM LIMIT ~
Q279=+0.1 ;TOLERANCE 1ST CENTER ~
Q280=+0.1 ;TOLERANCE 2ND CENTER ~
Q281=+1 ;MEASURING LOG ~
Q309=+0 ;PGM STOP TOLERANCE ~
Q330=+0 ;TOOL ~
Q423=+4 ;NO. OF PROBE POINTS ~
Q365=+0 ;TYPE OF TRAVERSE
4 END PGM HOLE MM
"""
SETUP = {"workpiece": {"features": [{"type": "block", "min_mm": [-50, -50, -40], "max_mm": [50, 50, 0]},
                                    {"type": "bore", "center_mm": [0, 0], "diameter_mm": 25.01}]}}
PATHS = ["/v1/setups/m3", "/v1/plans/4711", "/v1/tables/hole?classes=H7,X9", "/v1/files/nc_prog/hole.h",
         "/v1/measurements/summary?source=all", "/v1/uncertainties/bore-gauge", "/v1/gauges-in-use/G-07",
         "/v1/gauges-in-use/G-07/calibrations", "/v1/studies", "/v1/studies/G-07-March", "/v1/changes?kind=gauge"]


def put(daemon, path, body):
    answer = daemon.request("PUT", path, body)
    if answer.status not in (200, 201, 204):
        raise RuntimeError(f"{path}: {answer}")


def post(daemon, path, body, **headers):
    answer = daemon.post(path, body, {name.replace("_", "-"): value for name, value in headers.items()})
    if answer.status not in (200, 201, 202):
        raise RuntimeError(f"{path}: {answer}")
    return answer.json


def gauged(daemon, part):
    """A gauge with its budget, calibrations and study, and values of each of its periods and of sizes by their operator."""
    put(daemon, "/v1/uncertainties/bore-gauge", {"contributions": [
        {"name": "ring", "standard_uncertainty": 0.3}, {"name": "temperature", "half_width": 1.5, "distribution": "rectangular"}]})
    for due in ("2025-12-31", "2026-03-31"):
        put(daemon, "/v1/gauges-in-use/G-07", {"uncertainty": "bore-gauge", "calibration_due": due})
    for calibration in ({"from": "2026-05-01", "due": "2027-04-30", "certificate": "K-1234", "laboratory": "Lab"},
                        {"from": "2026-06-01", "status": "blocked"}):
        post(daemon, "/v1/gauges-in-use/G-07/calibrations", calibration)
    put(daemon, "/v1/studies/G-07-March", {"gauge": "G-07", "at": "2026-03-31", "kind": "type1", "input": {
        "reference": 25.0104, "tolerance": 0.021, "values": [25.0104, 25.0106, 25.0102, 25.0104, 25.0106, 25.0102]}})
    part = {**part, "measured_mm": "25.0105"}
    return [*({**part, "gauge": "G-07", "rule": "guard_band", "measured_at": f"{day}T08:00:00Z"}
              for day in ("2025-06-01", "2026-02-01", "2026-05-15", "2026-06-15")),
            {**part, "designation": "25 H7(E)", "go_gauge": "passes"}, {**part, "designation": "25 H7(E)", "go_gauge": "fails"},
            {**part, "size_operator": "GX"}, {**part, "rule": "guard_band", "uncertainty_um": 1, "degrees_of_freedom": 4}]


def fill(daemon, gauges=True):
    """Something of everything that is kept. @param gauges whether of gauges too: schemas before 12 cannot hold all of it"""
    put(daemon, "/v1/tables/hole/classes/X9",
        {"rows": [{"over_mm": 18, "up_to_mm": 30, "upper_um": 30, "lower_um": 5}]})
    put(daemon, "/v1/setups/m3", SETUP)
    put(daemon, "/v1/plans/4711", {"characteristics": [{"name": "bore", "designation": "25 H7"}]})
    part = {"designation": "25 H7", "part_id": "SN-1", "characteristic": "bore", "operator": "Ä. Kim", "machine": "M3"}
    values = [{**part, "measured_mm": value} for value in ("25.013", "24.990", "25.0215", "25.000001")]
    values += [{**part, "designation": "25 X9", "measured_mm": "25.02"},
               {**part, "designation": "M10-6H", "measured_mm": "9.1"},
               {**part, "measured_mm": "25.0205", "rule": "guard_band", "uncertainty_um": "1"},
               {**part, "measured_mm": "25.0205", "rule": "conformance", "uncertainty_um": "0.3"}]
    post(daemon, "/v1/measurements", values)
    if gauges:
        post(daemon, "/v1/measurements", gauged(daemon, part))
    wrong = post(daemon, "/v1/measurements", {**part, "measured_mm": "25.3"}, Idempotency_Key="once")
    post(daemon, f"/v1/measurements/{wrong['id']}/corrections", {"measured_mm": "25.003", "reason": "misread"})
    post(daemon, f"/v1/measurements/{wrong['id']}/notes", {"cause": "worn insert", "measure": "changed"})
    for name, program in {"hole": PROGRAM, "free": re.sub(r"(Q2(75|76|79|80)=)\S+", r"\1+0", PROGRAM)}.items():
        daemon.request("PUT", f"/v1/files/nc_prog/{name}.h", program, {"Content-Type": "application/octet-stream"})
        run = post(daemon, "/v1/runs", {"program": f"nc_prog/{name}.h", "setup": "m3"})
        if run["status"] != "completed":
            raise RuntimeError(run["messages"])


def make(name):
    daemon = Daemon("--origin-name", "plant-1/" + name).start()
    try:
        fill(daemon)
        records = [json.dumps(record) for record in daemon.stored()]
        ids = [json.loads(record)["id"] for record in records]
        made = {"records.ndjson": "".join(daemon.get(f"/v1/measurements/{each}").text + "\n" for each in ids),
                "proofs.json": json.dumps({each: daemon.get(f"/v1/measurements/{each}/proof").json for each in ids}),
                "keys": daemon.get("/v1/log/key").text,
                "answers.json": json.dumps({path: daemon.get(path).text for path in PATHS})}
        if daemon.stop() != 0:
            raise RuntimeError(daemon.log)
        with tarfile.open(FOLDER / f"{name}.tar.gz", "w:gz") as archive:
            for file in sorted(daemon.data.iterdir()):
                if file.suffix not in (".lock", ".db-shm", ".db-wal"):
                    archive.add(file, f"data/{file.name}", recursive=False)
            for path, text in made.items():
                entry = tarfile.TarInfo(path)
                entry.size = len(text.encode())
                archive.addfile(entry, io.BytesIO(text.encode()))
    finally:
        daemon.cleanup()


def unpack(name, daemon):
    """Puts a release's folder where `daemon` has its data. @returns the folder of what was answered then"""
    with tarfile.open(FOLDER / f"{name}.tar.gz") as archive:
        archive.extractall(daemon.folder / "release")
    (daemon.folder / "release" / "data").rename(daemon.data)
    return daemon.folder / "release"


def names():
    return sorted(path.name.removesuffix(".tar.gz") for path in FOLDER.glob("*.tar.gz"))


if __name__ == "__main__":
    make(sys.argv[1])
