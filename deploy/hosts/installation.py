"""Puts what the set needs on its hosts, and looks whether it is there."""

import io
import os
import shlex
import subprocess
import tarfile

from hosts.host import LabError
from hosts.scenario_files import ROOT


def readable(entry):
    """As a service of another user must find it."""
    entry.mode = 0o755 if entry.isdir() or entry.mode & 0o100 else 0o644
    return entry


class Installation:
    def __init__(self, lab):
        self.lab, self.hosts, self.files = lab, lab.hosts, lab.files

    def install(self):
        for host in self.hosts:
            if not host.entry.reach and os.path.realpath(host.folder) == str(ROOT):
                print(f"{host.name}: {host.folder} is this folder: nothing to copy")
            else:
                self.install_on(host)
            if host.systemd:
                self.install_units(host)

    def install_on(self, host):
        print(f"{host.name}: programs, profiles and the scenario with all it names to {host.folder}")
        # Only what runs: no sources, no tests.
        programs = sorted(str(p.relative_to(ROOT)) for p in (ROOT / "build/bin").glob("inslab*"))
        self.unpack(host, host.folder, [(ROOT / name, name) for name in ("config", *programs)]
                    + [(here, there) for here, there in self.files.files if not os.path.isabs(there)])
        self.unpack(host, "/", [(here, there) for here, there in self.files.files if os.path.isabs(there)])

    def unpack(self, host, folder, files):
        if not files:
            return
        packed = io.BytesIO()
        with tarfile.open(fileobj=packed, mode="w:gz", compresslevel=1, dereference=True) as archive:
            for here, there in files:
                archive.add(here, there.lstrip("/"), filter=readable)
        folder = shlex.quote(folder)
        # tar puts a new file in the old one's place: a program that runs is not written into.
        unpack = f"umask 022; mkdir -p {folder} && tar -C {folder} --no-same-owner -xz"
        done = subprocess.run(host.words(unpack), input=packed.getvalue(), check=False, capture_output=True)
        if done.returncode != 0:
            raise LabError(f"{host.name}: the copy to {folder} failed: {done.stderr.decode(errors='replace').strip()}")

    def install_units(self, host):
        done = host.run("mkdir -p /etc/inslab && cat >/etc/inslab/lab.env", input=self.lab.environment(host))
        units = ROOT / "deploy/systemd"
        for unit in sorted([*units.glob("*.service"), *units.glob("*.service.d/*.conf")]):
            place = f"/etc/systemd/system/{unit.relative_to(units)}"
            text = unit.read_text(encoding="utf-8").replace("/opt/inslab", host.folder)
            done = done if done.returncode else host.run(f"mkdir -p $(dirname {place}) && cat >{place}", input=text)
        done = done if done.returncode else host.run("systemctl daemon-reload")
        if done.returncode != 0:
            raise LabError(f"{host.name}: the units cannot be installed (root?)")

    def must_be_complete(self):
        """What the set needs is on every host, and the scenario is the one that is here."""
        problems = []
        for host in self.hosts:
            programs = [f"build/bin/inslab-{name}" for name, _ in host.entry.services]
            programs += ["build/bin/inslab"] if host is self.lab.server.host else []
            hashes = self.files.hashes()
            done = host.ask(host.in_folder(
                f"for file in {shlex.join(programs)}; do [ -x $file ] || echo \"missing $file\"; done; "
                f"sha256sum -- {shlex.join(hashes)} 2>/dev/null; true"))
            if done.returncode != 0:
                problems.append(f"{host.name}: {done.stderr.strip() or 'no answer'}")
                continue
            lines = [line.split(maxsplit=1) for line in done.stdout.splitlines()]
            found = {name: digest for digest, name in lines if digest != "missing"}
            problems += [f"{host.name}: {name} is not there" for digest, name in lines if digest == "missing"]
            problems += [f"{host.name}: {there} " + ("is another than here" if there in found else "is not there")
                         for there, digest in hashes.items() if found.get(there) != digest]
            if host.systemd and host.ask("cat /etc/inslab/lab.env").stdout != self.lab.environment(host):
                problems.append(f"{host.name}: the units are not there, or those of another inventory")
        if problems:
            raise LabError("\n  ".join(["the hosts lack what the set needs; deploy/lab install brings it:", *problems]))
