"""What deploy/lab does with an inventory."""

import getpass
import pathlib
import shlex
import socket
import subprocess
import sys
import time

from hosts.follower import FollowerHere
from hosts.host import Host, LabError, State, Stopped, eventually
from hosts.installation import Installation
from hosts.inventory import SERVICES
from hosts.scenario_files import ROOT, ScenarioFiles

DISCOVERY_PORT = 11811
FIRST, LAST = "truth-logger", "trajectory-server"  # who has the logger has the unit; the clock comes when all are there


class Service:
    """One process of the set and where it runs."""

    def __init__(self, host, name, sensor, inventory):
        self.host, self.name, self.sensor = host, name, sensor
        self.tag = f"{name}-{inventory.domain}{'-' + inventory.unit if inventory.unit else ''}-{sensor}"
        self.unit = f"inslab-{name}@{sensor}" if SERVICES.get(name) else f"inslab-{name}"
        self.words = f"{name} {sensor}" if SERVICES.get(name) else name
        self.is_unit = host.systemd and name != "follow"

    def start(self, command, starter):
        return self.host.unit_start(self.unit) if self.is_unit else self.host.start(self.tag, command, starter)

    def state(self):
        if self.is_unit:
            return self.host.unit_state(self.unit)
        states = self.host.states([self.tag])
        return states and states[self.tag]

    def who(self):
        return self.host.unit_who(self.unit) if self.is_unit else self.host.who(self.tag)

    def terminate(self):
        self.host.unit_stop(self.unit) if self.is_unit else self.host.terminate(self.tag)

    def said(self):
        return (self.host.unit_said(self.unit) if self.is_unit else self.host.said(self.tag)).rstrip()


