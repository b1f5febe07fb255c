"""Runs a scenario, exports its log in every format of one file, and reads the files with Python's own means.

Usage: check_formats.py INSLAB SCENARIO. Exit code 0 when all is as it should be, else 1.
"""

import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

BAD_INPUT = 2
KML = "{http://www.opengis.net/kml/2.2}"


def run(*command, expected=0):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode == expected, f"{command}: exit code {result.returncode}: {result.stdout}{result.stderr}"
    return result.stdout + result.stderr


def rows(path, columns):
    table = [[float(field) for field in line.split()] for line in path.read_text().splitlines()]
    assert len(table) > 1, f"{path}: no rows"
    assert all(len(row) == columns for row in table), f"{path}: expected {columns} columns"
    times = [row[1] if columns == 11 else row[0] for row in table]
    # The scenario runs through the end of a week.
    assert all(a < b or a - b > 302400 for a, b in zip(times, times[1:])), f"{path}: time does not increase"
    return table


def check_kml(path, nav):
    root = ElementTree.parse(path).getroot()
    assert root.tag == KML + "kml", root.tag
    lines = root.findall(f".//{KML}LineString/{KML}coordinates")
    assert len(lines) == 2, f"{len(lines)} lines; expected the track and the one on the ground"
    points = [[float(value) for value in point.split(",")] for point in lines[0].text.split()]
    for point, row in ((points[0], nav[0]), (points[-1], nav[-1])):
        assert abs(point[0] - row[3]) < 1e-9 and abs(point[1] - row[2]) < 1e-9, f"{point} is not at {row}"


def crc32(text):
    """NovAtel's, bit by bit as its manual describes it."""
    crc = 0
    for byte in text.encode():
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xEDB88320 if crc & 1 else 0)
    return crc


def check_novatel(path, imu):
    """Sums of the counts against sums of the increments: STIM300, 2^-22 m/s and 2^-21 deg a count."""
    counts = [0] * 6
    lines = path.read_text().splitlines()
    assert len(lines) == len(imu), f"{len(lines)} lines for {len(imu)} samples"
    for line in lines:
        body, crc = line[1:].split("*")
        assert line[0] == "%" and int(crc, 16) == crc32(body), line
        fields = body.split(";")[1].split(",")
        assert fields[1] == "26", line
        counts = [total + int(field) for total, field in zip(counts, fields[5:])]
    z_accel, minus_y_accel, x_accel, z_gyro, minus_y_gyro, x_gyro = counts
    frd = [-minus_y_gyro, x_gyro, -z_gyro, -minus_y_accel, x_accel, -z_accel]
    units = [1e-9] * 3 + [2e-8] * 3
    for i, (total, unit) in enumerate(zip(frd, units)):
        wanted = sum(row[1 + i] for row in imu)
        # Half a count is carried on; the text's decimals add their own rounding.
        assert abs(total * unit - wanted) <= 0.501 * unit + len(imu) * 1e-12, f"column {i}: {total * unit} {wanted}"


def main():
    inslab, scenario = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        run(inslab, "simulate", scenario, "--output", folder)
        log = next(folder.glob("*.mcap"))
        for name in ("nav", "gnss", "kml"):
            run(inslab, "export", log, "--format", name, "-o", folder / name)
        for name in ("imu", "novatel"):
            said = run(inslab, "export", log, "--format", name, "-o", folder / name, expected=BAD_INPUT)
            assert "has inslab/imu/0 and inslab/imu/3; expected to be told which" in said, said
            run(inslab, "export", log, "--format", name, "--imu-type", "26", "--topic", "inslab/imu/0", "-o",
                folder / name)
        nav, imu = rows(folder / "nav", 11), rows(folder / "imu", 7)
        rows(folder / "gnss", 7)
        check_kml(folder / "kml", nav)
        check_novatel(folder / "novatel", imu)
        assert "good" in run(inslab, "trajectory", "check", folder / "nav")
        assert "good" in run(inslab, "trajectory", "check", log)
        (folder / "bad").write_text("t_s,lat_deg,lon_deg,h_m\n0,30,114,20\n1,30,x,20\n2,30,114,20\n")
        said = run(inslab, "trajectory", "check", folder / "bad", expected=1)
        assert "line 3, column 3 (lon_deg): is 'x'; expected a number" in said, said
        said = run(inslab, "export", log, "--format", "novatel", "--topic", "inslab/imu/0", "--imu-type", "99", "-o",
                   folder / "none", expected=BAD_INPUT)
        assert "IMU type 99 is not known" in said, said
        said = run(inslab, "export", log, "--format", "novatel", "--topic", "inslab/imu/0", "--imu-type", "32", "-o",
                   folder / "none", expected=BAD_INPUT)
        assert "IMU type 32 puts out a sample each 8000000 ns, inslab/imu/0 each 5000000 ns" in said, said
        run(inslab, "trajectory", "check", folder / "no_such_file", expected=BAD_INPUT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
