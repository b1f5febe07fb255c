"""Which files a scenario takes, where they lie here and where on a host of the set."""

import hashlib
import json
import os
import pathlib
import subprocess

from hosts.inventory import InventoryError

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OUTSIDE = "outside"  # below a host's folder: what does not lie below the project's, under its whole path


class ScenarioFiles:
    """`place` is the scenario's path below a host's folder; `files` has (path here, path there) of it and of all it
    names. A path there is absolute where the scenario names an absolute one, else below the host's folder."""

    def __init__(self, scenario):
        here = pathlib.Path(os.path.normpath(ROOT / scenario))  # an absolute path stays as it is
        if not here.is_file():
            where = "" if os.path.isabs(scenario) else f" below {ROOT}; for another place write the whole path"
            raise InventoryError(f"scenario: names '{scenario}', which is not there{where}")
        named = self.named_by(here)
        self.here = here
        paths = [pathlib.Path(os.path.normpath(here.parent / name)) for name in named]
        ours = all(path.is_relative_to(ROOT) for path, name in zip(paths, named) if not os.path.isabs(name))

        def place(path):
            return str(path.relative_to(ROOT)) if ours else f"{OUTSIDE}{path}"

        self.place = place(here)
        self.files = [(path, str(path) if os.path.isabs(name) else place(path)) for path, name in zip(paths, named)]

    @staticmethod
    def said_by(program, *words, folder):
        """How a program of the project was, run in that folder."""
        path = ROOT / "build/bin" / program
        if not path.exists():
            raise InventoryError(f"scenario: cannot be checked: {path} is not there; build the project first")
        return subprocess.run([path, *words], cwd=folder, text=True, check=False, capture_output=True)

    @classmethod
    def named_by(cls, scenario):
        done = cls.said_by("inslab", "check", "--kind", "scenario", "--files", "--", scenario.name,
                           folder=scenario.parent)
        if done.returncode != 0:
            raise InventoryError(f"scenario: {done.stderr.strip()} (in {scenario.parent})")
        return done.stdout.splitlines()

    def sensors(self):
        """The numbers of its sensors, as inventories write them, by their kind."""
        scenario = json.loads(self.here.read_text(encoding="utf-8"))
        return {kind: [str(sensor.get("number", 0)) for sensor in listed]
                for kind, listed in scenario.items() if isinstance(listed, list)}

    def must_take_clock(self, words):
        """The trajectory server is asked: it knows its options, and what the scenario's clock can be changed to."""
        done = self.said_by("inslab-trajectory-server", "--scenario", self.here.name, "--check", *words,
                            folder=self.here.parent)
        if done.returncode != 0:
            raise InventoryError(f"clock: {done.stderr.strip().splitlines()[0]}")

    def hashes(self):
        """SHA-256 by the path there."""
        return {there: hashlib.sha256(here.read_bytes()).hexdigest() for here, there in self.files}
