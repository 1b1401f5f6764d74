#!/usr/bin/env python3
"""Checks the scene schema against JSON Schema's own meta-schema, and scenes against the schema, with the `jsonschema` package.

    python3 scene_schema.py SCHEMA.json SCENE.toml...       prints how many scenes fit; exit status 1 at the first that does not
"""
import json
import sys
import tomllib

from jsonschema import Draft202012Validator

schema = json.load(open(sys.argv[1]))
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
for path in sys.argv[2:]:
    with open(path, "rb") as file:
        faults = [f"{path}: {'.'.join(map(str, e.path))}: {e.message}" for e in validator.iter_errors(tomllib.load(file))]
    if faults:
        sys.exit("\n".join(faults))
print(len(sys.argv) - 2)
