"""Two threads on a machine whose processors are busy with something else: a run gets its share, and makes use of it."""
import os
import resource
import subprocess
import sys
import time
import unittest

from support import CommandLineTest, impact, program

steps = 1000


class BusyMachine(CommandLineTest):
    in_memory = True

    def setUp(self):
        super().setUp()
        self.processors = len(os.sched_getaffinity(0))
        for _ in range(self.processors):
            loop = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            self.addCleanup(loop.wait)
            self.addCleanup(loop.kill)

    def run_with(self, threads):
        """Seconds, and how often the run has been taken or has given away a processor that it could have used."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_nivcsw
        begun = time.monotonic()
        subprocess.run([program, "run", impact, "--out", self.folder / "out", "--force", "--quiet", "--no-fields",
                        "--threads", str(threads), "--set", "output.every=none"], check=True, stdout=subprocess.DEVNULL, timeout=300)
        return time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN).ru_nivcsw - before

    def test_threads_that_wait_do_not_give_their_time_away(self):
        """They did at every step, and took 4 to 18 times as long as one thread."""
        if self.processors < 2:
            self.skipTest("two threads on one processor have another patience")
        tries = []
        for _ in range(5):  # what else the machine does disturbs one or the other
            alone, (together, given) = self.run_with(1)[0], self.run_with(2)
            tries.append((alone, together, given))
            if together < 2.5 * alone and given < 0.4 * steps:
                return
        self.fail(f"seconds with one thread, with two, switches: {tries}")


if __name__ == "__main__":
    unittest.main()
