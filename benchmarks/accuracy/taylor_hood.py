# SPDX-License-Identifier: GPL-3.0-or-later
"""A second program for nearly incompressible bodies: FEniCS' dolfinx with Taylor-Hood elements
(displacement quadratic, pressure linear). Run as a program of its own, because it brings MPI:

    python3 -m accuracy.taylor_hood JOB.json

The job is read from and the answer written to the file: {"size", "cells", "law", "steps", ...}. The body is
a box of tetrahedra, or with {"panel": {...}} Cook's tapered one of hexahedra."""

import json
import subprocess
import sys

from .solve import Failed

PACKAGE = "python3-dolfinx-real"


def available():
    return subprocess.run([sys.executable, "-c", "import dolfinx"], stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def solve(file, **job):
    """The answer of a job; `file` keeps it. @throws Failed with what the program said."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(job))
    done = subprocess.run([sys.executable, "-m", "accuracy.taylor_hood", str(file)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise Failed("dolfinx: " + done.stdout.strip()[-600:])
    return json.loads(file.read_text())


def _energy(law, F, J):
    """Of the isochoric part [J/m^3]."""
    import ufl
    if law["law"] == "neo_hookean":
        return law["mu"] / 2 * (J ** (-2 / 3) * ufl.tr(F.T * F) - 3)
    # Guccione 1995, fibres along x, of the isochoric Green strain; C/2 (exp Q - 1).
    E = (J ** (-2 / 3) * F.T * F - ufl.Identity(3)) / 2
    Q = (law["bf"] * E[0, 0] ** 2
         + law["bt"] * (E[1, 1] ** 2 + E[2, 2] ** 2 + 2 * E[1, 2] ** 2)
         + law["bfs"] * 2 * (E[0, 1] ** 2 + E[0, 2] ** 2))
    return law["c"] / 2 * (ufl.exp(Q) - 1)


def _moved(job, x, part):
    """Displacement of the points x (n, 3): a turn about the axis through `origin` along
    job["axis"], then a shift."""
    import numpy as np
    from scipy.spatial.transform import Rotation
    origin = np.array(job.get("origin", [0, 0, 0]))
    turn = Rotation.from_rotvec(np.eye(3)[job["axis"]] * job.get("angle", 0.0) * part)
    return turn.apply(x - origin) + origin - x + part * np.array(job["displacement"])


def _panel(box, panel):
    """Points (n, 3) of the unit cube become those of half of Cook's panel, up to the middle of its thickness:
    finer towards the wall, towards both its ends, and towards the free side."""
    import numpy as np
    x, y, z = box[:, 0] ** 1.5, (1 - np.cos(np.pi * box[:, 1])) / 2, 1 - np.cos(np.pi / 2 * box[:, 2])
    height = panel["left"] + (panel["right"] - panel["left"]) * x
    return np.stack([panel["width"] * x, panel["rise"] * x + y * height, panel["thickness"] / 2 * z], axis=1)


def _run(job):
    """Box with one face held. The opposite face is moved or drawn along, or the face z = 0 is pressed."""
    import numpy as np
    import ufl
    from dolfinx import cpp, fem, la, mesh, nls
    from mpi4py import MPI
    from petsc4py import PETSc

    size, law, panel = job["size"], job["law"], job.get("panel")
    kind = mesh.CellType.hexahedron if panel else mesh.CellType.tetrahedron
    body = mesh.create_box(MPI.COMM_SELF, [[0, 0, 0], [1, 1, 1] if panel else size], job["cells"], kind)
    if panel:
        body.geometry.x[:] = _panel(body.geometry.x, panel)
    cell = body.ufl_cell()
    space = fem.FunctionSpace(body, ufl.MixedElement(ufl.VectorElement("Lagrange", cell, 2),
                                                     ufl.FiniteElement("Lagrange", cell, 1)))
    state = fem.Function(space)
    u, p = ufl.split(state)
    F = ufl.Identity(3) + ufl.grad(u)
    J = ufl.det(F)
    energy = _energy(law, F, J) + p * (J - 1)
    if law.get("kappa"):
        energy -= p ** 2 / (2 * law["kappa"])
    degree = {"quadrature_degree": 5}
    test = ufl.TestFunction(space)
    residual = ufl.derivative(energy * ufl.dx(metadata=degree), state, test)

    axis, moving = job["axis"], "displacement" in job
    displacements, to_displacements = space.sub(0).collapse()

    def facets_at(k, at):
        return np.sort(mesh.locate_entities_boundary(body, 2, lambda x: np.isclose(x[k], at)))

    def face(at):
        return fem.locate_dofs_topological((space.sub(0), displacements), 2, facets_at(axis, at))
    held = fem.Function(displacements)
    conditions = [fem.dirichletbc(held, face(0.0), space.sub(0))]
    if panel:  # the middle of its thickness does not leave its plane
        across = space.sub(0).sub(2)
        middle = fem.locate_dofs_topological(across, 2, facets_at(2, panel["thickness"] / 2))
        conditions.append(fem.dirichletbc(PETSc.ScalarType(0), middle, across))
    target = fem.Function(displacements)
    pressure = fem.Constant(body, PETSc.ScalarType(0))
    if moving:
        far = face(size[axis])
        conditions.append(fem.dirichletbc(target, far, space.sub(0)))
    else:
        facets = facets_at(axis, size[axis]) if panel else facets_at(2, 0.0)
        tags = mesh.meshtags(body, 2, facets, np.ones_like(facets))
        area = ufl.Measure("ds", domain=body, subdomain_data=tags, metadata=degree)
        normal = J * ufl.inv(F).T * ufl.FacetNormal(body)
        along = ufl.as_vector([0, -1, 0]) if panel else normal  # a dead load, or one that follows
        residual += pressure * ufl.inner(along, ufl.split(test)[0]) * area(1)

    problem = fem.petsc.NonlinearProblem(residual, state, conditions)
    solver = nls.petsc.NewtonSolver(MPI.COMM_SELF, problem)
    solver.rtol, solver.atol, solver.max_it = 1e-9, 1e-12, 30
    solver.convergence_criterion = "incremental"
    options = PETSc.Options()
    prefix = solver.krylov_solver.getOptionsPrefix()
    options[f"{prefix}ksp_type"], options[f"{prefix}pc_type"] = "preonly", "lu"
    options[f"{prefix}pc_factor_mat_solver_type"] = "mumps"
    solver.krylov_solver.setFromOptions()

    iterations = 0
    for step in range(1, job["steps"] + 1):
        part = step / job["steps"]
        if moving:
            x = displacements.tabulate_dof_coordinates()
            target.x.array[:] = _moved(job, x, part).reshape(-1)
        else:
            pressure.value = job["pressure"] * part
        count, converged = solver.solve(state)
        iterations += count
        if not converged:
            raise RuntimeError("Newton's iteration has not converged")

    answer = {"dofs": space.dofmap.index_map.size_global, "iterations": iterations}
    moved = state.sub(0).collapse()
    if moving:  # what the moved face feels: the residual of its equations
        forces = fem.petsc.assemble_vector(fem.form(residual)).array[to_displacements].reshape(-1, 3)
        rest = displacements.tabulate_dof_coordinates()
        on_face = np.isclose(rest[:, axis], size[axis])
        moments = np.cross(rest + moved.x.array.reshape(-1, 3), forces)
        answer["force"] = [float(v) for v in forces[on_face].sum(axis=0)]
        answer["moment"] = [float(v) for v in moments[on_face].sum(axis=0)]  # about the origin
    else:
        points = displacements.tabulate_dof_coordinates()
        node = np.linalg.norm(points - job["point"], axis=1).argmin()
        answer["displacement"] = [float(v) for v in moved.x.array[3 * node:3 * node + 3]]
        answer["distance"] = float(np.linalg.norm(points[node] - job["point"]))
    return answer


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as job_file:
        result = _run(json.load(job_file))
    with open(sys.argv[1], "w", encoding="utf-8") as job_file:
        json.dump(result, job_file)
