"""Validates the product's JSON files with jsonschema against the schemas of config/schema.

Usage: validate_schemas.py CONFIG_FOLDER. Exit code 0: all as it should be; 1: not; 77: jsonschema is not installed.
"""

import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: the Python package jsonschema is not installed (Debian: python3-jsonschema)")
    sys.exit(77)

PROFILE_KINDS = {"imu": "imu_error", "vibration": "vibration", "installation": "installation", "gnss": "gnss_error",
                 "magnetometer": "magnetometer_error", "barometer": "barometer_error", "odometer": "odometer_error",
                 "heading": "heading_error", "air_data": "air_data_error",
                 "fault": "fault"}
# What one field's declaration says, a schema says too; rules over several fields are the program's alone.
RULES_OF_SCHEMAS = {"known_key", "required_key", "value_type", "value_range", "bounded_size", "known_name"}


def validators(folder):
    found = {}
    for path in sorted((folder / "schema").glob("*.schema.json")):
        schema = json.loads(path.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        found[path.name.split(".")[0]] = jsonschema.Draft202012Validator(schema)
    return found


def wrongly_refused(folder, schemas):
    files = [(path, "scenario") for path in sorted((folder / "scenarios").glob("**/*.json"))]
    files += [(path, "navigation") for path in sorted((folder / "nav").glob("**/*.json"))]
    for name, kind in PROFILE_KINDS.items():
        files += [(path, kind) for path in sorted((folder / "profiles" / name).glob("**/*.json"))]
    print(f"{len(files)} valid files")
    if len(files) < 10:
        yield f"only {len(files)} files found"
    for path, kind in files:
        for error in schemas[kind].iter_errors(json.loads(path.read_text())):
            yield f"{path}: {error.json_path}: {error.message}"


def wrongly_accepted(folder, schemas):
    expected = json.loads((folder / "invalid" / "expected.json").read_text())["files"]
    checked = set()
    for entry in expected:
        if entry["rule"] not in RULES_OF_SCHEMAS or "reported_file" in entry:
            continue
        checked.add(entry["rule"])
        if schemas[entry["kind"]].is_valid(json.loads((folder / "invalid" / entry["file"]).read_text())):
            yield f"{entry['file']}: the schema accepts what breaks the rule {entry['rule']}"
    if checked != RULES_OF_SCHEMAS:
        yield f"no invalid file for {sorted(RULES_OF_SCHEMAS - checked)}"


def main():
    folder = pathlib.Path(sys.argv[1])
    schemas = validators(folder)
    problems = [*wrongly_refused(folder, schemas), *wrongly_accepted(folder, schemas)]
    if set(schemas) != {"scenario", "navigation", *PROFILE_KINDS.values()}:
        problems.append(f"schemas found: {sorted(schemas)}")
    print("\n".join(problems) if problems else "all as the schemas say")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
