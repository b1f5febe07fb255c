"""Reads an HDF5 export with h5py and compares every value with the CSV export of the same log.

read_hdf5.py FILE CSV_FOLDER; exit code 77: h5py is missing.
"""

import csv
import math
import pathlib
import struct
import sys

try:
    import h5py
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)


def agrees(dataset, value, text):
    """Doubles must have the same bits, NaN aside."""
    if dataset.dtype.kind == "S":
        return value.decode() == text
    if "enumerators" in dataset.attrs:
        return text == "" or dataset.attrs["enumerators"].decode().split()[value] == text
    if dataset.dtype.kind == "f":
        if text == "":
            return math.isnan(value)
        expected = float(text)
        return (math.isnan(expected) and math.isnan(value)) or struct.pack("d", expected) == struct.pack("d", value)
    return int(value) == int(text or 0)


def check_topic(group, path):
    with open(path, newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    assert set(names) == set(group), f"{path}: other columns than in {group.name}"
    for column, name in enumerate(names):
        dataset = group[name]
        assert dataset.attrs["topic"] == group.attrs["topic"]
        assert "unit" in dataset.attrs
        values = dataset[:]
        assert len(values) == len(rows), f"{group.name}/{name}: {len(values)} values, {len(rows)} rows"
        for k, (value, row) in enumerate(zip(values, rows)):
            assert agrees(dataset, value, row[column]), f"{group.name}/{name}[{k}]: {value} is not {row[column]}"
    print(f"{group.attrs['topic'].decode()}: {len(rows)} rows, {len(rows) * len(names)} values agree")


def main():
    with h5py.File(sys.argv[1], "r") as file:
        topics = []
        file.visititems(lambda _, item: topics.append(item) if "type" in item.attrs else None)
        assert topics, "no group has a type"
        for group in topics:
            name = group.attrs["topic"].decode().replace("/", "_")
            check_topic(group, pathlib.Path(sys.argv[2]) / f"{name}.csv")
        print("metadata", {key: value.decode() for key, value in file.attrs.items()})
        assert file.attrs["run.scenario"] == b"random values"


main()
