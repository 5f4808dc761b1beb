"""Locales: a decimal comma, and one that does not exist. What is read and written does not depend on them."""
import os
import shutil
import subprocess
import unittest

from support import CommandLineTest, glass_point, impact, overrides, preload, preloaded

# 1.234.567,8 in all that this locale writes.
comma_source = """comment_char %
escape_char /
LC_NUMERIC
decimal_point ","
thousands_sep "."
grouping 3;3
END LC_NUMERIC
"""
ascii_source = "\n".join(["<code_set_name> ANSI_X3.4-1968", "<comment_char> %", "<escape_char> /", "CHARMAP",
                          *(f"<U{code:04X}> /x{code:02x}" for code in range(128)), "END CHARMAP", ""])


def without_memory(text):
    """What the machine has left of memory differs from call to call."""
    return "\n".join(line for line in text.splitlines() if "memory" not in line)


class Locales(CommandLineTest):
    def comma(self):
        """An environment with a locale of our own: the system need not have any."""
        if shutil.which("localedef") is None:
            self.skipTest("no localedef")
        (self.folder / "comma").write_text(comma_source)
        (self.folder / "ascii").write_text(ascii_source)
        made = subprocess.run(["localedef", "-c", "-f", "./ascii", "-i", "./comma", "./xx_XX"], cwd=self.folder, capture_output=True, text=True)
        self.assertTrue((self.folder / "xx_XX" / "LC_NUMERIC").exists(), made.stderr)
        # The C library does not free what it makes of LOCPATH.
        return {"LOCPATH": str(self.folder), "LC_ALL": "xx_XX", "LANG": "xx_XX", "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=0"}

    def answers(self, name, environment):
        """All that the program writes under a locale, as texts."""
        out = self.folder / name
        run = self.vitrum("run", impact, "--out", out, env=environment)
        texts = {file: (out / file).read_text() for file in ("energy.csv", "result.xdmf", "steps/00003.xmf")}
        for command in (["check", impact], ["check", impact, "--json"], ["point", glass_point], ["compare", "OUT", "OUT"], ["reference"]):
            answer = self.vitrum(*(out if argument == "OUT" else argument for argument in command), env=environment)
            texts[str(command)] = without_memory(answer.stdout.replace(str(out), "OUT") + answer.stderr)
        texts["progress"] = run.stderr
        texts["bad number"] = self.vitrum("check", impact, "--set", "space.cell=1,5", status=2, env=environment).stderr
        texts["--set"] = without_memory(self.vitrum("check", impact, "--set", "material.glass.young=72000000000.125", env=environment).stdout)
        return out, texts

    def assert_same_answers(self, found, expected):
        for name, text in expected.items():
            for line, wanted in zip(found[name].splitlines(), text.splitlines()):  # a whole text takes ages to compare
                self.assertEqual(line, wanted, name)
            self.assertEqual(len(found[name]), len(text), name)

    @unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
    def test_decimal_comma(self):
        """The program does not ask for the locale of its environment; were a library to do so, nothing would change."""
        plain, expected = self.answers("plain", {**os.environ, "LC_ALL": "C"})
        environment = self.comma()
        for name, locale in (("not asked", {**os.environ, **environment}), ("asked", preloaded(LOCALE_FOR_ALL=1, **environment))):
            with self.subTest(name):
                comma, found = self.answers(name, locale)
                self.assert_same_results(comma, plain)
                self.assert_same_answers(found, expected)

    @unittest.skipIf(preload is None, "VITRUM_PRELOAD is not set")
    def test_resumed_under_another_locale(self):
        environment = preloaded(LOCALE_FOR_ALL=1, **self.comma())
        settings = overrides(output__checkpoint_every=4e-6)
        whole, out = self.run_scene("whole", *settings), self.folder / "out"
        self.vitrum("run", impact, "--out", out, *settings, env=environment)
        self.vitrum("run", impact, "--out", out, *settings, "--resume")
        self.assert_same_results(out, whole)
        self.vitrum("run", impact, "--out", out, *settings, "--resume", env=environment)
        self.assert_same_results(out, whole)

    def test_unknown_locale(self):
        plain, expected = self.answers("plain", {**os.environ, "LC_ALL": "C"})
        unknown, found = self.answers("unknown", {**os.environ, "LC_ALL": "zz_ZZ.UTF-8", "LANG": "nothing", "LC_NUMERIC": ""})
        self.assert_same_results(unknown, plain)
        self.assert_same_answers(found, expected)


if __name__ == "__main__":
    unittest.main()
