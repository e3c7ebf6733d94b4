"""Checks cases against the schema of a case, as editors read it: drafts 4 and 7.

Arguments: the schema, the number of right cases, the right cases, and cases with a mistake.
"""

import json
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft4Validator, Draft7Validator

schema = json.loads(Path(sys.argv[1]).read_text())
right, paths = int(sys.argv[2]), sys.argv[3:]
for draft in [Draft4Validator, Draft7Validator]:
    draft.check_schema(schema)
    validator = draft(schema)
    for number, path in enumerate(paths):
        case = tomllib.loads(Path(path).read_text())
        is_valid = validator.is_valid(case)
        if is_valid != (number < right):
            errors = [f"{error.json_path}: {error.message}" for error in validator.iter_errors(case)]
            sys.exit(f"{path}: valid: {is_valid} {errors} {case}")
