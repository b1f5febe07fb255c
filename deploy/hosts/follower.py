"""Whoever goes along with the run from here."""

import queue
import shlex
import subprocess
import threading


class FollowerHere:
    """`inslab follow` on the server's host; its progress is seen as it goes, its lines when they are asked for."""

    def __init__(self, lab):
        self.lab, self.process, self.said = lab, None, queue.Queue()

    def start(self):
        host, command = self.lab.follower.host, shlex.join(self.lab.command(self.lab.follower))
        self.process = subprocess.Popen(host.words(f"cd {shlex.quote(host.folder)} && exec {command}"), text=True,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
        self.reader = threading.Thread(target=self.keep_lines, daemon=True)
        self.reader.start()

    def keep_lines(self):
        for line in self.process.stdout:
            self.said.put(line.rstrip())

    def lines(self):
        lines = []
        while not self.said.empty():
            lines.append(self.said.get())
        return lines

    def code(self):
        """Its exit code once it has ended and all it said is here; None before."""
        return None if self.reader.is_alive() else self.process.poll()

    def end(self):
        if self.process and self.process.poll() is None:
            self.process.terminate()
            self.process.wait()
