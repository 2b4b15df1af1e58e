"""Records of a side study as its jobs would leave them, of made-up results."""

from pathlib import Path

from foilstudy.base.costs import Cost
from foilstudy.study.kernel.files import needed_records, read_record, write_record
from foilstudy.study.kernel.plan import Record, case_name


def write_results(study, results, folder):
    """Write what ``results[PART][CASE]`` holds into a folder; returns it."""
    found = {part.name: {} for part in study.parts}
    for part in study.parts:
        for case in part.cases:
            path = Path(folder, part.files(case_name(case))[0])
            record = Record(part.name, case, results[part.name][case], Cost())
            write_record(study, record, path, needed_records(part, case, found))
            found[part.name][case] = read_record(study, path)
    return folder
