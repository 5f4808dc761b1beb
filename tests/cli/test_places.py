"""Paths with blanks and letters beyond ASCII, and locales."""
import os
import shutil
import subprocess
import unittest

from support import CommandLineTest, glass_point, here, impact, overrides, program, read_summary


def comma_locale():
    """A locale installed here whose decimal sign is a comma, or None."""
    if shutil.which("locale") is None:
        return None
    names = subprocess.run(["locale", "-a"], capture_output=True, text=True, errors="replace").stdout.split()
    for name in names:
        numeric = subprocess.run(["locale", "-k", "decimal_point"], capture_output=True, text=True, errors="replace",
                                 env={"PATH": os.environ["PATH"], "LC_ALL": name}).stdout
        if '","' in numeric:
            return name
    return None


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

    def test_decimal_comma(self):
        language = comma_locale()
        if language is None:
            self.skipTest("no locale with a decimal comma is installed")
        plain, comma = self.run_scene("plain"), self.folder / "comma"
        self.vitrum("run", impact, "--out", comma, env={**os.environ, "LC_ALL": language})
        self.assert_same_results(plain, comma)

    def test_malformed_scene_elsewhere(self):
        answer = self.vitrum("check", os.path.relpath(here / "malformed" / "unknown_key.toml", self.folder), status=2)
        self.assertIn("unknown_key.toml:", answer.stderr)


if __name__ == "__main__":
    unittest.main()
