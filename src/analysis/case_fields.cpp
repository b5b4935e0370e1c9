// SPDX-License-Identifier: GPL-3.0-or-later
#include "case_fields.h"

#include <algorithm>

#include "palpate/fem/elasticity.h"
#include "palpate/scene/scene_fields.h"
#include "palpate/solver/integrator.h"
#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::analysis {

using keys::FieldVisitor;
using keys::Need;
using keys::Range;
using Analysis = std::variant<StaticAnalysis, DynamicAnalysis>;

std::vector<std::string> quantityNames() { return {"reaction"}; }

void describe(keys::FieldVisitor& v, BoxMesh& box) {
  v.vector3(
      {"size", "m", "Edges, before `scale`; one corner is the origin.", keys::Need::kRequired},
      box.size, keys::Range::above(0.0, 1.0e6));
  v.integers3({"cells", "", "Hexahedral cells along the edges, six tetrahedra each.",
               keys::Need::kRequired},
              box.cells, keys::Range::closed(1, 1000));
  v.rule(box.cells.cast<double>().prod() <= 2.0e6, "cells", "at most 2 million cells in all");
}

void describe(keys::FieldVisitor& v, CaseMesh& mesh) {
  const bool file = v.text({"file", "",
                            "Tetrahedra: .msh, .vtk, .vtu or .mesh; a path from the case's "
                            "folder, absolute, `file://` or `package://`."},
                           mesh.file);
  const bool box = v.section({"box", "", "A box cut into tetrahedra."}, mesh.box);
  v.rule(file != box, "", "needs exactly one of file, box");
  v.number({"scale", "", "Metres in one unit of the mesh: 0.001 for millimetres."}, mesh.scale,
           keys::Range::above(0.0, 1.0e6));
}

void describe(keys::FieldVisitor& v, Rotation& rotation) {
  v.vector3({"axis", "", "Direction of the axis, of any length but zero.", keys::Need::kRequired},
            rotation.axis, keys::Range::closed(-1.0e6, 1.0e6));
  v.rule(rotation.axis.norm() > 1.0e-9, "axis", "the axis must not be zero");
  v.vector3({"origin", "m", "A point of the axis."}, rotation.origin, keys::coordinateRange());
  v.number({"angle", "rad", "Turn at the end of the analysis.", keys::Need::kRequired},
           rotation.angle, keys::Range::closed(-1000.0, 1000.0));
}

void describe(keys::FieldVisitor& v, BoundaryCondition& condition) {
  v.section({"select", "", "Nodes of the reference shape.", keys::Need::kRequired},
            condition.select);
  bool any = v.partialVector3(
      {"displacement", "m",
       "At the end of the analysis, added after the rotation; null leaves a component free."},
      condition.displacement, keys::coordinateRange());
  any |= v.section(
      {"rotation", "", "Turns the nodes; without `displacement` all components are prescribed."},
      condition.rotation);
  any |= v.vector3({"traction", "Pa",
                    "Dead load on the reference area of the boundary faces whose corners are all "
                    "selected."},
                   condition.traction, keys::Range::any());
  any |= v.number({"pressure", "Pa", "Follows these faces; positive pushes inward."},
                  condition.pressure, keys::Range::any());
  v.rule(any, "", "needs at least one of displacement, rotation, traction, pressure");
}

void describe(keys::FieldVisitor& v, StaticAnalysis& analysis) {
  v.integer({"load_steps", "", "Equal steps from the reference shape to the full load."},
            analysis.load_steps, keys::Range::closed(1, 100000));
  v.number({"tolerance", "", "Relative residual where Newton's iteration ends."},
           analysis.tolerance, keys::Range::closed(1.0e-14, 0.1));
  v.integer({"max_newton_iterations", "", "Newton iterations in a load step."},
            analysis.max_newton_iterations, keys::Range::closed(1, 1000));
}

