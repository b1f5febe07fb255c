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
        threading.Thread(target=self.keep_lines, daemon=True).start()

    def keep_lines(self):
        for line in self.process.stdout:
            self.said.put(line.rstrip())

    def lines(self):
        lines = []
        while not self.said.empty():
            lines.append(self.said.get())
        return lines

    def code(self):
        return self.process.poll()

    def end(self):
        if self.process and self.process.poll() is None:
            self.process.terminate()
            self.process.wait()
