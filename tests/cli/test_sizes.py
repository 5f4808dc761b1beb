"""Sizes without sense are refused with an estimate, before memory is taken or anything is written; memory that runs out during
a run ends it with a message."""
import json
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import time
import unittest

from support import CommandLineTest, glass_point, impact, overrides, plane_strain, program, size_of, told

megabyte = 1 << 20


def limited_to(bytes_of_memory):
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (bytes_of_memory, bytes_of_memory))


def admits_limits():
    """Sanitizers reserve more address space than any limit admits."""
    return subprocess.run([program, "--version"], preexec_fn=limited_to(1 << 30), stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode == 0


implicit = {"integrator__method": '"arkode-implicit"', "time__end": 2e-8, "output__every": 2e-8}


class AbsurdSizes(CommandLineTest):
    def refused(self, command, *arguments, scene=impact, **options):
        begun = time.monotonic()
        where = ("--out", self.folder / "out") if command == "run" else ()
        answer = self.vitrum(command, scene, *where, *arguments, status=2, **options)
        self.assertLess(time.monotonic() - begun, 30.0)
        self.assertEqual((answer.stdout, list(self.folder.iterdir())), ("", []))
        self.assertRegex(told(answer.stderr)[-1], "^error: ")
        return answer.stderr

    def test_memory(self):
        for changes, particles in (({"space__cell": 1e-9}, "2e+14"), ({"space__cell": 1e-7, "body__0__particles_per_cell": 16}, "1.7e+11"),
                                   ({"body__1__box__max": "[1000, 1000]"}, "1e+12")):
            for command in ("check", "run"):
                with self.subTest(changes=changes, command=command):
                    message = self.refused(command, *overrides(**changes))
                    self.assertRegex(message, r"error: (--set 1|\S+impact\.toml:\d+:\d+): key 'space\.cell': found cells of \S+ m, with which the "
                                     rf"scene has {re.escape(particles)} particles .* takes \S+ [TP]B of memory; "
                                     r"available are \S+ [MG]B; expected larger cells")

    def test_memory_of_factors(self):
        message = self.refused("check", *overrides(space__cell=1e-5, **implicit))
        self.assertRegex(message, r"takes \S+ GB of memory, \S+ GB of it for a factorised matrix; .*preconditioner = \"diagonal\"")

    def test_where_particles_cannot_be_counted(self):
        far = overrides(**{"body.2.disk.centre": "[0, 1e30]"})
        self.assertRegex(self.refused("check", *far, scene=plane_strain),
                         r"error: \S+\.toml:\d+:\d+: key 'body\.2\.disk': body 'far': its shape reaches 1e\+30 m .* expected less than 2e\+06 m")
        none = overrides(**{"body.1.disk.radius": 1e-9})
        self.assertRegex(self.refused("check", *none, scene=plane_strain),
                         r"error: \S+\.toml:\d+:\d+: key 'body\.1\.disk': body 'disk': its shape is smaller than a quarter of a particle")

    def test_time(self):
        for command in ("check", "run"):
            message = self.refused(command, *overrides(integrator__step=2.1e-17))
            self.assertRegex(message, r"error: --set 1: key 'integrator\.step': found 9\.52e\+11 steps of 200 particles, which take about 1\.51 years "
                             r"on 1 thread .*; expected less than a year")
        self.assertRegex(self.refused("check", *overrides(integrator__method='"arkode-explicit"', space__cell=1e-4, time__end=1e4)),
                         r"key 'space\.cell': found at least \S+ steps of 20000 particles, which take about \S+ years")
        long = self.vitrum("check", impact, *overrides(integrator__step=1e-14))
        self.assertRegex(long.stderr, r"warning: \S+impact\.toml:\d+:\d+: key 'time\.end': 2e\+09 steps of 200 particles take about 1\.16 days")
        self.assertNotIn("days", self.vitrum("check", impact).stderr)

    def test_disk_space(self):
        message = self.refused("run", *overrides(output__every=1e-15))
        self.assertRegex(message, r"error: --set 1: key 'output\.every': found 2e\+10 outputs, whose files take \S+ [TP]B; available in \S+ are ")
        self.vitrum("run", impact, "--out", self.folder / "out", "--quiet")

    def test_files(self):
        for text, reason in (("#" * (17 * megabyte), "found more than 16 MB"), ("a." * 100000 + "a = 1", "found a key of more than 64 parts"),
                             ("x = " + "[" * 100000, "exceeded maximum nested value depth")):
            scene = self.folder / "scene.toml"
            scene.write_text(text)
            for command in ("check", "run", "point"):
                self.assertRegex(self.vitrum(command, scene, status=2).stderr, f"^error: .*{reason}")
        self.assertIn("found more than 16 MB", self.vitrum("check", "/dev/zero", status=2).stderr)

    def test_polygons(self):
        corners = ", ".join(f"[0.01, {0.02 + 1e-6 * k}]" for k in range(10001))
        scene = self.folder / "scene.toml"
        scene.write_text(impact.read_text().replace("box = {min = [0.0, 0.006], max = [0.005, 0.026]}", f"polygon = [{corners}]"))
        self.assertRegex(self.vitrum("check", scene, status=2).stderr,
                         r":\d+:\d+: key 'body\.1\.polygon': found a list of 10001, expected at most 10000 vertices")

    def test_points(self):
        times = ", ".join(str(k) for k in range(202))
        strains = ", ".join("[0, 0, 0, 0]" for _ in range(202))
        self.assertRegex(self.refused("point", *overrides(path__time=f"[{times}]", path__strain=f"[{strains}]", path__samples=1000000),
                                      scene=glass_point), r"key 'path\.samples': found 2\.01e\+08 rows .*, expected at most 1e\+08")


class Estimates(CommandLineTest):
    def test_check_tells(self):
        facts = json.loads(self.vitrum("check", impact, "--json").stdout)
        self.assertEqual((facts["least_steps"], facts["threads"]), (1000, 1))
        self.assertAlmostEqual(facts["seconds"], 1000 * 200 / facts["particle_steps_a_second"])
        of_outputs = [json.loads(self.vitrum("check", impact, *overrides(output__every=every), "--json").stdout)["output_seconds"]
                      for every in (1e-6, 1e-8)]
        self.assertAlmostEqual(of_outputs[1] / of_outputs[0], 91, delta=5)
        self.assertTrue(2e-3 < of_outputs[0] / 22 < 2e-2, of_outputs)
        self.assertGreater(facts["memory_available"], facts["memory_bytes"])
        text = self.vitrum("check", impact).stdout
        self.assertRegex(text, r"# 200 particles; a run takes about \S+ kB of memory \(\S+ [MG]B available\) and \S+ MB of disk space")
        self.assertRegex(text, r"# about 0\.05 s on 1 thread, at 4e\+06 particle-steps a second and thread")

    def test_disk_space(self):
        for scene, arguments in ((impact, []), (impact, overrides(space__cell=5e-4, integrator__step=1e-8)), (plane_strain, []),
                                 (impact, overrides(output__history_every=1e-8)),
                                 (impact, overrides(output__every=1e-7, output__checkpoint_every=1e-5))):
            estimate = json.loads(self.vitrum("check", scene, "--json", *arguments).stdout)["disk_bytes"]
            out = self.run_scene("out", "--quiet", "--force", *arguments, scene=scene)
            checkpoint = out / "checkpoint.h5"  # there are two while it is renewed
            taken = size_of(out) - (out / "energy.csv").stat().st_size + (checkpoint.stat().st_size if checkpoint.exists() else 0)
            with self.subTest(scene=scene.name, arguments=arguments, estimate=estimate, taken=taken):
                self.assertTrue(0.6 * taken < estimate < 3.0 * taken)

    @unittest.skipUnless(admits_limits(), "a sanitizer's memory is its own")
    def test_memory(self):
        """Peak memory of runs that end soon, without that of a run of next to no particles."""
        base = self.peak(*overrides(time__end=2e-8, output__every=2e-8))
        large = "[0.2, 0.2]"
        runs = [{"body__0__box__max": large, "body__0__particles_per_cell": 4}, {"body__0__box__max": "[0.4, 0.2]"},
                {"body__0__box__max": large, "space__shape_functions": '"bspline2"', "output__checkpoint_every": 2e-8},
                {"body__0__box__max": large, "integrator__method": '"arkode-explicit"', "integrator__order": 2},
                {"body__0__box__max": large, "integrator__method": '"arkode-explicit"', "integrator__order": 5},
                {"body__0__box__max": "[0.05, 0.04]", "space__shape_functions": '"bspline2"', **implicit},
                {"body__0__box__max": "[0.1, 0.1]", **implicit}, {"body__0__box__max": "[0.5, 0.02]", **implicit},
                {"body__0__box__max": "[0.2, 0.2]", **implicit},
                {"body__0__box__max": "[0.1, 0.1]", "integrator__linear_solver": '"gmres"', "integrator__preconditioner": '"diagonal"', **implicit}]
        for changes in runs:
            top = float(changes["body__0__box__max"].split(",")[1].rstrip("]")) + 1e-3
            arguments = overrides(**{"time__end": 2e-8, "output__every": 2e-8, "body__1__box": f"{{min = [0, {top}], max = [0.005, {top + 0.02}]}}",
                                     "boundary__0__box__min": "[5, -1]", "boundary__0__box__max": "[6, 1]", **changes})
            estimate = json.loads(self.vitrum("check", impact, "--json", *arguments).stdout)["memory_bytes"]
            taken = self.peak(*arguments) - base
            with self.subTest(changes=changes, estimate=estimate / megabyte, taken=taken / megabyte):
                self.assertTrue(0.85 * taken < estimate < 2.5 * taken)

    def peak(self, *arguments):
        """Peak resident memory of a run, bytes."""
        # Through a small process: the peak of one that forks is handed on to what it becomes.
        starter = ("import os, sys\n"
                   "child = os.fork() or os.execv(sys.argv[1], sys.argv[1:])\n"
                   "_, status, usage = os.wait4(child, 0)\n"
                   "print(status, usage.ru_maxrss)")
        done = subprocess.run([sys.executable, "-S", "-c", starter, program, "run", impact, "--out", self.folder / "peak", "--force", "--quiet",
                               "--threads", "1", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        status, kilobytes = map(int, done.stdout.split())
        self.assertEqual(status, 0)
        return kilobytes * 1024


@unittest.skipUnless(admits_limits(), "a sanitizer's memory is its own")
class Limits(CommandLineTest):
    def test_a_scene_beyond_the_limit_is_refused(self):
        scene = overrides(space__cell=2e-5)  # 5e5 particles, 300 MB
        answer = self.vitrum("run", impact, *scene, "--threads", 1, status=2, preexec_fn=limited_to(250 * megabyte))
        self.assertRegex(answer.stderr, r"key 'space\.cell'.* particles .* takes \S+ MB of memory; available are \S+ MB")

    def test_threads_that_cannot_be_had(self):
        answer = self.vitrum("run", impact, "--threads", 1024, status=3, preexec_fn=limited_to(1 << 30))
        self.assertRegex(answer.stderr, r"error: 1024 threads cannot be started: .*; ask for fewer \(--threads\)")

    def test_memory_that_is_taken_away(self):
        """The limit falls to what the process has at some moment (after its first outputs: it is the loader that dies of want
        before); what it asks for after that, it does not get."""
        chance = random.Random(3)
        methods = ({}, {"integrator__method": '"arkode-explicit"'}, {"integrator__method": '"arkode-implicit"'}, {"constitutive__method": '"cvode"'})
        ended = []
        for trial in range(16):
            arguments = overrides(**{"space__cell": 4e-4, "time__end": 4e-6, "integrator__step": 5e-9, "output__every": 1e-7,
                                     "output__checkpoint_every": 1e-6, **methods[trial % len(methods)]})
            process = self.start("run", impact, "--out", f"out{trial}", "--threads", 2, *arguments)
            while not (self.folder / f"out{trial}" / "steps" / "00002.h5").exists() and process.poll() is None:
                time.sleep(0.01)
            time.sleep(0.2 * chance.random())
            try:
                used = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[0]) * resource.getpagesize()
                resource.prlimit(process.pid, resource.RLIMIT_AS, (used + 4096 * chance.randrange(200), resource.RLIM_INFINITY))
            except (ProcessLookupError, ValueError, IndexError):
                pass  # it has ended
            message = process.stderr.read()
            with self.subTest(trial=trial, message=message[-300:]):
                self.assertIn(process.wait(timeout=120), (0, 3, 4))
                if process.returncode != 0:
                    self.assertRegex(message, r"(?m)^error: .")
                out = self.folder / f"out{trial}"
                if (out / "result.h5").exists():
                    self.vitrum("info", out / "result.h5")
            ended.append(process.returncode)
        self.assertIn(3, ended, "the limit never mattered")


if __name__ == "__main__":
    unittest.main()