void describe(keys::FieldVisitor& v, DynamicAnalysis& analysis) {
  v.choice({"integrator", "", "Time integration."}, analysis.integrator, solver::integratorNames());
  v.choice({"method", "", "How a step is solved, as a cycle of a scene."}, analysis.method,
           tissue::methodNames());
  v.number({"dt", "s", "Time step."}, analysis.dt, keys::Range::above(0.0, 10.0));
  v.number({"duration", "s", "Simulated time.", keys::Need::kRequired}, analysis.duration,
           keys::Range::above(0.0, 1.0e6));
  v.rule(analysis.duration / analysis.dt <= 1.0e7, "duration", "at most 10 million time steps");
  v.number({"ramp_time", "s",
            "In which prescribed displacements and rotations grow to their full size; by default "
            "the duration."},
           analysis.ramp_time, keys::Range::above(0.0, 1.0e6));
  v.section({"damping", "", "Rayleigh damping, in addition to the material's own viscosity."},
            analysis.damping);
  v.number({"tolerance", "", "Relative residual where Newton's iteration ends."},
           analysis.tolerance, keys::Range::closed(1.0e-14, 0.1));
  v.integer({"max_newton_iterations", "", "Newton iterations in a time step."},
            analysis.max_newton_iterations, keys::Range::closed(1, 1000));
  v.number({"linear_tolerance", "", "Relative residual where the linear solver ends."},
           analysis.linear_tolerance, keys::Range::closed(1.0e-14, 0.9));
  v.integer({"max_linear_iterations", "", "Iterations of the linear solver in a Newton iteration."},
            analysis.max_linear_iterations, keys::Range::closed(1, 100000));
}

void describe(keys::FieldVisitor& v, Analysis& analysis) {
  std::string kind;
  v.choice({"kind", "", "What is computed.", keys::Need::kRequired}, kind, {"static", "dynamic"});
  StaticAnalysis for_static;
  DynamicAnalysis for_dynamic;
  v.onlyIf(kind == "static", "kind: static", [&] { describe(v, for_static); });
  v.onlyIf(kind == "dynamic", "kind: dynamic", [&] { describe(v, for_dynamic); });
  if (kind == "static") analysis = for_static;
  if (kind == "dynamic") analysis = for_dynamic;
}

void describe(keys::FieldVisitor& v, Probe& probe) {
  v.name({"name", "", "Names the probe in the result files.", keys::Need::kRequired}, probe.name);
  const bool point = v.vector3({"point", "m",
                                "Point of the reference shape; gives displacement and stress "
                                "there."},
                               probe.point, keys::coordinateRange());
  const bool select =
      v.section({"select", "", "Nodes over which a quantity is summed."}, probe.select);
  const bool quantity = v.choice(
      {"quantity", "",
       "`reaction`: the force that the support exerts on the body and its moment about the "
       "origin."},
      probe.quantity, quantityNames());
  v.rule(point != select && select == quantity, "", "needs either point, or select and quantity");
}

void describe(keys::FieldVisitor& v, Case& c) {
  v.section({"mesh", "", "The body's tetrahedra.", keys::Need::kRequired}, c.mesh);
  v.choice({"element", "", "Finite element."}, c.element, fem::elementNames());
  describe(v, static_cast<scene::BodyConfig&>(c));
  v.list({"boundary", "", "What is prescribed where."}, c.boundary, 0);
  v.vector3({"gravity", "m/s^2", "Acceleration of free fall."}, c.gravity,
            keys::Range::closed(-1.0e6, 1.0e6));
  const bool given = v.section(
      {"analysis", "", "What is computed, and how well.", keys::Need::kRequired}, c.analysis);
  const bool held = std::any_of(c.boundary.begin(), c.boundary.end(),
                                [](const BoundaryCondition& b) { return b.holds(); });
  v.rule(!given || held || std::holds_alternative<DynamicAnalysis>(c.analysis), "boundary",
         "a static case needs a displacement or rotation that holds the body");
  v.list({"probes", "", "What is written to the result files."}, c.probes, 0);
  v.uniqueNames("probes", c.probes);
}

}  // namespace palpate::analysis
