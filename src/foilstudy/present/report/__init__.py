"""The study as one self-contained page that answers first, then shows, then proves."""

from foilstudy.present.report.page import write_report

__all__ = ["write_report"]
