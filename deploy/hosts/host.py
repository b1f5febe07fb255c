"""A host of the set: commands that run there, and the processes that the set has there."""

import shlex
import subprocess
import time

# A process is known by its id, the clock tick of its start and the boot that both are of: a file that outlived its
# process must not get a stranger killed who has the id now. The second line says in words who started it.
SHELL = r"""
start_of() { sed 's/.*) //' "/proc/$1/stat" 2>/dev/null | cut -d' ' -f1,20; }
note() {
  { echo "$1 $(start_of "$1" | cut -d' ' -f2) $(cat /proc/sys/kernel/random/boot_id)"; echo "$3"; } >"$2.new"
  mv "$2.new" "$2"
}
lives() {
  pid= ticks= boot=
  { read -r pid ticks boot; } 2>/dev/null <"$1"
  [ -n "$boot" ] && [ "$boot" = "$(cat /proc/sys/kernel/random/boot_id)" ] || return 1
  case "$(start_of "$pid")" in "Z "*) return 1 ;; *" $ticks") return 0 ;; *) return 1 ;; esac
}
"""


class LabError(Exception):
    """What went wrong on the hosts."""


class Stopped(Exception):
    """A signal."""


class State:
    """How a process of the set is; `code` is its exit code where one is known. One whose host does not answer is taken
    to run: a link may be down for a while."""

    def __init__(self, running, code=None, answers=True):
        self.running, self.code, self.answers = running, code, answers

    def words(self):
        if self.running:
            return "running" if self.answers else "not known: the host does not answer"
        if self.code is None:
            return "not running"
        return f"ended by signal {self.code - 128}" if self.code > 128 else f"ended with exit code {self.code}"


class Host:
    def __init__(self, entry):
        self.entry = entry
        self.name, self.folder, self.systemd = entry.name, entry.folder, entry.systemd
        self.started_s = None  # the host's own clock when something was started there

    def words(self, command):
        """The words that run a shell command there."""
        reach = self.entry.reach
        # ssh hands one string to a shell of its own; other ways of reaching take the words as they are.
        return [*reach, shlex.join(["sh", "-c", command])] if reach[:1] == ["ssh"] else [*reach, "sh", "-c", command]

    def run(self, command, **options):
        return subprocess.run(self.words(command), text=True, check=False, **options)

    def ask(self, command):
        return self.run(command, stdin=subprocess.DEVNULL, capture_output=True)

    def in_folder(self, command):
        return f"cd {shlex.quote(self.folder)} && {{ {SHELL}\n{command}\n}}"

    # Plain processes leave in the folder's run/ what they are (.pid), what they say (.out), how they ended (.code).

    def start(self, tag, command, starter):
        """Starts a command in the folder unless the process of that tag runs already. Returns why it did not start."""
        wait = (SHELL + 'who=$1 tag=$2; shift 2; "$@" & pid=$!; note $pid run/$tag.pid "$who"; wait $pid; '
                'echo $? >run/$tag.code')
        pid, out = f"run/{tag}.pid", f"run/{tag}.out"
        done = self.ask(self.in_folder(
            f"mkdir -p run && exec 9>run/lab.lock && flock -w 20 9 || exit 1\n"
            f"if lives {pid}; then echo \"process $pid, $(sed -n 2p {pid})\"; exit 3; fi\n"
            f"rm -f {pid} run/{tag}.code\n"
            f"setsid nohup sh -c {shlex.quote(wait)} sh {shlex.quote(starter)} {tag} {shlex.join(command)} "
            f">{out} 2>&1 </dev/null 9>&- &\n"
            f"for i in $(seq 100); do [ -s {pid} ] && exit 0; sleep 0.05; done\n"
            "echo 'it left no process id' >&2; exit 1"))
        if done.returncode == 0:
            return None
        return f"runs already: {done.stdout.strip()}" if done.returncode == 3 else done.stderr.strip() or "no answer"

    def states(self, tags):
        """How the processes of these tags are, all in one question. None when the host does not answer."""
        done = self.ask(self.in_folder(
            f"for tag in {shlex.join(tags)}; do if lives run/$tag.pid; then echo running; "
            f"else echo \"ended $(cat run/$tag.code 2>/dev/null)\"; fi; done"))
        if done.returncode != 0:
            return None
        answers = [line.split() for line in done.stdout.splitlines()]
        return {tag: State(answer[0] == "running", int(answer[1]) if len(answer) > 1 else None)
                for tag, answer in zip(tags, answers)}

    def who(self, tag):
        """Who runs under this tag, in words; empty when nobody does."""
        return self.ask(self.in_folder(
            f"if lives run/{tag}.pid; then echo \"process $pid, $(sed -n 2p run/{tag}.pid)\"; fi")).stdout.strip()

    def terminate(self, tag):
        self.ask(self.in_folder(f"if lives run/{tag}.pid; then kill -TERM $pid; fi"))

    def said(self, tag, lines=20):
        return self.ask(f"tail -n {lines} {shlex.quote(self.folder)}/run/{tag}.out").stdout

    # What systemd runs. It starts a service that was killed again, so that one between two lives is running too.

    def unit_start(self, unit):
        self.started_s = self.started_s or self.ask("date +%s").stdout.strip()
        done = self.ask(f"systemctl start {unit}")
        return None if done.returncode == 0 else done.stderr.strip() or "no answer"

    def unit_state(self, unit):
        done = self.ask(f"systemctl show -p ActiveState -p ExecMainCode -p ExecMainStatus {unit}")
        if done.returncode != 0:
            return None
        shown = dict(line.split("=", 1) for line in done.stdout.splitlines() if "=" in line)
        if shown.get("ActiveState") not in ("inactive", "failed"):
            return State(True)
        code, status = int(shown.get("ExecMainCode", "0")), int(shown.get("ExecMainStatus", "0"))
        return State(False, None if code == 0 else status if code == 1 else 128 + status)  # 1: it exited by itself

    def unit_who(self, unit):
        state = self.unit_state(unit)
        if state is None or not state.running:
            return ""
        shown = self.ask(f"systemctl show --value -p MainPID -p ActiveEnterTimestamp {unit}").stdout.split("\n")
        return f"unit {unit}, process {shown[0]}, since {shown[1] if len(shown) > 1 else '?'}"

    def unit_stop(self, unit):
        self.ask(f"systemctl stop --no-block {unit}")

    def unit_said(self, unit, lines=20):
        since = f"--since @{self.started_s}" if self.started_s else ""
        return self.ask(f"journalctl --no-pager -n {lines} {since} -u {unit}").stdout


def eventually(condition, patience_s, every_s=0.3):
    deadline = time.monotonic() + patience_s
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(every_s)
    return True
