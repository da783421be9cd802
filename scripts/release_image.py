#!/usr/bin/env python3
"""scripts/release_image.py: an OCI image of an unpacked package, without an engine.

It holds the service, the libraries that it needs, CA certificates and time zones, and nothing else. User, ports,
volumes and entry point are those of the last stage of the Dockerfile. The file is an OCI layout that `docker load`
and `podman load` take.
"""

import argparse
import gzip
import hashlib
import io
import json
import os
import re
import subprocess
import sys
import tarfile
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TRIPLETS = {"amd64": "x86_64-linux-gnu", "arm64": "aarch64-linux-gnu"}
EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))


def needed(file: Path) -> list[str]:
    """The libraries that a program or library names, and the loader it is started by."""
    text = subprocess.run(["readelf", "-dlW", file], capture_output=True, text=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.*)\]", text) + re.findall(r"interpreter: (.*)\]", text)


def libraries(programs: list[Path], system: Path, triplet: str) -> dict[str, Path]:
    """All that the programs load: the place in the image and the file of the system it comes from."""
    found: dict[str, Path] = {}
    waiting = list(programs)
    while waiting:
        for name in needed(waiting.pop()):
            place = name.lstrip("/") if name.startswith("/") else f"lib/{triplet}/{name}"
            if place in found:
                continue
            places = [system / place, system / "usr" / place]
            file = next((path for path in places if path.exists()), None)
            if file is None:
                sys.exit(f"release_image.py: {name} is in none of {', '.join(map(str, places))}")
            found[place] = file.resolve()
            waiting.append(found[place])
    return found


class Layer:
    """A tar of one layer: the same entries give the same bytes."""

    def __init__(self) -> None:
        self.entries: dict[str, tuple[tarfile.TarInfo, bytes]] = {}

    def add(self, place: str, content: bytes = b"", mode: int = 0o644, **fields: object) -> None:
        for parent in reversed(Path(place).parents[:-1]):
            if str(parent) not in self.entries:
                self.add(str(parent), mode=0o755, type=tarfile.DIRTYPE)
        entry = tarfile.TarInfo(place)
        entry.size, entry.mode, entry.mtime = len(content), mode, EPOCH
        for name, value in fields.items():
            setattr(entry, name, value)
        self.entries[place] = (entry, content)

    def bytes(self) -> bytes:
        return tar_of([self.entries[place] for place in sorted(self.entries)])


def tar_of(entries: list[tuple[tarfile.TarInfo, bytes]]) -> bytes:
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for entry, content in entries:
            tar.addfile(entry, io.BytesIO(content))
    return out.getvalue()


def configuration() -> dict[str, object]:
    """Of the last stage of the Dockerfile."""
    text = (ROOT / "Dockerfile").read_text().rsplit("\nFROM ", 1)[1].replace("\\\n", " ")
    words = {word: rest for word, rest in re.findall(r"^([A-Z]+) (.*)$", text, re.MULTILINE)}
    seconds = {name: int(value) * 10**9 for name, value in re.findall(r"--([a-z-]+)=(\d+)s", words["HEALTHCHECK"])}
    return {"User": words["USER"], "WorkingDir": words["WORKDIR"], "Env": words["ENV"].split(),
            "ExposedPorts": {words["EXPOSE"] + "/tcp": {}}, "Volumes": {words["VOLUME"]: {}},
            "Entrypoint": json.loads(words["ENTRYPOINT"]),
            "Healthcheck": {"Test": ["CMD", *json.loads(words["HEALTHCHECK"].split("CMD", 1)[1])],
                            "Interval": seconds["interval"], "Timeout": seconds["timeout"],
                            "StartPeriod": seconds["start-period"]}}


