# SPDX-FileCopyrightText: 2026 The openmb4 authors
# SPDX-License-Identifier: Apache-2.0
"""docs/scenario.schema.json: the keys of the reader and of the manual; examples fit, mistakes do not.

Usage: cli_schema_test.py MB4SIM EXAMPLES
"""
import copy
import json
import sys
import tomllib
import unittest
from pathlib import Path

from cli import EXAMPLES, MB4SIM, run

ROOT = Path(EXAMPLES).parent
sys.path.insert(0, str(ROOT / "tools"))
import scenario_schema  # noqa: E402

try:
    import jsonschema
except ImportError:
    jsonschema = None

TEXT = (ROOT / scenario_schema.SCHEMA).read_text(encoding="utf-8")
WRONG = ROOT / "tests" / "wrong_scenarios"
# Mistakes of tests/wrong_scenarios that follow from a key or a value alone.
SEEN = (7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 21, 22, 24, 25, 26, 28, 32, 33, 34)


def scenarios(folder):
    """{path: content} of the scenarios below a folder."""
    read = {path: path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.toml"))}
    return {path: tomllib.loads(text) for path, text in read.items() if "[[channel]]" in text}


class Schema(unittest.TestCase):
    def test_reader_manual_and_schema_name_the_same_keys(self):
        text, findings = scenario_schema.made(MB4SIM, ROOT)
        self.assertEqual(findings, [])
        self.assertEqual(text, TEXT, "tools/scenario_schema.py MB4SIM ROOT --write makes it")

    def test_a_key_of_one_of_them_only_is_found(self):
        schema = json.loads(run("schema").stdout)
        manual = (ROOT / scenario_schema.MANUAL).read_text(encoding="utf-8")
        for change, message in (
                (lambda s: s["properties"]["host"]["properties"].pop("sclk_hz"),
                 "sim/README.md: [host] sclk_hz: the reader does not ask for it"),
                (lambda s: s["properties"]["chip"]["properties"].update(speed={"type": "integer"}),
                 "[chip] speed: the reader asks for it, sim/README.md does not name it")):
            changed = copy.deepcopy(schema)
            change(changed)
            self.assertEqual(scenario_schema.describe(changed, manual), [message])

    def test_every_table_is_there(self):
        tables = dict(scenario_schema.tables_of(json.loads(TEXT)))
        self.assertEqual(set(tables), {"", "[master]", "[chip]", "[chip.quirks]", "[host]", "[sim]", "[[channel]]",
                                       "[[channel.event]]", "[[channel.slave]]", "[[channel.slave.resource]]", "[[fault]]"})
        self.assertGreater(sum(len(keys) for keys in tables.values()), 130)

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is not installed")
    def test_every_example_fits(self):
        validator = jsonschema.Draft7Validator(json.loads(TEXT))
        validator.check_schema(json.loads(TEXT))
        found = scenarios(ROOT / "examples")
        self.assertGreater(len(found), 20)
        for path, content in found.items():
            with self.subTest(path):
                self.assertEqual([error.message for error in validator.iter_errors(content)], [])

    @unittest.skipIf(jsonschema is None, "python3-jsonschema is not installed")
    def test_mistakes_do_not_fit_and_what_runs_does(self):
        validator = jsonschema.Draft7Validator(json.loads(TEXT))
        for path in sorted(WRONG.glob("*.toml")):
            number = int(path.name[:2])
            if number > 6 and number not in SEEN:
                continue
            with self.subTest(path.name):
                content = tomllib.loads(path.read_text(encoding="utf-8"))
                self.assertEqual(validator.is_valid(content), number <= 6)


if __name__ == "__main__":
    unittest.main(argv=["cli_schema_test.py"])
