"""The corner of the map that takes minutes."""

from foilstudy.study.limits.plan import LIMITS, study_of

STUDY = study_of("limits_quick", "where methods fail, in short", LIMITS.quick if LIMITS else ())