def layer_of(root: Path, system: Path, triplet: str, config: dict[str, object]) -> bytes:
    layer = Layer()
    service = root / "usr/bin/fitgauged"
    layer.add(f"usr/local/bin/{service.name}", service.read_bytes(), 0o755)
    for place, file in libraries([service], system, triplet).items():
        layer.add(place, file.read_bytes(), 0o755)
    for name in ("copyright", "licences.txt"):
        layer.add(f"usr/share/doc/fitgauge/{name}", (root / "usr/share/doc/fitgauge" / name).read_bytes())
    certificates = "etc/ssl/certs/ca-certificates.crt"
    # Debian's alone: the bundle of the system that builds has also what its administrator trusts.
    trusted = sorted(Path("/usr/share/ca-certificates/mozilla").glob("*.crt"))
    layer.add(certificates, b"".join(file.read_bytes() for file in trusted))
    layer.add("usr/lib/ssl/cert.pem", type=tarfile.SYMTYPE, linkname="/" + certificates)
    zones = Path("/usr/share/zoneinfo")
    for file in sorted(zones.rglob("*")):
        if file.is_file() and file.relative_to(zones).parts[0] not in ("posix", "right"):
            layer.add(str(file)[1:], file.read_bytes())
    user, group = str(config["User"]).split(":")
    layer.add("etc/passwd", f"root:x:0:0::/:\nfitgauge:x:{user}:{group}::/data:\n".encode())
    layer.add("etc/group", f"root:x:0:\nfitgauge:x:{group}:\n".encode())
    layer.add("tmp", mode=0o1777, type=tarfile.DIRTYPE)
    for volume in config["Volumes"]:  # type: ignore[attr-defined]
        layer.add(volume.lstrip("/"), mode=0o750, type=tarfile.DIRTYPE, uid=int(user), gid=int(group))
    return layer.bytes()


def image(root: Path, system: Path, version: str, architecture: str) -> bytes:
    """The OCI layout, with the manifest.json of `docker save`."""
    config = configuration()
    layer = layer_of(root, system, TRIPLETS[architecture], config)
    packed = gzip.compress(layer, mtime=0)
    blobs: dict[str, bytes] = {}

    def blob(content: bytes, kind: str) -> dict[str, object]:
        digest = hashlib.sha256(content).hexdigest()
        blobs[f"blobs/sha256/{digest}"] = content
        return {"mediaType": f"application/vnd.oci.image.{kind}", "digest": f"sha256:{digest}", "size": len(content)}

    def document(value: object) -> bytes:
        return json.dumps(value, sort_keys=True).encode()

    created = datetime.fromtimestamp(EPOCH, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    of_layer = blob(packed, "layer.v1.tar+gzip")
    of_config = blob(document({
        "created": created, "architecture": architecture, "os": "linux", "config": config,
        "rootfs": {"type": "layers", "diff_ids": ["sha256:" + hashlib.sha256(layer).hexdigest()]},
        "history": [{"created": created, "comment": f"fitgauge {version}"}]}), "config.v1+json")
    of_manifest = blob(document({
        "schemaVersion": 2, "mediaType": "application/vnd.oci.image.manifest.v1+json",
        "config": of_config, "layers": [of_layer]}), "manifest.v1+json")
    name = f"fitgauge:{version}"
    of_manifest["annotations"] = {"io.containerd.image.name": f"docker.io/library/{name}",
                                  "org.opencontainers.image.ref.name": version}
    of_manifest["platform"] = {"architecture": architecture, "os": "linux"}
    place = {key: str(value["digest"]).replace("sha256:", "blobs/sha256/")
             for key, value in (("config", of_config), ("layer", of_layer))}
    files = {**blobs, "oci-layout": document({"imageLayoutVersion": "1.0.0"}),
             "index.json": document({"schemaVersion": 2, "mediaType": "application/vnd.oci.image.index.v1+json",
                                     "manifests": [of_manifest]}),
             "manifest.json": document([{"Config": place["config"], "RepoTags": [name], "Layers": [place["layer"]]}])}
    archive = Layer()
    for path, content in files.items():
        archive.add(path, content)
    print(f"{name} for {architecture}: {len(layer) / 1e6:.1f} MB unpacked, {len(packed) / 1e6:.1f} MB packed")
    return archive.bytes()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=Path, required=True, help="the unpacked package")
    parser.add_argument("--version", required=True)
    parser.add_argument("--architecture", choices=TRIPLETS, required=True)
    parser.add_argument("--system", type=Path, default=Path("/"), help="a Debian of this architecture")
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    options.out.write_bytes(image(options.root, options.system, options.version, options.architecture))


if __name__ == "__main__":
    main()
