"""`[constitutive] method`: the substepper and CVODE in whole runs, in `vitrum point`, and what is left when they fail."""
import json
import math
import unittest

from support import CommandLineTest, glass_point, impact, read_csv, source


class LocalMethods(CommandLineTest):
    reference = source / "studies" / "paper" / "reference.toml"

    def reference_run(self, name, *settings, end="0.0", status=0):
        """The reference case to shortly after its first localisation."""
        arguments = ["--no-fields", "--quiet"]
        for setting in ('integrator.scheme="musl"', "integrator.step=5e-8", f"time.end={end}", *settings):
            arguments += ["--set", setting]
        out = self.run_scene(name, *arguments, scene=self.reference, status=status)
        return out, json.loads((out / "summary.json").read_text())

    def test_point_gives_the_same_with_every_method(self):
        rows = {}
        for method in ("closed-form", "substep", "cvode"):
            out = self.folder / f"{method}.csv"
            self.vitrum("point", glass_point, "--out", out, "--set", f'constitutive.method="{method}"', "--set",
                        "constitutive.rtol=1e-8")
            rows[method] = read_csv(out)
        for method in ("substep", "cvode"):
            for name in ("s_rr", "s_zz", "damage", "decohesion", "dissipated"):
                exact, value = rows["closed-form"][name][-1], rows[method][name][-1]
                self.assertTrue(math.isclose(value, exact, rel_tol=1e-5, abs_tol=1e-12), (method, name, value, exact))

    def test_reference_case_until_failure(self):
        """First localisation within the tolerance of the closed form's, the same bits for any number of threads."""
        _, closed = self.reference_run("closed")
        self.assertEqual(closed["constitutive"]["solves"], 0)
        for method in ("substep", "cvode"):
            setting = f'constitutive.method="{method}"'
            _, one = self.reference_run(method, setting, "constitutive.rtol=1e-5")
            arguments = ["--threads", "3", "--no-fields", "--quiet"]
            for extra in ('integrator.scheme="musl"', "integrator.step=5e-8", "time.end=0.0", setting,
                          "constitutive.rtol=1e-5"):
                arguments += ["--set", extra]
            many = json.loads((self.run_scene(f"{method}-3", *arguments, scene=self.reference) /
                               "summary.json").read_text())
            for key in ("energy", "failure", "bodies", "constitutive"):
                self.assertEqual(one[key], many[key])
            counters = one["constitutive"]
            self.assertEqual(counters["method"], method)
            self.assertGreater(counters["increments_solved"], 0)
            self.assertLess(counters["increments_solved"], 0.05 * counters["evaluations"])
            self.assertEqual(counters["cvode_solves"] > 0, method == "cvode")
            self.assertEqual(counters["failures"], 0)
            self.assertLess(abs(one["energy"]["relative_residual"]), 0.01)
            first, other = one["failure"]["first_localisation"], closed["failure"]["first_localisation"]
            self.assertEqual(first["body"], other["body"])
            self.assertLess(abs(first["time"] - other["time"]), 5e-8)

    def test_a_failed_increment_can_be_replayed(self):
        out, summary = self.reference_run("failed", 'constitutive.method="cvode"', "constitutive.rtol=1e-13",
                                          "constitutive.atol=1e-300", status=3)
        self.assertEqual(summary["status"], "failed")
        self.assertRegex(summary["message"], r"body '\w+', particle \d+ at .* CVODE gave up")
        dump = out / "failed_point.toml"
        self.assertIn(str(dump), summary["message"])
        answer = self.vitrum("point", dump, status=3)
        self.assertIn("CVODE gave up", answer.stderr)
        self.vitrum("point", dump, "--set", "constitutive.rtol=1e-6", "--set", "constitutive.atol=1e-9")
        self.vitrum("point", dump, "--set", 'constitutive.method="closed-form"')

    def test_implicit_stages_with_local_solvers(self):
        """Stages try increments of nothing, and of no time, where planes decohere and steel flows."""
        for method in ("substep", "cvode"):
            with self.subTest(method):
                out = self.run_scene(method, "--no-fields", "--set", 'integrator.method="arkode-implicit"', "--set",
                                     f'constitutive.method="{method}"')
                summary = json.loads((out / "summary.json").read_text())
                self.assertEqual(summary["status"], "complete")
                self.assertGreater(summary["constitutive"]["increments_solved"], 0)
                self.assertGreater(summary["failure"]["localised"], 0)

    def test_state_of_a_point_file_is_checked(self):
        bad = self.folder / "bad.toml"
        bad.write_text(glass_point.read_text() + "\n[state]\ncrack_density = 2.0\n")
        answer = self.vitrum("point", bad, status=2)
        self.assertIn("key 'state.crack_density'", answer.stderr)


if __name__ == "__main__":
    unittest.main()
