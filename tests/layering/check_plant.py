#!/usr/bin/env python3
"""Configures fitgauge with some kinds of connections and sees that the others are left out with their libraries.

Fails when the build of `webhook;folder` has another kind, compiles a file of a folder that is left out, or links a
library of one, and when a name that is no kind is taken.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

LEFT_OUT = ["mosquitto", "protobuf", "plant/mqtt/", "plant/sparkplug/", "plant/lsv2/collector"]


def configure(root: Path, build: Path, kinds: str) -> int:
    return subprocess.run(["cmake", "-S", root, "-B", build, "-G", "Ninja", f"-DFITGAUGE_PLANT={kinds}", "-DFITGAUGE_TESTS=OFF"],
                          capture_output=True, check=False).returncode


def main(root: Path) -> int:
    findings: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        build = Path(folder)
        if configure(root, build, "webhook;folder") != 0:
            findings.append("webhook;folder does not configure")
        else:
            kinds = (build / "server/plant/kinds/plant_kinds.inc").read_text(encoding="utf-8").split("\n")
            if [kind.split(",")[0] for kind in kinds if kind] != [f"FITGAUGE_KIND({kind}" for kind in ("webhook", "folder_in", "folder_out")]:
                findings.append(f"webhook;folder has the kinds {kinds}")
            ninja = (build / "build.ninja").read_text(encoding="utf-8")
            findings += [f"webhook;folder builds with {name}" for name in LEFT_OUT if name in ninja]
            if configure(root, build, "webhok") == 0:
                findings.append("webhok is taken for a kind")
    print("\n".join(findings) or "kinds are left out with their libraries")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
