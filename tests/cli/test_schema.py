"""The JSON schemas of `vitrum reference --schema`: what is shipped agrees with them, and what a schema can see is refused."""
import json
import tomllib
import unittest

import jsonschema
from support import CommandLineTest, here, source

# What only the program sees: how values go together, names that another part of the file or SUNDIALS gives, the geometry; and, as JSON
# has neither inf nor nan and calls 4.0 an integer, these.
beyond_a_schema = {
    "beyond_the_axis", "crossing_polygon", "duplicate_body", "end_before_start", "inside_out_box", "inside_out_ring", "missing_material",
    "overlapping_bodies", "peak_below_yield", "peak_never_reached", "poisson_with_damage", "rubble_that_rubs", "rubble_without_strength",
    "rubble_without_surface", "two_plasticity_models", "unknown_butcher_table",
    "unknown_component", "infinite", "not_a_number", "real_for_integer",
}


def documents(*folders):
    """Path and content of every scene and point file."""
    for folder in folders:
        for path in sorted(folder.rglob("*.toml")):
            try:
                yield path, tomllib.loads(path.read_text(errors="replace"))
            except tomllib.TOMLDecodeError:
                continue


class Schema(CommandLineTest):
    def setUp(self):
        super().setUp()
        schemas = [json.loads(self.vitrum("reference", f"--schema{of}").stdout) for of in ("", "=point")]
        for schema in schemas:
            jsonschema.Draft7Validator.check_schema(schema)
        self.scene, self.point = (jsonschema.Draft7Validator(schema) for schema in schemas)

    def faults(self, document):
        validator = self.point if "path" in document else self.scene
        return [f"{'.'.join(map(str, fault.absolute_path))}: {fault.message}" for fault in validator.iter_errors(document)]

    def test_what_is_shipped(self):
        found = 0
        for path, document in documents(here / "scenes", here / "points", source / "studies", source / "examples"):
            if not {"space", "path"} & document.keys():
                continue  # the settings of a study
            with self.subTest(file=path.name):
                self.assertEqual(self.faults(document), [])
                command = "check" if "space" in document else "point"
                if command == "check":  # with every default filled in
                    resolved = self.vitrum("check", path, "--json").stdout
                    self.assertEqual(self.faults(tomllib.loads(json.loads(resolved)["resolved"])), [])
            found += 1
        self.assertGreater(found, 10)

    def test_what_is_malformed(self):
        refused = set()
        for path, document in documents(here / "malformed"):
            with self.subTest(file=path.name):
                self.assertEqual(bool(self.faults(document)), path.stem not in beyond_a_schema)
            refused.add(path.stem)
        self.assertGreaterEqual(refused, beyond_a_schema)
        self.assertGreaterEqual(len(refused - beyond_a_schema), 15)

    def test_every_key_is_explained(self):
        def walk(schema, path):
            for name, key in schema.get("properties", {}).items():
                self.assertTrue(key.get("description"), path + [name])
                for part in (key, key.get("items"), key.get("additionalProperties"), *key.get("anyOf", ())):
                    if isinstance(part, dict):
                        walk(part, path + [name])
                        self.assertIs(part.get("additionalProperties", False) if "properties" in part else False, False)
        for validator in (self.scene, self.point):
            walk(validator.schema, [])
        courant = self.scene.schema["properties"]["integrator"]["properties"]["courant"]
        self.assertEqual((courant["exclusiveMinimum"], courant["default"]), (0, 0.4))


if __name__ == "__main__":
    unittest.main()
