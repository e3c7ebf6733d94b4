"""Checks every given summary against the schema, and that the schema rejects a summary with a mistake."""

import copy
import json
import sys
from pathlib import Path

from jsonschema import Draft7Validator

schema = json.loads(Path(sys.argv[1]).read_text())
Draft7Validator.check_schema(schema)
validator = Draft7Validator(schema)
for path in sys.argv[2:]:
    summary = json.loads(Path(path).read_text())
    for error in validator.iter_errors(summary):
        sys.exit(f"{path}: {error.json_path}: {error.message}")
    for damage in [
        lambda s: s.pop("steps"),
        lambda s: s.update(more=1),
        lambda s: s["steps"][0].update(force="1 N"),
        lambda s: s["steps"][0]["certificate"].pop("satisfied"),
        lambda s: s["case"]["indenter"].update(kind="needle"),
        lambda s: s["case"]["load"].update(force=1.0, penetration=1.0),
    ]:
        damaged = copy.deepcopy(summary)
        damage(damaged)
        assert not validator.is_valid(damaged), path
