"""One realisation, from its task to its files.

Nothing is imported here: a job loads only the part that it runs.
"""
