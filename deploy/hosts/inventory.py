"""What an inventory file says, and what is wrong with it."""

import ipaddress
import json
import pathlib
import re

# Of which sensors of a scenario there is one for each, "": of none; the file follows from the catalogue.
SERVICES = json.loads((pathlib.Path(__file__).resolve().parent / "services.json").read_text(encoding="utf-8"))
KEYS = {"scenario": str, "domain": int, "unit": str, "discovery": str, "log": str, "hosts": list, "clock": list}
HOST_KEYS = {"name": str, "address": str, "folder": str, "reach": list, "services": list, "systemd": bool,
             "discovery_server": bool}
HIGHEST_DOMAIN = 232  # RTPS 2.2, 9.6.1: beyond it the ports would not fit
UNIT = re.compile(r"[A-Za-z0-9_.-]{1,64}")
HIDDEN = ("/home", "/root", "/run/user", "/tmp", "/var/tmp")  # by deploy/systemd/inslab-.service.d/sandbox.conf
FOR_SYSTEMD = re.compile(r"[^\s%$\"'\\]+")  # what a unit file takes as it is


class InventoryError(Exception):
    """What is wrong, with the place in the file."""


def checked(value, keys, place, required):
    if not isinstance(value, dict):
        raise InventoryError(f"{place or 'the file'}: is no object")
    for key, item in value.items():
        if key not in keys:
            raise InventoryError(f"{place}{key}: is not known; expected one of {', '.join(sorted(keys))}")
        if not isinstance(item, keys[key]) or (keys[key] is int and isinstance(item, bool)):
            raise InventoryError(f"{place}{key}: is no {keys[key].__name__}")
    for key in required:
        if key not in value:
            raise InventoryError(f"{place}{key}: is missing")
    return value


def words(items, place):
    """A list of words, none empty."""
    for i, item in enumerate(items):
        if not isinstance(item, str) or not item:
            raise InventoryError(f"{place}[{i}]: is {json.dumps(item)}; expected a word")
    return items


def no_control_characters(value, place):
    if not value or not value.isprintable():
        raise InventoryError(f"{place}: is {json.dumps(value)}; expected printable characters, at least one")


class HostEntry:
    """One of the inventory's hosts."""

    def __init__(self, entry, place):
        checked(entry, HOST_KEYS, place, ("name", "address", "folder", "services"))
        self.name, self.address, self.folder = entry["name"], entry["address"], entry["folder"]
        self.reach = words(entry.get("reach", []), f"{place}reach")
        self.systemd = entry.get("systemd", False)
        self.has_discovery_server = entry.get("discovery_server", False)
        no_control_characters(self.name, f"{place}name")
        no_control_characters(self.folder, f"{place}folder")
        try:
            ipaddress.IPv4Address(self.address)
        except ValueError as error:
            raise InventoryError(f"{place}address: {error}") from None
        if not self.folder.startswith("/"):
            raise InventoryError(f"{place}folder: is '{self.folder}'; expected a path that begins with /")
        self.must_suit_systemd(self.folder, f"{place}folder")
        if self.systemd and self.folder.startswith(HIDDEN):
            raise InventoryError(f"{place}folder: is '{self.folder}'; with systemd expected none of "
                                 f"{', '.join(HIDDEN)}, which the services do not see")
        self.services = [self.service(text, f"{place}services[{i}]")
                         for i, text in enumerate(words(entry["services"], f"{place}services"))]

    @staticmethod
    def service(text, place):
        name, colon, sensor = text.partition(":")
        if name not in SERVICES or (colon and not (SERVICES[name] and sensor.isascii() and sensor.isdigit())):
            raise InventoryError(f"{place}: is '{text}'; expected one of "
                                 + ", ".join(n + (":NUMBER" if s else "") for n, s in SERVICES.items()))
        return name, str(int(sensor or "0"))

    def must_suit_systemd(self, value, place):
        if self.systemd and not FOR_SYSTEMD.fullmatch(value):
            raise InventoryError(f"{place}: is '{value}'; with systemd expected no blanks, quotes, % or $")


class Inventory:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        try:
            inventory = json.loads(self.path.read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError) as error:
            raise InventoryError(f"cannot be read: {error}") from None
        except json.JSONDecodeError as error:
            raise InventoryError(f"line {error.lineno}, column {error.colno}: {error.msg}") from None
        except RecursionError:
            raise InventoryError("is nested too deeply") from None
        checked(inventory, KEYS, "", ("scenario", "hosts"))
        self.scenario = inventory["scenario"]
        self.domain = inventory.get("domain", 0)
        self.unit = inventory.get("unit", "")
        self.log = inventory.get("log", "runs/lab.mcap")
        self.clock = words(inventory.get("clock", []), "clock")
        self.discovery = inventory.get("discovery", "multicast")
        self.hosts = [HostEntry(entry, f"hosts[{i}].") for i, entry in enumerate(inventory["hosts"])]
        self.servers = [host for host in self.hosts if host.has_discovery_server]
        self.check_values()
        self.check_services()

    def check_values(self):
        if not 0 <= self.domain <= HIGHEST_DOMAIN:
            raise InventoryError(f"domain: is {self.domain}; expected 0 to {HIGHEST_DOMAIN}")
        if self.unit and not UNIT.fullmatch(self.unit):
            raise InventoryError(f"unit: is {json.dumps(self.unit)}; expected letters, digits, _, - and ., at most 64")
        if self.discovery not in ("multicast", "peers", "server"):
            raise InventoryError(f"discovery: is '{self.discovery}'; expected multicast, peers or server")
        no_control_characters(self.scenario, "scenario")
        no_control_characters(self.log, "log")
        log = pathlib.PurePosixPath(self.log)
        if log.is_absolute() or ".." in log.parts or not log.name:
            raise InventoryError(f"log: is '{self.log}'; expected a file's path below the logger's folder")
        for host in self.hosts:
            host.must_suit_systemd(self.log, "log")
            host.must_suit_systemd(self.scenario, "scenario")

    def check_services(self):
        if (self.discovery == "server") != (len(self.servers) == 1):
            raise InventoryError("hosts: one of them has \"discovery_server\": true exactly when discovery is server")
        names = [service for host in self.hosts for service in host.services]
        for single in ("trajectory-server", "truth-logger"):
            if names.count((single, "0")) != 1:
                raise InventoryError(f"hosts: {names.count((single, '0'))} run {single}; expected one")
        if len(set(names)) != len(names):
            raise InventoryError("hosts: a service is named twice")

    def check_sensors(self, scenario, sensors):
        """There is one service for each of the scenario's sensors (their numbers by kind), and none besides."""
        expected = {(name, number) for name, kind in SERVICES.items() for number in sensors.get(kind, ())}
        for i, host in enumerate(self.hosts):
            for j, (name, sensor) in enumerate(host.services):
                if SERVICES[name] and (name, sensor) not in expected:
                    numbers = sensors.get(SERVICES[name])
                    raise InventoryError(f"hosts[{i}].services[{j}]: is '{name}:{sensor}'; {scenario} has "
                                         + (f"no {SERVICES[name]} {sensor}, its numbers are {', '.join(numbers)}"
                                            if numbers else f"no {SERVICES[name]}"))
        named = {service for host in self.hosts for service in host.services}
        for name, sensor in sorted(expected - named):
            raise InventoryError(f"hosts: none runs {name}:{sensor}, for which the set would wait: {scenario} has "
                                 f"{SERVICES[name]} {sensor}")
