"""A terminal of any width for the tests: a pseudo-terminal behind the program's standard error."""
import fcntl
import os
import re
import select
import signal
import struct
import subprocess
import termios
import time

from support import program


class Terminal:
    """The program on a terminal; reads what it writes there as it comes."""

    def __init__(self, test, *arguments, columns, **options):
        try:
            self.ours, self.theirs = os.openpty()
        except OSError as error:
            test.skipTest(f"no pseudo-terminals here: {error}")
        test.addCleanup(os.close, self.ours)
        self.shown = ""
        self.resize(columns)
        environment = {name: value for name, value in os.environ.items() if name not in ("NO_COLOR", "TERM")}
        environment |= {"TERM": "xterm", **options.pop("environment", {})}
        self.process = subprocess.Popen([program, *map(str, arguments)], cwd=test.folder, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL, stderr=self.theirs, env=environment, **options)
        os.close(self.theirs)
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.kill)

    def resize(self, columns):
        fcntl.ioctl(self.ours, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))

    def read(self, seconds):
        """What comes within so many seconds; nothing more after the end."""
        piece = ""
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0 and select.select([self.ours], [], [], left)[0]:
            try:
                got = os.read(self.ours, 65536)
            except OSError:  # the other end is closed and all is read
                break
            if not got:
                break
            piece += got.decode()
            deadline = min(deadline, time.monotonic() + 0.05)
        self.shown += piece
        return piece

    def read_until(self, pattern, seconds=60):
        deadline = time.monotonic() + seconds
        begin = len(self.shown)
        while time.monotonic() < deadline and not re.search(pattern, self.shown[begin:]):
            if not self.read(1) and self.process.poll() is not None:
                break
        return self.shown[begin:]

    def resize_while_stopped(self, columns):
        """Between two drawings: all that was drawn before is read."""
        self.process.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, self.process.pid, os.WSTOPPED | os.WNOWAIT)
        while self.read(0.1):
            pass
        self.resize(columns)
        before = len(self.shown)
        self.process.send_signal(signal.SIGCONT)
        return before

    def read_to_end(self):
        while self.read(60):
            pass
        return self.process.wait()


def drawn_part(shown):
    """What is drawn, without the lines before (warnings)."""
    return shown[shown.rfind("\n", 0, shown.index("\033[J")) + 1:]


def drawn_lines(shown):
    """The lines drawn one over the other, without the commands to the terminal."""
    plain = re.sub(r"\033\[[0-9;]*[A-Za-z]", "", shown)
    return [line for line in re.split(r"[\r\n]+", plain) if line]
