"""What the side studies share: names of cases, records with their costs, tables and figures.

A study is data (`plan`); `files` measures its cases and writes what comes of them, and
``workflow/rules/studies.smk`` makes the jobs. docs/studies.md shows how to add one.
"""
