"""Paths: blanks, letters beyond ASCII, ends of lines, great lengths, links."""
import json
import os
import shutil
import subprocess
import unittest

from support import CommandLineTest, glass_point, here, impact, overrides, program, read_summary, told


class Places(CommandLineTest):
    def test_blanks_and_letters(self):
        folder = self.folder / "größe und Länge 長さ"
        folder.mkdir()
        scene, point = folder / "Scheibe Ü.toml", folder / "Punkt 'é'.toml"
        shutil.copy(impact, scene)
        shutil.copy(glass_point, point)
        for language in ("C", "C.UTF-8"):
            environment = {**os.environ, "LC_ALL": language}
            out = folder / f"Ergebnis {language}"
            self.vitrum("run", scene, "--out", out, *overrides(title='"Prüfung 長さ"'), env=environment)
            self.assertEqual(read_summary(out)["status"], "complete")
            self.assertIn(str(scene), read_summary(out)["provenance"]["command"])
            self.assertIn("Prüfung 長さ", self.vitrum("info", out, env=environment).stdout)
            self.vitrum("point", point, "--out", folder / "Kurve é.csv", env=environment)
            self.assertTrue((folder / "Kurve é.csv").exists())
        self.assertRegex(self.vitrum("check", folder / "fehlt.toml", status=2).stderr, "größe und Länge 長さ/fehlt")

    def test_bytes_that_are_no_text(self):
        scene = bytes(self.folder) + b"/scene \xff\xfe.toml"
        shutil.copy(impact, scene)
        done = subprocess.run([program, "run", scene, "--out", self.folder / "out"], capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(read_summary(self.folder / "out")["status"], "complete")

    def test_ends_of_lines_and_quotes(self):
        """Messages keep to a line each, and what they tell to type can be typed."""
        folder = self.folder / "two\nlines 'and' \"quotes\" $HOME `date` \\"
        folder.mkdir()
        scene = folder / "a\nscene.toml"
        shutil.copy(impact, scene)
        out = folder / "out\there"
        self.vitrum("run", scene, "--out", out)
        self.assertIn("two", self.vitrum("info", out).stdout)
        self.assertEqual(json.loads(self.vitrum("info", out, "--json").stdout)["file"], str(out / "result.h5"))
        command = read_summary(out)["provenance"]["command"]
        typed = subprocess.run(["bash", "-c", f"printf '%s\\0' {command}"], capture_output=True, check=True).stdout
        self.assertEqual(typed.decode().split("\0")[1:-1], ["run", str(scene), "--out", str(out)])
        for status, arguments in ((2, ["run", scene, "--out", out]), (4, ["run", scene, "--out", out, "--resume"]),
                                  (2, ["check", folder / "missing"]), (4, ["run", scene, "--out", scene / "out"]),
                                  (3, ["run", scene, "--out", out, "--force", *overrides(integrator__step=3e-7)])):
            answer = self.vitrum(*arguments, "--quiet" if arguments[0] == "run" else "--json", status=status)
            errors = [line for line in told(answer.stderr) if not line.startswith("warning: ")]
            self.assertEqual(len(errors), 1, errors)
            self.assertTrue(errors[0].startswith("error: "))

    def test_long_names(self):
        longest = "n" * 250
        scene = self.folder / f"{longest}.toml"
        shutil.copy(impact, scene)
        self.vitrum("run", scene, "--quiet")
        self.assertEqual(read_summary(self.folder / "out" / longest)["status"], "complete")
        deep = self.folder
        while len(str(deep)) < 3500:
            deep /= longest
        self.vitrum("run", scene, "--out", deep, "--quiet")
        self.assertEqual(self.vitrum("info", deep).returncode, 0)
        for out in (self.folder / (longest + longest), deep / longest / longest / longest):
            answer = self.vitrum("run", scene, "--out", out, "--quiet", status=4)
            self.assertIn("cannot be made: File name too long", answer.stderr)

    def test_links_and_relative_paths(self):
        plain = self.run_scene("plain")
        (self.folder / "link.toml").symlink_to(impact)
        (self.folder / "elsewhere").mkdir()
        (self.folder / "to").symlink_to("elsewhere")
        (self.folder / "nowhere").symlink_to("missing")
        for out in ("new/and/deep/./down/../out", "./to", "to/deeper/", "../" + self.folder.name + "/sideways"):
            with self.subTest(out=out):
                self.vitrum("run", "link.toml", "--out", out, "--quiet")
                self.assert_same_results(self.folder / out, plain)
        self.assertTrue((self.folder / "elsewhere" / "summary.json").exists())
        self.assertIn("nowhere", self.vitrum("run", "link.toml", "--out", "nowhere", "--quiet", status=4).stderr)
        self.vitrum("run", "link.toml", "--quiet")
        self.assertTrue((self.folder / "out" / "link" / "summary.json").exists())

    def test_malformed_scene_elsewhere(self):
        answer = self.vitrum("check", os.path.relpath(here / "malformed" / "unknown_key.toml", self.folder), status=2)
        self.assertIn("unknown_key.toml:", answer.stderr)


if __name__ == "__main__":
    unittest.main()
