"""Energy, force and consistent tangent of a strain sampling, element by element."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

# What a kernel calls stands in it (`forceinline`): as a function of its own it is linked twice,
# optimised otherwise, and the process that compiles it has other last bits than all later ones.


class Tables(NamedTuple):
    """A strain sampling as arrays.

    Attributes
    ----------
    weights : ndarray, shape (positions, 9, 5)
        Of the nine control points in the vectors a_1, a_2, a_11, a_22, a_12.
    needs : ndarray of int, shape (positions,)
        How many of these vectors a position needs.
    component, position : ndarray of int, shape (membrane samples,)
    pairs : ndarray of int, shape (pairs, 4)
        Two membrane samples, the coefficient of the law that couples them, the energy it counts to.
    pair_weight : ndarray, shape (pairs,)
    bending_position : ndarray of int, shape (bending samples,)
    bending_weight : ndarray, shape (bending samples,)
    fold : float
        See `StrainSampling`.
    """

    weights: np.ndarray
    needs: np.ndarray
    component: np.ndarray
    position: np.ndarray
    pairs: np.ndarray
    pair_weight: np.ndarray
    bending_position: np.ndarray
    bending_weight: np.ndarray
    fold: float


@njit(cache=True, error_model="numpy", fastmath=True, forceinline=True)
def _gather(x, j, i, columns, nodes):
    for node in range(9):
        column = (i + node % 3) % columns
        for c in range(3):
            nodes[node, c] = x[c, j + node // 3, column]


@njit(cache=True, error_model="numpy", fastmath=True, forceinline=True)
def _vectors(nodes, weights, needs, a):
    for p in range(weights.shape[0]):
        for q in range(5):
            for c in range(3):
                a[p, q, c] = 0.0
        for node in range(9):
            for q in range(needs[p]):
                w = weights[p, node, q]
                for c in range(3):
                    a[p, q, c] += w * nodes[node, c]


@njit(cache=True, error_model="numpy", fastmath=True, forceinline=True)
def _membrane_samples(a, component, position, out):
    for s in range(component.size):
        v = a[position[s]]
        k = component[s]
        first = 0 if k != 1 else 1
        second = 0 if k == 0 else 1
        total = 0.0
        for c in range(3):
            total += v[first, c] * v[second, c]
        out[s] = total if k == 2 else 0.5 * total


@njit(cache=True, error_model="numpy", fastmath=True)
def reference_samples(x, n_around, tables):
    """Samples of the stress-free shape, shape (elements along, around, membrane + 4 bending).

    Membrane a_11 / 2, a_22 / 2 or a_12; bending b_11, b_22, 2 b_12 and the length of a_1 x a_2.
    """
    weights, needs = tables.weights, tables.needs
    component, position = tables.component, tables.position
    bending_position = tables.bending_position
    n_along, columns = x.shape[1] - 2, x.shape[2]
    m, n = component.size, bending_position.size
    out = np.empty((n_along, n_around, m + 4 * n))
    nodes = np.empty((9, 3))
    a = np.empty((weights.shape[0], 5, 3))
    for j in range(n_along):
        for i in range(n_around):
            _gather(x, j, i, columns, nodes)
            _vectors(nodes, weights, needs, a)
            _membrane_samples(a, component, position, out[j, i])
            for s in range(n):
                v = a[bending_position[s]]
                normal = np.cross(v[0], v[1])
                area = np.sqrt(np.sum(normal * normal))
                for k in range(3):
                    out[j, i, m + 4 * s + k] = (
                        np.sum(v[2 + k] * normal) / area * (2.0 if k == 2 else 1.0)
                    )
                out[j, i, m + 4 * s + 3] = area
    return out


@njit(cache=True, error_model="numpy", fastmath=True)
def force(x, n_around, law, bend, ref, tables, out):
    """Parts of the energy, J, as `ElementKernel.force` returns them; writes the force to `out`."""
    weights, needs, component, position, pairs, pair_weight = tables[:6]
    bending_position, bending_weight, fold = tables[6:]
    n_along, columns = x.shape[1] - 2, x.shape[2]
    m, n = component.size, bending_position.size
    nodes = np.empty((9, 3))
    a = np.empty((weights.shape[0], 5, 3))
    g = np.empty((weights.shape[0], 5, 3))
    e = np.empty(m)
    stress = np.empty(m)
    energy = np.zeros(3)
    out[:] = 0.0
    for j in range(n_along):
        for i in range(n_around):
            _gather(x, j, i, columns, nodes)
            _vectors(nodes, weights, needs, a)
            _membrane_samples(a, component, position, e)
            for s in range(m):
                e[s] -= ref[j, i, s]
                stress[s] = 0.0
            for t in range(pairs.shape[0]):
                first, second = pairs[t, 0], pairs[t, 1]
                h = pair_weight[t] * law[j, pairs[t, 2], i]
                stress[first] += h * e[second]
                if first != second:
                    stress[second] += h * e[first]
                    energy[pairs[t, 3]] += h * e[first] * e[second]
                else:
                    energy[pairs[t, 3]] += 0.5 * h * e[first] * e[first]
            c = law[j, :, i]
            g[:] = 0.0
            for s in range(m):
                p = position[s]
                k = component[s]
                for d in range(3):
                    if k == 0:
                        g[p, 0, d] += stress[s] * a[p, 0, d]
                    elif k == 1:
                        g[p, 1, d] += stress[s] * a[p, 1, d]
                    else:
                        g[p, 0, d] += stress[s] * a[p, 1, d]
                        g[p, 1, d] += stress[s] * a[p, 0, d]
            for s in range(n):
                p = bending_position[s]
                v = a[p]
                nx = v[0, 1] * v[1, 2] - v[0, 2] * v[1, 1]
                ny = v[0, 2] * v[1, 0] - v[0, 0] * v[1, 2]
                nz = v[0, 0] * v[1, 1] - v[0, 1] * v[1, 0]
                area = np.sqrt(nx * nx + ny * ny + nz * nz)
                first = ref[j, i, m + 4 * s + 3]
                sigma = ((1 - fold) + fold * first / area) / area
                dsigma = -((1 - fold) + 2 * fold * first / area) / area**2
                t1 = v[2, 0] * nx + v[2, 1] * ny + v[2, 2] * nz
                t2 = v[3, 0] * nx + v[3, 1] * ny + v[3, 2] * nz
                t6 = 2 * (v[4, 0] * nx + v[4, 1] * ny + v[4, 2] * nz)
                k1 = ref[j, i, m + 4 * s] - sigma * t1
                k2 = ref[j, i, m + 4 * s + 1] - sigma * t2
                k6 = ref[j, i, m + 4 * s + 2] - sigma * t6
                w = bend * bending_weight[s]
                m1 = w * (c[0] * k1 + c[2] * k2 + c[3] * k6)
                m2 = w * (c[2] * k1 + c[1] * k2 + c[4] * k6)
                m6 = w * (c[3] * k1 + c[4] * k2 + c[5] * k6)
                energy[1] += 0.5 * (m1 * k1 + m2 * k2 + m6 * k6)
                # E = .. - sigma(J) P.N with P = sum of moment times second derivative
                px = m1 * v[2, 0] + m2 * v[3, 0] + 2 * m6 * v[4, 0]
                py = m1 * v[2, 1] + m2 * v[3, 1] + 2 * m6 * v[4, 1]
                pz = m1 * v[2, 2] + m2 * v[3, 2] + 2 * m6 * v[4, 2]
                total = m1 * t1 + m2 * t2 + m6 * t6
                f = dsigma * total / area
                # derivative with respect to N
                qx = -(sigma * px + f * nx)
                qy = -(sigma * py + f * ny)
                qz = -(sigma * pz + f * nz)
                g[p, 0, 0] += v[1, 1] * qz - v[1, 2] * qy
                g[p, 0, 1] += v[1, 2] * qx - v[1, 0] * qz
                g[p, 0, 2] += v[1, 0] * qy - v[1, 1] * qx
                g[p, 1, 0] += qy * v[0, 2] - qz * v[0, 1]
                g[p, 1, 1] += qz * v[0, 0] - qx * v[0, 2]
                g[p, 1, 2] += qx * v[0, 1] - qy * v[0, 0]
                s1, s2, s6 = -sigma * m1, -sigma * m2, -2 * sigma * m6
                g[p, 2, 0] += s1 * nx
                g[p, 2, 1] += s1 * ny
                g[p, 2, 2] += s1 * nz
                g[p, 3, 0] += s2 * nx
                g[p, 3, 1] += s2 * ny
                g[p, 3, 2] += s2 * nz
                g[p, 4, 0] += s6 * nx
                g[p, 4, 1] += s6 * ny
                g[p, 4, 2] += s6 * nz
            for node in range(9):
                f0 = 0.0
                f1 = 0.0
                f2 = 0.0
                for p in range(weights.shape[0]):
                    for q in range(needs[p]):
                        w = weights[p, node, q]
                        f0 += w * g[p, q, 0]
                        f1 += w * g[p, q, 1]
                        f2 += w * g[p, q, 2]
                column = (i + node % 3) % columns
                out[0, j + node // 3, column] += f0
                out[1, j + node // 3, column] += f1
                out[2, j + node // 3, column] += f2
    return energy


@njit(cache=True, error_model="numpy", fastmath=True, forceinline=True)
def _bending_hessian(v, c, bend, ref4, fold, stressed, grad, hess):
    """Gradients (3, 15) of the bending strains, and the stress part of the Hessian (15, 15)."""
    normal = np.cross(v[0], v[1])
    area = np.sqrt(np.sum(normal * normal))
    first = ref4[3]
    sigma = ((1 - fold) + fold * first / area) / area
    d1 = -((1 - fold) + 2 * fold * first / area) / area**2
    d2 = (2 * (1 - fold) + 6 * fold * first / area) / area**3
    unit = normal / area
    # derivative of N: rows component, columns (a_1, a_2)
    dn = np.zeros((3, 6))
    for e in range(3):
        f, h = (e + 1) % 3, (e + 2) % 3
        # N_e = a1_f a2_h - a1_h a2_f
        dn[e, f] += v[1, h]
        dn[e, h] -= v[1, f]
        dn[e, 3 + h] += v[0, f]
        dn[e, 3 + f] -= v[0, h]
    gj = dn.T @ unit
    kappa = np.empty(3)
    for k in range(3):
        factor = 2.0 if k == 2 else 1.0
        t = factor * np.sum(v[2 + k] * normal)
        gt = factor * (dn.T @ v[2 + k])
        kappa[k] = ref4[k] - sigma * t
        for r in range(15):
            grad[k, r] = 0.0
        for r in range(6):
            grad[k, r] = -(sigma * gt[r] + t * d1 * gj[r])
        for e in range(3):
            grad[k, 6 + 3 * k + e] = -factor * sigma * normal[e]
    hess[:] = 0.0
    if not stressed:
        return
    mom = np.empty(3)
    mom[0] = bend * (c[0] * kappa[0] + c[2] * kappa[1] + c[3] * kappa[2])
    mom[1] = bend * (c[2] * kappa[0] + c[1] * kappa[1] + c[4] * kappa[2])
    mom[2] = bend * (c[3] * kappa[0] + c[4] * kappa[1] + c[5] * kappa[2])
    big = mom[0] * v[2] + mom[1] * v[3] + 2 * mom[2] * v[4]
    total = np.sum(big * normal)
    gt = dn.T @ big
    # Hessian of J on (a_1, a_2): (dN^T dN - gJ gJ^T)/J + unit . d2N ; same d2N for P . N
    hj = (dn.T @ dn - np.outer(gj, gj)) / area
    ht = np.zeros((6, 6))
    for e in range(3):
        f, h = (e + 1) % 3, (e + 2) % 3
        hj[f, 3 + h] += unit[e]
        hj[3 + h, f] += unit[e]
        hj[h, 3 + f] -= unit[e]
        hj[3 + f, h] -= unit[e]
        ht[f, 3 + h] += big[e]
        ht[3 + h, f] += big[e]
        ht[h, 3 + f] -= big[e]
        ht[3 + f, h] -= big[e]
    for r in range(6):
        for q in range(6):
            hess[r, q] -= (
                sigma * ht[r, q]
                + d1 * (gt[r] * gj[q] + gj[r] * gt[q])
                + total * (d2 * gj[r] * gj[q] + d1 * hj[r, q])
            )
    for k in range(3):
        factor = (2.0 if k == 2 else 1.0) * mom[k]
        for e in range(3):
            for q in range(6):
                value = factor * (sigma * dn[e, q] + d1 * gj[q] * normal[e])
                hess[6 + 3 * k + e, q] -= value
                hess[q, 6 + 3 * k + e] -= value


@njit(cache=True, error_model="numpy", fastmath=True)
def assemble(x, n_around, law, bend, ref, tables, stressed):
    """Blocks of the tangent, shape (rows, columns, 5, 5, 3, 3): control point, neighbour."""
    weights, needs, component, position, pairs, pair_weight = tables[:6]
    bending_position, bending_weight, fold = tables[6:]
    rows, columns = x.shape[1], x.shape[2]
    n_along = rows - 2
    m, n = component.size, bending_position.size
    blocks = np.zeros((rows, columns, 5, 5, 3, 3))
    nodes = np.empty((9, 3))
    a = np.empty((weights.shape[0], 5, 3))
    e = np.empty(m)
    stress = np.empty(m)
    b = np.empty((m, 27))
    full = np.empty((m, m))
    grad = np.empty((3, 15))
    hess = np.empty((15, 15))
    spread = np.empty((15, 27))
    k_el = np.empty((27, 27))
    el = np.empty((3, 3))
    for j in range(n_along):
        for i in range(n_around):
            _gather(x, j, i, columns, nodes)
            _vectors(nodes, weights, needs, a)
            _membrane_samples(a, component, position, e)
            full[:] = 0.0
            for t in range(pairs.shape[0]):
                first, second = pairs[t, 0], pairs[t, 1]
                h = pair_weight[t] * law[j, pairs[t, 2], i]
                full[first, second] += h
                if first != second:
                    full[second, first] += h
            for s in range(m):
                e[s] -= ref[j, i, s]
                p, k = position[s], component[s]
                for node in range(9):
                    w1, w2 = weights[p, node, 0], weights[p, node, 1]
                    for d in range(3):
                        if k == 0:
                            b[s, 3 * node + d] = w1 * a[p, 0, d]
                        elif k == 1:
                            b[s, 3 * node + d] = w2 * a[p, 1, d]
                        else:
                            b[s, 3 * node + d] = w1 * a[p, 1, d] + w2 * a[p, 0, d]
            k_el[:] = b.T @ (full @ b)
            if stressed:
                stress[:] = full @ e
                for s in range(m):
                    p, k = position[s], component[s]
                    for u in range(9):
                        for v in range(9):
                            if k == 0:
                                w = weights[p, u, 0] * weights[p, v, 0]
                            elif k == 1:
                                w = weights[p, u, 1] * weights[p, v, 1]
                            else:
                                w = (
                                    weights[p, u, 0] * weights[p, v, 1]
                                    + weights[p, u, 1] * weights[p, v, 0]
                                )
                            w *= stress[s]
                            for d in range(3):
                                k_el[3 * u + d, 3 * v + d] += w
            c = law[j, :, i]
            el[0, 0], el[1, 1], el[2, 2] = c[0], c[1], c[5]
            el[0, 1] = el[1, 0] = c[2]
            el[0, 2] = el[2, 0] = c[3]
            el[1, 2] = el[2, 1] = c[4]
            for s in range(n):
                p = bending_position[s]
                w = bend * bending_weight[s]
                _bending_hessian(a[p], c, w, ref[j, i, m + 4 * s :], fold, stressed, grad, hess)
                hess += grad.T @ (w * (el @ grad))
                for r in range(15):
                    for node in range(9):
                        for d in range(3):
                            total = 0.0
                            for q in range(5):
                                total += hess[r, 3 * q + d] * weights[p, node, q]
                            spread[r, 3 * node + d] = total
                for node in range(9):
                    for d in range(3):
                        for q in range(5):
                            w = weights[p, node, q]
                            for r in range(27):
                                k_el[3 * node + d, r] += w * spread[3 * q + d, r]
            for node in range(9):
                column = (i + node % 3) % columns
                for other in range(9):
                    block = blocks[
                        j + node // 3, column, other // 3 - node // 3 + 2, other % 3 - node % 3 + 2
                    ]
                    for d in range(3):
                        for f in range(3):
                            block[d, f] += k_el[3 * node + d, 3 * other + f]
    return blocks
