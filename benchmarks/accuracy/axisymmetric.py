# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball pressed deep into a cylinder of soft tissue, in FEniCS' dolfinx: axisymmetric, quadratic
triangles with full integration, an exact Newton method and the same contact penalty as a scene's, but
integrated over the surface instead of summed over samples. It shares nothing with palpate but the
formulas. Run as a program of its own, because it brings MPI:

    python3 -m accuracy.axisymmetric JOB.json

The job is read from and the answer written to the file: {"law", "young_modulus", "poisson_ratio",
"ball", "depth", "radius", "height", "edge", "fine", "growth", "steps", "stiffness", "smoothing"}."""

import json
import subprocess
import sys

from .solve import Failed
from .taylor_hood import PACKAGE, available  # noqa: F401  (for a case's NEEDS)


def solve(file, **job):
    """The answer of a job: {"forces": [N], "depths": [m], ...} for each step; `file` keeps it.
    @throws Failed with what the program said."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(job))
    done = subprocess.run([sys.executable, "-m", "accuracy.axisymmetric", str(file)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise Failed("dolfinx: " + done.stdout.strip()[-600:])
    return json.loads(file.read_text())


def axis(fine, edge, growth, end):
    """Coordinates from 0 to `end`: steps of `edge` as far as `fine`, then growing by `growth` a unit
    of distance, stretched to end there."""
    import numpy as np
    near = np.linspace(0.0, fine, max(1, round(fine / edge)) + 1)
    far = [0.0]
    while far[-1] < end - fine:
        far.append(far[-1] + edge + growth * far[-1])
    return np.concatenate([near, fine + np.array(far[1:]) * ((end - fine) / far[-1])])


def _energy(law, mu, kappa, F):
    """[J/m^3], as in docs/theory.md."""
    import ufl
    J, I1 = ufl.det(F), ufl.tr(F.T * F)
    if law == "neo_hookean":
        return mu / 2 * (J ** (-2 / 3) * I1 - 3) + kappa / 2 * (J - 1) ** 2
    if law == "stable_neo_hookean":
        return mu / 2 * (I1 - 3) - mu * (J - 1) + (kappa + mu / 3) / 2 * (J - 1) ** 2
    raise ValueError(f"no law {law}")


class _Body:
    """The tissue's half plane r >= 0, z <= 0 with the ball's contact; unknown: quadratic u(r, z)."""

    def __init__(self, job):
        import numpy as np
        import ufl
        from dolfinx import fem, mesh
        from mpi4py import MPI
        from petsc4py import PETSc

        r = axis(job["fine"], job["edge"], job["growth"], job["radius"])
        z = -axis(job["fine"], job["edge"], job["growth"], job["height"])
        points = np.stack(np.meshgrid(r, z, indexing="ij"), -1).reshape(-1, 2)
        n, i, j = len(z), *np.meshgrid(np.arange(len(r) - 1), np.arange(len(z) - 1), indexing="ij")
        a = (i * n + j).ravel()  # the diagonal runs from the axis outwards and down, as the tissue shears
        cells = np.vstack([np.stack([a, a + n, a + n + 1], 1), np.stack([a, a + n + 1, a + 1], 1)])
        self.mesh = mesh.create_mesh(MPI.COMM_SELF, cells, points,
                                     ufl.Mesh(ufl.VectorElement("Lagrange", "triangle", 1)))
        self.space = fem.VectorFunctionSpace(self.mesh, ("Lagrange", 2))
        self.u = fem.Function(self.space)
        self.height = fem.Constant(self.mesh, PETSc.ScalarType(0.0))  # of the ball's centre [m]
        young, poisson = job["young_modulus"], job["poisson_ratio"]
        mu, kappa = young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson))
        x, u = ufl.SpatialCoordinate(self.mesh), self.u
        g = ufl.grad(u)
        F = ufl.as_matrix([[1 + g[0, 0], g[0, 1], 0], [g[1, 0], 1 + g[1, 1], 0], [0, 0, 1 + u[0] / x[0]]])
        inside = _energy(job["law"], mu, kappa, F) * 2 * ufl.pi * x[0] * ufl.dx(metadata={"quadrature_degree": 6})
        self.height_z = ufl.variable(self.height)
        contact = self._contact(job, x + u) * 2 * ufl.pi * x[0] * ufl.ds(metadata={"quadrature_degree": 12})
        total = inside + contact
        test, trial = ufl.TestFunction(self.space), ufl.TrialFunction(self.space)
        residual = ufl.derivative(total, u, test)
        self.energy = fem.form(total)
        self.residual = fem.form(residual)
        self.tangent = fem.form(ufl.derivative(residual, u, trial))
        # What the ball feels: minus the change of the energy with its height.
        self.force = fem.form(-ufl.diff(self._contact(job, x + u), self.height_z) * 2 * ufl.pi * x[0]
                              * ufl.ds(metadata={"quadrature_degree": 12}))
        self.min_jacobian_of = ufl.det(F)
        self.held = self._held(job)

    def _contact(self, job, place):
        """The scene's penalty [J/m^2], docs/theory.md; the ball's middle is at (0, height)."""
        import ufl
        k, e, ball = job["stiffness"], job["smoothing"], job["ball"]
        p = ball - ufl.sqrt(place[0] ** 2 + (place[1] - self.height_z) ** 2)
        soft = ufl.conditional(ufl.lt(p, e), p ** 3 / (6 * e), p * (p - e) / 2 + e * e / 6)
        return ufl.conditional(ufl.gt(p, 0), k * (soft + p ** 2 / 5 * (8 * p / ball) ** 3), 0 * p)

    def _held(self, job):
        """Unknowns of the ground, and the radial ones of the axis."""
        import numpy as np
        x = self.space.tabulate_dof_coordinates()
        ground, middle = x[:, 1] < -job["height"] + 1e-9, x[:, 0] < 1e-12
        return np.unique(np.concatenate([2 * np.flatnonzero(ground), 2 * np.flatnonzero(ground) + 1,
                                         2 * np.flatnonzero(middle)]))

    def system(self):
        """Residual and tangent with unit rows where the body is held."""
        import scipy.sparse
        from dolfinx import fem
        vector, A = fem.petsc.assemble_vector(self.residual), fem.petsc.assemble_matrix(self.tangent)
        A.assemble()
        b, (indptr, indices, data) = vector.array.copy(), A.getValuesCSR()
        vector.destroy()  # else PETSc keeps them
        A.destroy()
        b[self.held] = 0.0
        free = scipy.sparse.identity(len(b), format="lil")
        free[self.held, self.held] = 0.0
        free = free.tocsr()
        K = scipy.sparse.csr_matrix((data, indices, indptr), shape=(len(b),) * 2)
        return b, (free @ K @ free + scipy.sparse.identity(len(b)) - free).tocsc()

    def value(self, of):
        from dolfinx import fem
        return fem.assemble_scalar(of)


