#!/usr/bin/env python3
"""scripts/release_sbom.py: the SPDX 2.3 document of an unpacked package.

It names the Debian packages whose libraries the programs load, those whose headers and files were compiled in, and the
npm packages of the page, each with its version.
"""

import argparse
import json
import re
import subprocess
import sys
import uuid
from datetime import datetime, timezone
from pathlib import Path

sys.dont_write_bytecode = True
from release_image import EPOCH, ROOT, TRIPLETS, libraries  # noqa: E402

Package = dict[str, object]


def package(name: str, version: str, purl: str, licence: str = "NOASSERTION") -> Package:
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", f"{purl.split(':')[1].split('/')[0]}-{name}"),
            "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": licence, "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": purl}]}


def query(system: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["dpkg-query", f"--admindir={system / 'var/lib/dpkg'}", *arguments],
                          capture_output=True, text=True)


def field(system: Path, name: str, which: str) -> str:
    found = query(system, "-W", "-f", f"${{{which}}}", name)
    # A package that others only name has no fields.
    return found.stdout or sys.exit(f"release_sbom.py: {name} is not in {system}")


def owner(system: Path, file: Path) -> str:
    """The Debian package of a library; /usr/lib and /lib are one folder with two names."""
    for path in (str(file), str(file).removeprefix("/usr")):
        found = query(system, "-S", path)
        if found.returncode == 0:
            return found.stdout.split(": ")[0].split(",")[0]
    sys.exit(f"release_sbom.py: {file} belongs to no package")


def compiled_in() -> list[str]:
    """Of the section `build` of scripts/packages: headers, static libraries and the font."""
    section = re.search(r"^build: (.*)$", (ROOT / "scripts/packages").read_text(), re.MULTILINE)
    assert section is not None
    return [name for name in section[1].split() if name.endswith("-dev") or name.startswith("fonts-")]


def of_page() -> list[Package]:
    lock = json.loads((ROOT / "clients/web/package-lock.json").read_text())
    found = []
    for place, entry in lock["packages"].items():
        if place and not entry.get("dev"):
            name = place.removeprefix("node_modules/")
            purl = f"pkg:npm/{name.replace('@', '%40')}@{entry['version']}"
            found.append(package(name, entry["version"], purl, entry.get("license", "NOASSERTION")))
    return found


def document(root: Path, system: Path, version: str, architecture: str) -> dict[str, object]:
    def installed(name: str, of: Path = system) -> Package:
        number, plain = field(of, name, "Version"), name.split(":")[0]
        return package(plain, number, f"pkg:deb/debian/{plain}@{number}?arch={field(of, name, 'Architecture')}")

    product = package("fitgauge", version, f"pkg:generic/fitgauge@{version}?arch={architecture}", "Apache-2.0")
    loaded = libraries(sorted(root.glob("usr/bin/*")), system, TRIPLETS[architecture])
    owners = sorted({owner(system, file) for file in loaded.values()})
    parts = [(installed(name), "DYNAMIC_LINK") for name in owners]
    sources = {field(system, name, "source:Package") for name in owners}
    parts += [(installed(name), "STATIC_LINK") for name in compiled_in()
              if field(system, name, "source:Package") not in sources]
    parts += [(part, "CONTAINS") for part in of_page()]
    # The image has those of this machine.
    parts += [(installed(name, Path("/")), "CONTAINS") for name in ("ca-certificates", "tzdata")]
    identity = f"fitgauge-{version}-{architecture}-{EPOCH}"
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"fitgauge-{version}-{architecture}",
        "documentNamespace": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, identity)}",
        "creationInfo": {"created": datetime.fromtimestamp(EPOCH, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": ["Tool: fitgauge-scripts-release"]},
        "packages": [product, *(part for part, _ in parts)],
        "relationships": [
            {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": product["SPDXID"]},
            *({"spdxElementId": product["SPDXID"], "relationshipType": how, "relatedSpdxElement": part["SPDXID"]}
              for part, how in parts)]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=Path, required=True, help="the unpacked package")
    parser.add_argument("--version", required=True)
    parser.add_argument("--architecture", choices=TRIPLETS, required=True)
    parser.add_argument("--system", type=Path, default=Path("/"), help="a Debian of this architecture")
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    found = document(options.root, options.system, options.version, options.architecture)
    options.out.write_text(json.dumps(found, indent=1) + "\n")


main()