class Lab:
    def __init__(self, inventory):
        self.inventory = inventory
        self.hosts = [Host(entry) for entry in inventory.hosts]
        self.servers = [host for host in self.hosts if host.entry.has_discovery_server]
        self.services = sorted((Service(host, name, sensor, inventory)
                                for host in self.hosts for name, sensor in host.entry.services),
                               key=lambda service: (service.name != FIRST, service.name == LAST))
        self.logger, self.server = self.services[0], self.services[-1]
        self.discovery = [Service(host, "discovery", "0", inventory) for host in self.servers]
        self.follower = Service(self.server.host, "follow", "0", inventory)
        self.started = []
        self.run_id = None
        self.begun = self.ended = False
        self.failure = None
        self.scenario = inventory.scenario  # its place below every host's folder
        self.files = None

    # What is asked of the scenario's files.

    def look_at_scenario(self):
        """For what needs the scenario; one that is running can be stopped without. Throws InventoryError."""
        self.files = ScenarioFiles(self.inventory.scenario)
        self.scenario = self.files.place
        for entry in self.inventory.hosts:
            entry.must_suit_systemd(self.scenario, "scenario")
        self.inventory.check_sensors(self.inventory.scenario, self.files.sensors())
        self.files.must_take_clock(self.inventory.clock)

    def check(self):
        print(f"{self.inventory.path}: good: {len(self.hosts)} hosts, discovery by {self.inventory.discovery}; "
              f"{self.inventory.scenario} and {len(self.files.files) - 1} files that it names")

    # Command lines.

    def network(self, host):
        """The options of a program on this host."""
        options = ["--domain", str(self.inventory.domain), "--interface", host.entry.address]
        if self.inventory.unit:
            options += ["--unit", self.inventory.unit]
        if self.inventory.discovery == "peers":
            for other in self.hosts:
                options += ["--peer", other.entry.address]
        if self.inventory.discovery == "server":
            options += ["--discovery-server", f"{self.servers[0].entry.address}:{DISCOVERY_PORT}"]
        return options

    def command(self, service):
        if service.name == "discovery":
            return ["fast-discovery-server", "-i", "0", "-x", "run/discovery_server.xml"]
        if service.name == "follow":
            return ["build/bin/inslab", "follow", self.scenario, *self.follow_options(), *self.network(service.host)]
        words = [f"build/bin/inslab-{service.name}", "--scenario", self.scenario, *self.network(service.host)]
        if SERVICES[service.name]:
            words += ["--sensor", service.sensor]
        if service.name == "truth-logger":
            words += ["--log", self.inventory.log, "--overwrite"]  # start() has put an earlier log aside
        if service.name == "trajectory-server":
            words += self.clock()
        return words

    def clock(self):
        """The run is held at its start until the one who follows it has sent the swaps and lets it go."""
        return self.inventory.clock + ([] if self.is_paused() else ["--paused"])

    def is_paused(self):
        return "--paused" in self.inventory.clock

    def follow_options(self):
        return [] if self.is_paused() else ["--release"]

    def environment(self, host):
        """What the units take from /etc/inslab/lab.env."""
        arguments = f"--scenario {self.scenario} {shlex.join(self.network(host))}"
        return (f"INSLAB_ARGUMENTS={arguments}\nINSLAB_LOG={self.inventory.log}\n"
                f"INSLAB_CLOCK={shlex.join(self.clock())}\n")

    def install(self):
        Installation(self).install()

    # Starting and stopping.

    def discovery_settings(self, host):
        text = (ROOT / "config/dds/discovery_server.xml").read_text(encoding="utf-8")
        return text.replace(">ADDRESS<", f">{host.entry.address}<").replace(">PORT<", f">{DISCOVERY_PORT}<")

    def log_place(self):
        """Units write below a folder of their own, the only one that they may write to."""
        folder = "/var/lib/inslab" if self.logger.host.systemd else self.logger.host.folder
        return f"{shlex.quote(folder)}/{shlex.quote(self.inventory.log)}"

    def put_earlier_log_aside(self):
        """What is there under the log's name is of an earlier run: it must not be fetched as this one's."""
        log = self.log_place()
        self.logger.host.ask(f"[ ! -e {log} ] || mv {log} {log}.before-$(date -u +%Y%m%dT%H%M%SZ -r {log})")

    def must_be_free(self):
        """Nothing of this domain and unit runs on the hosts, and nobody else writes this log."""
        for service in [*self.services, *self.discovery]:
            if who := service.who():
                raise LabError(f"{service.host.name}: {service.words} runs already: {who}; "
                               "that set goes on, this one is not started")
        host, log = self.logger.host, self.inventory.log
        done = host.ask(host.in_folder(
            f"for file in run/truth-logger-*.pid; do if lives \"$file\" && tr '\\0' '\\n' </proc/$pid/cmdline | "
            f"grep -qxF -e {shlex.quote(log)}; then echo \"process $pid, $(sed -n 2p \"$file\")\"; fi; done"))
        if done.stdout.strip():
            raise LabError(f"{host.name}: {log} is written by another set: {done.stdout.strip()}; name another log")

    def start_one(self, service):
        starter = (f"started by {getpass.getuser()} on {socket.gethostname()} at "
                   f"{time.strftime('%Y-%m-%d %H:%M:%S UTC', time.gmtime())} from {self.inventory.path.resolve()}")
        if why := service.start(self.command(service), starter):
            raise LabError(f"{service.host.name}: {service.words}: {why}")
        self.started.append(service)

    def start_set(self, follow):
        """Starts the services, one after the other; `follow` is called before the one that is the clock."""
        Installation(self).must_be_complete()
        self.must_be_free()
        self.put_earlier_log_aside()
        for service in self.discovery:
            settings = service.host.run(service.host.in_folder("mkdir -p run && cat >run/discovery_server.xml"),
                                        input=self.discovery_settings(service.host), capture_output=True)
            if settings.returncode != 0:
                raise LabError(f"{service.host.name}: {settings.stderr.strip()}")
            self.start_one(service)
        for service in self.services[:-1]:
            self.start_one(service)
        follow()
        self.start_one(self.server)

    def states(self):
        """How the started ones are, in one question to each host."""
        states = {}
        for host in self.hosts:
            mine = [service for service in self.started if service.host is host]
            plain = [service.tag for service in mine if not service.is_unit]
            answers = host.states(plain) if plain else {}
            for service in mine:
                state = service.state() if service.is_unit else answers and answers[service.tag]
                states[service] = state or State(True, answers=False)
        return states

    def stop_started(self):
        """In order: the server first, whom the others follow, the logger last of them."""
        order = sorted(self.started, key=lambda service: (service.name in ("discovery",), service.name == FIRST,
                                                          service.name not in (LAST, "follow")))
        patience_s = {LAST: 15.0, FIRST: 15.0}
        for service in order:
            service.terminate()
            if service.name in patience_s:
                eventually(lambda one=service: not (one.state() or State(False)).running, patience_s[service.name])
        left = []
        eventually(lambda: not left_running(self.states(), left), 10.0)
        return [f"{service.host.name}: {service.words} was stopped and is still {self.states()[service].words()}"
                for service in left]

    def stop(self):
        self.started = [*self.discovery, *self.services, self.follower]
        problems = self.stop_started()
        if problems:
            raise LabError("; ".join(problems))

    def status(self):
        self.started = list(self.services)
        for service, state in self.states().items():
            print(f"{service.host.name:<12} {service.host.entry.address:<16} {service.name:<18} {service.sensor:>2}  "
                  f"{state.words()}")

    # A run from its start to its log.

    def start(self):
        try:
            self.start_set(lambda: self.start_one(self.follower))
            self.wait_for_begin(lambda: self.hear(self.follower.said().splitlines()))
        except BaseException:
            self.give_up()
            raise
        print(f"run {self.run_id} goes on")

    def hear(self, lines):
        for line in lines:
            if line.startswith("run "):
                self.run_id = line.split()[1]
            self.begun = self.begun or line == "begins"
            self.ended = self.ended or line == "ends"

    def listen_to(self, follower):
        over = follower.code() is not None  # asked first: its last words come before its end
        self.hear(follower.lines())
        if over and not self.begun:
            raise LabError("nobody follows the run, which would wait for ever")

    def wait_for_begin(self, listen):
        """A service that ends before the run begins ends the attempt: the barrier will not open without it."""
        while True:
            listen()
            if self.begun:
                return
            for service, state in self.states().items():
                if not state.running:
                    listen()
                    if self.begun:  # a short run may be over already
                        return
                    raise LabError(f"{service.host.name}: {service.words} {state.words()} before the run began")
            time.sleep(0.2)

    def give_up(self):
        for service in self.started:
            if said := service.said():
                print(f"---- {service.host.name}: {service.words}\n{said}", flush=True)
        self.stop_started()

    def run(self):
        follower = FollowerHere(self)
        try:
            self.start_set(follower.start)
            self.wait_for_begin(lambda: self.listen_to(follower))
        except BaseException:
            self.give_up()
            follower.end()
            raise
        try:
            self.wait_for_end(follower)
        except (Stopped, KeyboardInterrupt):
            self.fail("stopped by a signal")
        finally:
            problems = self.stop_started()
            follower.end()
        for problem in problems:
            self.fail(problem)
        for service in self.services:
            print(f"---- {service.host.name}: {service.words}\n{service.said()}", flush=True)
        return self.judge(self.fetch())

    def wait_for_end(self, follower):
        """Until the logger has ended: it ends last, with the log closed."""
        left = {}  # who has ended in order while the run went on, and since when
        alone_since = None
        while True:
            states = self.states()
            self.hear(follower.lines())
            now = time.monotonic()
            over = self.ended or follower.code() is not None or not states[self.server].running
            for service, state in states.items():
                # At the end everybody goes, some before the end is heard here.
                if not state.running and (state.code or (not over and now - left.setdefault(service, now) > 3.0)):
                    self.fail(f"{service.host.name}: {service.words} {state.words()}{'' if over else ' in mid-run'}")
            if not states[self.logger].running:
                break
            alone_since = alone_since or (now if over else None)
            if over and now - alone_since > 30.0:
                print("lab: the run has ended and the logger goes on: it is told to stop", file=sys.stderr)
                break
            time.sleep(0.3)
        if eventually(lambda: follower.code() is not None, 5.0) and follower.code() != 0:
            self.fail("the run was not followed to its end")

    def fail(self, why):
        """What went wrong first is the reason of the rest."""
        self.failure = self.failure or why

    def fetch(self):
        pathlib.Path("runs").mkdir(exist_ok=True)
        stem = f"runs/lab-{time.strftime('%Y%m%dT%H%M%SZ', time.gmtime())}"
        for number in range(1000):
            here = pathlib.Path(f"{stem}{f'-{number}' if number else ''}.mcap")
            try:
                file = here.open("xb")
                break
            except FileExistsError:
                continue
        with file:
            done = self.logger.host.run(f"cat {self.log_place()}", stdin=subprocess.DEVNULL, stdout=file,
                                        stderr=subprocess.PIPE)
        if done.returncode != 0 or here.stat().st_size == 0:
            here.unlink()
            raise LabError(f"{self.logger.host.name}: there is no log {self.inventory.log}: "
                           f"{done.stderr.strip() or 'it is empty'}" + (f"; {self.failure}" if self.failure else ""))
        return here

    def judge(self, log):
        failure = ["--failure", self.failure] if self.failure else []
        sys.stdout.flush()
        return subprocess.run([ROOT / "build/bin/inslab", "judge", log, "--run", self.run_id, *failure],
                              check=False).returncode


def left_running(states, left):
    left[:] = [service for service, state in states.items() if state.running]
    return left
