#!/usr/bin/env python3
"""floors.py finds a planted breach of each rule, at its line, and nothing in the same tree without it."""

import pathlib
import shutil
import tempfile
import unittest

import floors

TREE = pathlib.Path(__file__).resolve().parent.parent.parent

BREACHES = {  # what is planted where: (file, include) and what must be said of it
    "upward": ("common/scenario/load.cpp", '"inslab/sim/offline_run.hpp"', "an include upward"),
    "upward within a floor": ("common/data/samples/imu_sample.hpp", '"inslab/data/wire/cdr.hpp"', "an include upward"),
    "nav sees samples": ("common/nav/strapdown.cpp", '"inslab/data/samples/imu_sample.hpp"', "nav and noise include"),
    "nav sees another library": ("common/nav/strapdown.cpp", "<nlohmann/json.hpp>", "nav and noise include"),
    "noise sees nav": ("common/noise/random/stream.cpp", '"inslab/nav/geodesy.hpp"', "nav and noise include"),
    "a model sees formats": ("common/models/imu/model.cpp", '"inslab/formats/mcap/mcap_reader.hpp"', "a model includes"),
    "a model sees the host": ("common/models/imu/model.cpp", '"inslab/foundation/host/host.hpp"', "a model includes"),
    "sim sees the bus": ("common/sim/offline_run.cpp", '"inslab/bus/dds/reader.hpp"', "never include bus"),
    "the referee sees the bus": ("common/referee/score/scorer.cpp", '"inslab/bus/dds/reader.hpp"', "never include bus"),
    "Fast DDS outside the bus": ("common/sim/offline_run.cpp", "<fastdds/dds/topic/Topic.hpp>", "common/bus alone"),
    "its types outside the bus": ("services/inslab/main.cpp", '"imuPubSubTypes.hpp"', "common/bus alone"),
    "all of its types outside the bus": ("common/sim/offline_run.cpp", '"generated_types.hpp"', "common/bus alone"),
    "a service in another": ("services/truth_logger/main.cpp", '"inslab/services/inslab/live/progress.hpp"',
                             "a service includes another service"),
    "a library sees a service": ("common/sim/offline_run.cpp", '"inslab/services/inslab/live/progress.hpp"',
                                 "a library includes a service"),
    "a command on the bus itself": ("services/inslab/commands/run.cpp", '"inslab/bus/dds/participant.hpp"',
                                    "common/bus/client"),
    "a command with a model": ("services/inslab/commands/run.cpp", '"inslab/models/imu/imu_model.hpp"', "stands in a library"),
    "not by its path": ("common/nav/strapdown.cpp", '"geodesy.hpp"', 'ours are included as "inslab/<path>"'),
    "no such folder": ("common/nav/strapdown.cpp", '"inslab/geodesy/wgs84.hpp"', "there is no folder geodesy"),
}

NAMES = {  # what is planted where: (file, line of code) and what must be said of it
    "a topic": ("common/bus/service/writers.cpp", 'const std::string topic = "inslab/service_status";', "topics are named"),
    "the beginning of topics": ("services/truth_logger/main.cpp", 'return topic.rfind("inslab/imu/", 0);', "topics are named"),
    "a service": ("common/sim/offline_run.cpp", 'ack.service = "inslab-imu-injector";', "services are named"),
    "a single service": ("services/inslab/live/live_run.cpp", 'start("inslab-truth-logger");', "services are named"),
}
NO_NAMES = (
    '// "inslab/imu/0" in a comment',
    '/// such as "inslab-imu-injector"',
    'tell("listens to topics such as inslab/imu/0, of inslab-imu-injector 0");',
    'participant_options(network, "inslab-status");',
    'const char* text = R"(say "inslab/imu/0" as you like)";',
)

WRITTEN_OUT = (
    "return static_cast<double>(sample.interval_ns) * 1e-9;",
    "return 1e-9 * static_cast<double>(last_ns_ - first_ns_) / dt_s;",
    "wait(static_cast<double>((now() - begun).count()) * 1e-9, 2.0 * static_cast<double>(samples));",
    "return static_cast<double>(\n    status->sim_time_ns) * 1e-9;",
)
NOT_WRITTEN_OUT = (
    "// static_cast<double>(sample.interval_ns) * 1e-9",
    "return time::to_seconds(sample.interval_ns);",
    "return g_hz * 1e-9 * static_cast<double>(from_ns);",
    "return static_cast<double>(info.file_size) * 1e-9;",
    "return static_cast<double>(sample.interval_ns) * 1e-6;",
    "return (static_cast<double>(last_ns) - static_cast<double>(first_ns)) * 1e-9;",
)


