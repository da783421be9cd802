"""The SPDX document of a release: every part has its version, of the system that it comes from."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support.daemon import FITGAUGED, ROOT


class Parts(unittest.TestCase):
    def test_what_the_image_has_of_this_machine_need_not_be_in_the_system_of_the_libraries(self):
        """The root that arm64 is compiled against has neither CA certificates nor time zones."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        program, system = folder / "root/usr/bin/fitgauged", folder / "system"
        database = system / "var/lib/dpkg"
        for each in (program.parent, database):
            each.mkdir(parents=True)
        program.symlink_to(pathlib.Path(FITGAUGED).resolve())
        for name in ("lib", "lib64", "usr"):
            (system / name).symlink_to(f"/{name}")
        (database / "info").symlink_to("/var/lib/dpkg/info")
        status = pathlib.Path("/var/lib/dpkg/status").read_text(encoding="utf-8")
        (database / "status").write_text(re.sub(r"^Package: (?:ca-certificates|tzdata)\n.*?\n\n", "", status,
                                                flags=re.MULTILINE | re.DOTALL), encoding="utf-8")
        out = folder / "parts.json"
        made = subprocess.run([sys.executable, ROOT / "scripts/release_sbom.py", "--root", folder / "root", "--system", system,
                               "--version", "9.9.9", "--architecture", "amd64", "--out", out],
                              capture_output=True, text=True, check=False)
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        versions = {part["name"]: part["versionInfo"] for part in json.loads(out.read_text(encoding="utf-8"))["packages"]}
        self.assertLessEqual({"fitgauge", "libssl3", "libboost1.81-dev", "ca-certificates", "tzdata"}, set(versions))
        self.assertEqual([name for name, version in versions.items() if not version], [])