def _downhill(b, K):
    """Newton's direction; where the tangent is not positive definite, of one with more on its diagonal."""
    import scipy.sparse
    from scipy.sparse.linalg import splu
    more = 0.0
    while True:
        d = -splu(K + more * scipy.sparse.diags(abs(K.diagonal())) if more else K).solve(b)
        if b @ d < 0.0:
            return d
        more = 10 * more or 1e-3


def _newton(body, tolerance=1e-9, most=100):
    """Newton's method with halved steps where the energy would rise. @throws RuntimeError"""
    import numpy as np
    scale = None
    for iteration in range(most):
        b, K = body.system()
        norm = np.linalg.norm(b)
        scale = norm if scale is None else max(scale, norm)
        if norm <= tolerance * scale:
            return iteration
        d = _downhill(b, K)
        start, before, size = body.u.x.array.copy(), body.value(body.energy), 1.0
        while True:
            body.u.x.array[:] = start + size * d
            after = body.value(body.energy)
            # Where differences of the energy are rounding, the step stands.
            if np.isfinite(after) and after <= before + 1e-4 * size * (b @ d) + 1e-11 * abs(before):
                break
            size /= 2
            if size < 1e-6:
                raise RuntimeError(f"no way down at a residual of {norm:.2g}")
    raise RuntimeError("Newton's iteration has not converged")


def _press(body, ball, reached, further, answer):
    """Lowers the ball by `further` [m], or where that fails by a half, a quarter ... of it; what it did."""
    before = body.u.x.array.copy()
    for _ in range(8):
        body.height.value = ball - (reached + further)
        try:
            answer["iterations"] += _newton(body)
            return further
        except RuntimeError as error:
            body.u.x.array[:], failure = before, error
            further /= 2
    raise failure


def _run(job):
    body = _Body(job)
    answer = {"dofs": len(body.u.x.array), "depths": [], "forces": [], "iterations": 0}
    reached = 0.0
    for step in range(1, job["steps"] + 1):
        depth = job["depth"] * step / job["steps"]
        while reached < depth:
            reached += _press(body, job["ball"], reached, depth - reached, answer)
        answer["depths"].append(depth)
        answer["forces"].append(float(body.value(body.force)))
    return answer


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as job_file:
        result = _run(json.load(job_file))
    with open(sys.argv[1], "w", encoding="utf-8") as job_file:
        json.dump(result, job_file)