class Floors(unittest.TestCase):
    def tree(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        tree = pathlib.Path(folder.name)
        (tree / "common").mkdir()
        (tree / "services").mkdir()
        shutil.copy(TREE / "common/CMakeLists.txt", tree / "common")
        shutil.copytree(TREE / "common/data/catalog", tree / "common/data/catalog")
        return tree

    def plant(self, path, include):
        tree = self.tree()
        (tree / path).parent.mkdir(parents=True, exist_ok=True)
        (tree / path).write_text(f"#include <cmath>\n#include {include}\n")
        return floors.check(tree)

    def test_finds_a_breach_of_each_rule(self):
        for name, (path, include, said) in BREACHES.items():
            with self.subTest(name):
                found = self.plant(path, include)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:2: "), found)
                self.assertIn(said, found[0])

    def test_finds_a_name_outside_the_catalogue(self):
        for name, (path, line, said) in NAMES.items():
            with self.subTest(name):
                found = self.plant(path, f"<string>\n{line}")
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:3: "), found)
                self.assertIn(said, found[0])

    def test_takes_names_in_comments_and_messages(self):
        for line in NO_NAMES:
            with self.subTest(line):
                self.assertEqual(self.plant("common/sim/offline_run.cpp", f"<string>\n{line}"), [])

    def test_finds_seconds_of_nanoseconds_written_out(self):
        for line in WRITTEN_OUT:
            with self.subTest(line):
                found = self.plant("common/sim/offline_run.cpp", f"<string>\n{line}")
                self.assertEqual(found, ["common/sim/offline_run.cpp:3: this is time::to_seconds"])

    def test_takes_what_is_another_product(self):
        for line in NOT_WRITTEN_OUT:
            with self.subTest(line):
                self.assertEqual(self.plant("common/sim/offline_run.cpp", f"<string>\n{line}"), [])

    def test_finds_a_folder_on_no_floor(self):
        found = self.plant("common/sensors/magnetometer.hpp", '"inslab/nav/geodesy.hpp"')
        self.assertEqual(len(found), 1, found)
        self.assertIn("stands on no floor", found[0])

    def test_finds_a_command_of_more_than_a_hundred_lines(self):
        tree = self.tree()
        path = tree / "services/inslab/commands/run.cpp"
        path.parent.mkdir(parents=True)
        path.write_text("int x;\n" * 100)
        self.assertEqual(floors.check(tree), [])
        path.write_text("int x;\n" * 101)
        found = floors.check(tree)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith("services/inslab/commands/run.cpp:101: "), found)
        self.assertIn("at most 100 lines", found[0])

    def text(self, path, text):
        tree = self.tree()
        (tree / path).parent.mkdir(parents=True, exist_ok=True)
        (tree / path).write_text(text)
        return floors.check(tree)

    def test_finds_a_namespace_that_is_not_the_folder(self):
        for path, namespace in {
            "common/nav/strapdown.cpp": "inslab::trajectory",
            "common/formats/recordings/nmea.cpp": "inslab",
            "services/inslab/live/live_run.cpp": "inslab::inslab",
        }.items():
            with self.subTest(path):
                found = self.text(path, f"\nnamespace {namespace} {{\nint x;\n}}\n")
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith(f"{path}:2: "), found)
                self.assertIn("the namespace of this folder is", found[0])

    def test_takes_a_specialization_of_what_is_declared_in_inslab_itself(self):
        specialization = "\nnamespace inslab {\n// of ours\ntemplate <>\nstruct EnumNames<nav::Kind> {};\n}\n"
        self.assertEqual(self.text("common/nav/kind.hpp", specialization), [])
        self.assertEqual(self.text("common/nav/detail.hpp", "namespace inslab::nav::detail {\n}\n"), [])

    def test_finds_a_comment_that_names_a_header_where_it_is_not(self):
        found = self.text("common/nav/strapdown.cpp", "\n// as in geodesy/wgs84.hpp\n")
        self.assertEqual(found, ["common/nav/strapdown.cpp:2: geodesy/wgs84.hpp: there is no such header below common/"])
        self.assertEqual(self.text("common/nav/strapdown.hpp", "// see nav/strapdown.hpp\n"), [])

    def test_finds_two_headers_of_one_name(self):
        tree = self.tree()
        for path in ("common/nav/alignment.hpp", "common/referee/verify/alignment.hpp"):
            (tree / path).parent.mkdir(parents=True, exist_ok=True)
            (tree / path).write_text("#pragma once\n")
        found = floors.check(tree)
        self.assertEqual(found, ["common/referee/verify/alignment.hpp:1: common/nav/alignment.hpp has that name already"])

    def test_takes_what_keeps_to_the_floors(self):
        for path, include in {
            "common/nav/strapdown.cpp": "<Eigen/Core>",
            "common/sim/offline_run.cpp": '"inslab/models/imu/imu_model.hpp"',
            "common/bus/dds/type_adapter.cpp": "<fastdds/dds/topic/Topic.hpp>",
            "services/inslab/commands/run.cpp": '"inslab/services/inslab/live/live_run.hpp"',
        }.items():
            with self.subTest(path):
                self.assertEqual(self.plant(path, include), [])


if __name__ == "__main__":
    unittest.main()
