"""Reference page and JSON schema of the configuration, generated from the model."""

from __future__ import annotations

import json
from typing import Any

from foilstudy.model.materials import MATERIALS

from .accuracy import ACCURACIES, STANDARD
from .model import StudyConfig
from .sections import CONSTANTS

__all__ = ["reference_page", "schema_text"]

_HEAD = """\
# Study configuration

<!-- Generated from the model by `python -m foilstudy.config`; edits are overwritten. -->

One YAML file describes a study. Units stand in the key names. Only `sweep` is required; every
other key has a default; the defaults are the published case, on a mesh that resolves it. An
unknown key, a number outside its range or an impossible combination stops the study before any job
starts, with one sentence that names the key and the remedy. `schema.json` lets an editor complete
and check the files.

| file | study |
|---|---|
| `config.yaml` | small default study: three thicknesses, three heights, a few minutes |
| `thesis.yaml` | the whole published study: 4 thicknesses, 5 heights, 6 realisations |
| `resolved.yaml` | the published case on meshes that resolve it, 130 to 500 um |
| `resolved_thin.yaml` | the same of 50 um, 28 to 47 minutes of a core for a crumple |
| `resolved_slow.yaml` | `resolved.yaml` in a ramp three times slower, for what that changes |
| `real_resolved.yaml` | the whole model on these meshes, 250 and 500 um |
| `real_resolved_thin.yaml` | the same of 130 um, half an hour of a core for a realisation |
| `tiny.yaml` | coarse and short, to test the workflow; its numbers mean nothing |

`accuracy.yaml`, `limits.yaml`, `real.yaml`, `tradeoff.yaml` and `truth.yaml` say what side
studies crumple (`snakemake -j2 real`, docs/studies.md), and are no configurations of a study.

## Minimal example

```yaml
study:
  name: my-foil
sweep:
  thickness_um: [130, 250]
  overlength_percent: [15, 30, 60]
  realisations: 3
```
"""

_RULES = """\
## Rules that span keys

- `sweep.reference_height_mm` or `sweep.overlength_percent`, not both; heights above
  `sheet.gap_height_mm`; no value twice (values are told apart to three decimals).
- Thickness at most 1/20 of the radius, where thin-shell theory ends.
- At least 24 elements around the cylinder and 8 along the shortest one, at most a million in all.
- `dynamics.shown_min_hz` below `dynamics.shown_max_hz`, and that not above `dynamics.cutoff_hz`;
  `cutoff_hz` only with a modal reduction, `rayleigh_hz` only with Rayleigh damping.

- Heights of at most 10 m, also where an overlength makes them; at most 20,000 realisations.

Numbers follow YAML 1.2 (`1e-6` is a number, `010` is ten), and a key given twice is an error.
Files are UTF-8, of at most 64 kB. Several files (`--configfile A B`) are laid over each other key
by key, and words such as `--config accuracy=quick "sweep={realisations: 2}"` over them all.
`foilstudy check` names what is refused, and what is possible but most likely a slip of unit or
size.
"""


def schema_text() -> str:
    """JSON schema of the configuration files."""
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    schema |= StudyConfig.model_json_schema()
    return json.dumps(schema, indent=2) + "\n"


def reference_page() -> str:
    """Reference page of the configuration in Markdown."""
    schema = StudyConfig.model_json_schema()
    parts = [_HEAD]
    for name, entry in schema["properties"].items():
        if name == "accuracy":
            parts.append(_accuracy_table(entry))
            continue
        section = schema["$defs"][entry["$ref"].rpartition("/")[2]]
        parts.append(_section_table(name, section))
        if name == "installation":
            parts.append(_section_table("installation.moves[]", schema["$defs"]["RingMove"]))
        if name == "report":
            parts.append(_section_table("report.measured[]", schema["$defs"]["MeasuredRun"]))
        if name == "material":
            parts.append(_materials_table())
    parts.append(_RULES)
    return "\n".join(parts)


def _section_table(name: str, section: dict[str, Any]) -> str:
    lines = [
        f"## `{name}`\n",
        section["description"] + "\n",
        "| key | unit | default | range | meaning |",
        "|---|---|---|---|---|",
    ]
    required = section.get("required", ())
    for key, entry in section["properties"].items():
        if name == "material" and key in CONSTANTS:
            default = "by name"
        elif key in required:
            default = "required"
        elif f"{name}.{key}" in STANDARD.values:
            default = "by `accuracy`"
        else:
            default = _code(entry.get("default"))
        lines.append(
            f"| `{key}` | {entry['unit']} | {default} | {_range(entry)} | {entry['description']} |"
        )
    return "\n".join(lines) + "\n"


def _accuracy_table(entry: dict[str, Any]) -> str:
    """What each word stands for, one column a tier."""
    names = [f"`{name}`" for name in ACCURACIES]
    lines = [
        "## `accuracy`\n",
        f"{entry['description']} Left out, it is `{entry['default']}`.\n",
        f"| key | {' | '.join(names)} |",
        f"|---|{'---|' * len(names)}",
    ]
    for path in STANDARD.values:
        values = " | ".join(f"{tier.values[path]:g}" for tier in ACCURACIES.values())
        lines.append(f"| `{path}` | {values} |")
    return "\n".join(lines) + "\n"


def _code(value: Any) -> str:
    if value is None:
        return "-"
    return f"`{value:g}`" if isinstance(value, float) else f"`{value}`"


def _range(entry: dict[str, Any]) -> str:
    entry = next((kind for kind in entry.get("anyOf", ()) if kind["type"] != "null"), entry)
    entry = entry.get("items", entry)
    if "enum" in entry or "const" in entry:
        return ", ".join(f"`{choice}`" for choice in entry.get("enum", [entry.get("const")]))
    signs = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
    bounds = [f"{sign} {entry[key]:,g}" for key, sign in signs.items() if key in entry]
    if not bounds and "maxLength" in entry:
        bounds = [f"up to {entry['maxLength']} characters"]
    return " and ".join(bounds) or "-"


def _materials_table() -> str:
    lines = [
        "### Known materials\n",
        "Room-temperature values; measured constants of your own foil are always better.\n",
        "| name | E (MPa) | Poisson's ratio | density (kg/m3) | yield (MPa) | what | source |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, material in MATERIALS.items():
        constants = " | ".join(f"{getattr(material, key):.7g}" for key in CONSTANTS)
        lines.append(f"| `{name}` | {constants} | {material.description} | {material.source} |")
    return "\n".join(lines) + "\n"
