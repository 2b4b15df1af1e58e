"""From recordings to a dynamic stiffness: the published procedure and what is better.

`spectra` by overlapping blocks or `periods` averaged in step with the excitation; `channels`
combines sensors into motions and forces; `estimators` make a response of the two; `smoothing`,
`stitching` and `static` finish the published `procedure`; `best_linear`, `subtraction` and
`confidence` are the better way.
"""
