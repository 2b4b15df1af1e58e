"""Provenance: what result files say of their origin."""

import re
from datetime import datetime

from foilstudy.base.provenance import git_commit, package_versions, provenance


def test_attributes_are_text_and_complete():
    attributes = provenance()
    assert set(attributes) == {"git_commit", "package_versions", "created", "machine"}
    assert all(isinstance(value, str) and value for value in attributes.values())
    assert datetime.fromisoformat(attributes["created"]).utcoffset().total_seconds() == 0


def test_versions_name_the_package_and_its_numerics():
    assert re.search(r"foilstudy \d.*, numpy \d.*, scipy \d.*, numba \d", package_versions())


def test_commit_is_a_hash_or_unknown():
    assert re.fullmatch(r"unknown|[0-9a-f]{40}(-dirty)?", git_commit())
