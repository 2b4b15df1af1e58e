"""Sparse basis of what a few local equations leave free."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy import linalg
from scipy.sparse.csgraph import connected_components

_RANK_TOLERANCE = 1e-8


def null_space(equations: sparse.csr_matrix) -> sparse.csr_matrix:
    """Orthonormal basis of A x = 0, as columns; equations may depend on each other.

    It is found by dense singular values in every set of unknowns that equations couple, which for
    supports are a few control points each.
    """
    size = equations.shape[1]
    graph = abs(equations).T @ abs(equations)
    count, label = connected_components(graph, directed=False)
    members = np.argsort(label, kind="stable")
    bounds = np.concatenate([[0], np.cumsum(np.bincount(label, minlength=count))])
    lonely = np.flatnonzero(np.diff(bounds) == 1)
    single = members[bounds[lonely]]
    free = single[np.diff(equations.tocsc().indptr)[single] == 0]
    rows, columns, values = [free], [np.arange(len(free))], [np.ones(len(free))]
    taken = len(free)
    by_column = equations.tocsc()
    for group in np.flatnonzero(np.diff(bounds) > 1):
        unknowns = members[bounds[group] : bounds[group + 1]]
        block = by_column[:, unknowns].tocsr()
        block = block[np.flatnonzero(np.diff(block.indptr))].toarray()
        basis = linalg.null_space(block, rcond=_RANK_TOLERANCE)
        i, j = np.nonzero(basis)
        rows.append(unknowns[i])
        columns.append(taken + j)
        values.append(basis[i, j])
        taken += basis.shape[1]
    entries = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    matrix = sparse.csr_matrix(entries, (size, taken))
    # unknowns in the order of the control points keep the bandwidth of the sheet
    first = np.asarray(matrix.tocsc().indices[matrix.tocsc().indptr[:-1]])
    return matrix[:, np.argsort(first, kind="stable")].tocsr()
