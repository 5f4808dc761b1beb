"""Bodies of pictures, unions and holes, and flaws: what the program says of them and computes with them."""
import json
import shutil
import struct
import unittest
import zlib

import h5py

from support import CommandLineTest, overrides, read_summary, source

paving = source / "examples" / "crazy_paving.toml"


def write_png(path, bits, rows):
    """A picture of grey levels as most programs write it: without a word of gamma."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + b"".join(struct.pack(">H" if bits == 16 else ">B", level) for level in row) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


coarse = overrides(space__cell=4e-3, time__end=6e-6, output__every=3e-6, output__checkpoint_every=3e-6)


class Shapes(CommandLineTest):
    def fields(self, out):
        with h5py.File(out / "result.h5") as result:
            return {f"{step}/{name}": data[()].tobytes() for step in result["steps"]
                    for name, data in result[f"steps/{step}/particles"].items()}

    def test_paving(self):
        """The shipped scene; threads and an interruption change nothing, of the flaws neither."""
        out = self.run_scene("whole", *coarse, "--threads", "1", scene=paving)
        summary, fields = read_summary(out), self.fields(out)
        self.assertEqual(summary["status"], "complete")
        self.assertLess(abs(summary["energy"]["relative_residual"]), 0.05)
        with h5py.File(out / "result.h5") as result:
            factor = result["steps/00000/particles/strength_factor"]
            self.assertEqual(factor.attrs["unit"], "1")
            self.assertIn("strength of the point over that of the law", factor.attrs["description"])
            values = factor[()]
        self.assertGreater(len({v for v in values if v == v}), 100)
        shared = self.run_scene("shared", *coarse, "--threads", "3", scene=paving)
        self.assertEqual(self.fields(shared), fields)
        (out / "summary.json").unlink()
        self.vitrum("run", paving, "--out", out, *coarse, "--resume")
        self.assertEqual(self.fields(out), fields)

    def test_masses(self):
        """What check says of masses: of the pixels, and exact."""
        bodies = json.loads(self.vitrum("check", paving, "--json").stdout)["bodies"]
        for body in bodies.values():
            self.assertAlmostEqual(body["mass"] / body["exact_mass"], 1.0, 7)
        # Stones and mortar fill the picture.
        self.assertAlmostEqual(bodies["stones"]["exact_mass"] / 2500 + bodies["mortar"]["exact_mass"] / 2000, 0.12 * 0.04, 9)

    def test_levels_mean_the_same_in_8_and_16_bits(self):
        scene = self.folder / "levels.toml"
        scene.write_text(paving.read_text().replace("crazy_paving.png", "levels.png"))
        levels = [0, 100, 127, 128, 200, 255]
        for bits, scale in ((8, 1), (16, 257)):
            write_png(self.folder / "levels.png", bits, [[scale * level for level in levels]] * 2)
            with self.subTest(bits=bits):
                bodies = json.loads(self.vitrum("check", scene, "--json").stdout)["bodies"]
                for body, density in (("stones", 2500), ("mortar", 2000)):
                    self.assertAlmostEqual(bodies[body]["exact_mass"] / density, 3 * 2 * 0.02 ** 2, 9)

    def test_messages(self):
        scene = self.folder / "scene.toml"
        shutil.copy(paving, scene)
        line = 1 + next(n for n, text in enumerate(paving.read_text().splitlines()) if text.startswith("image"))
        done = self.vitrum("check", scene, status=2)
        self.assertRegex(done.stderr, rf"scene\.toml:{line}:17: key 'body\.0\.image\.file': found \"crazy_paving\.png\", expected a PNG picture: .*found no such file")
        for setting, words in (
                ("body.0.image.grey=[1, 2]", r"key 'body\.0\.image\.grey': found no pixel of such a level"),
                ("body.0.image.grey=[0, 300]", r"key 'body\.0\.image\.grey.*': found 300, expected a number in \[0, 255\]"),
                ("body.0.image.width=0", r"key 'body\.0\.image\.width': found 0, expected a number > 0"),
                ("body.2.hole.disk.radius=0", r"key 'body\.2\.hole\.disk\.radius': found 0"),
                ("body.1.image.grey=[0, 255]", r"key 'body\.1\.image': found it overlapping body 'stones'"),
                ("material.mortar.scatter={modulus=7, volume=1}", r"key 'material\.mortar\.scatter': found an unknown key"),
                ("material.glass.damage.scatter.modulus=0", r"key 'material\.glass\.damage\.scatter\.modulus': found 0")):
            with self.subTest(setting):
                self.assertRegex(self.vitrum("check", paving, "--set", setting, status=2).stderr, words)


if __name__ == "__main__":
    unittest.main()
