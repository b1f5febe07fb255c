"""Runs the product on every file of config/invalid: exit code 2, the expected message, and nothing started.

Usage: check_invalid_files.py BINARY_FOLDER CONFIG_INVALID_FOLDER. Exit code 0 when all is as expected.json says, else 1.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

BAD_INPUT = 2


def commands(binaries, entry, file, scratch):
    """`check` for all; for a scenario also whatever else could start something."""
    inslab = str(binaries / "inslab")
    check = [inslab, "check", file, "--kind", entry["kind"]]
    yield check + (["--sensor", entry["sensor_kind"]] if "sensor_kind" in entry else [])
    if entry["kind"] == "scenario":
        yield [inslab, "simulate", file, "--output", scratch]
        yield [inslab, "run", file, "--log", str(pathlib.Path(scratch) / "run.mcap")]
        yield [str(binaries / "inslab-trajectory-server"), "--scenario", file]


def problem(command, message):
    """What is wrong with the outcome of one command, or None."""
    result = subprocess.run(command, capture_output=True, text=True, timeout=20, check=False)
    if result.returncode != BAD_INPUT:
        return f"exit code {result.returncode}; expected {BAD_INPUT}: {result.stderr}"
    if message not in result.stderr:
        return f"said {result.stderr!r}; expected {message!r}"
    if result.stdout:
        return f"printed {result.stdout!r} before it refused"
    return None


def main():
    binaries, folder = map(pathlib.Path, sys.argv[1:3])
    entries = json.loads((folder / "expected.json").read_text())["files"]
    failures = runs = 0
    with tempfile.TemporaryDirectory() as scratch:
        for entry in entries:
            reported = str(folder / entry.get("reported_file", entry["file"]))
            place = entry["path"] + ": " if entry["path"] else ""
            message = f"{reported}: {place}{entry['reason']}"
            for command in commands(binaries, entry, str(folder / entry["file"]), scratch):
                runs += 1
                wrong = problem(command, message)
                if wrong:
                    failures += 1
                    print(f"{' '.join(command)}: {wrong}")
        left = list(pathlib.Path(scratch).rglob("*"))
    if left:
        failures += 1
        print(f"files were written: {left}")
    print(f"{len(entries)} invalid files, {runs} runs, {failures} failures")
    return 1 if failures or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
