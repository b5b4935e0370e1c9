// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/selection_keys.h"
#include "palpate/scene/surroundings_config.h"

namespace palpate::scene {

void describe(keys::FieldVisitor& v, MotionConfig& motion) {
  const bool wave =
      v.vector3({"amplitude", "m",
                 "Way of a wave at its largest, a direction with its length, in the organ's "
                 "own frame."},
                motion.amplitude, keys::coordinateRange());
  const bool file =
      v.text({"file", "",
              "Table of the way: first row `t,x,y,z`, then times [s] from zero with displacements "
              "[m] from "
              "those of the first row, in the organ's own frame; a path as for `surface`."},
             motion.file);
  v.rule(wave != file, "", "needs exactly one of amplitude, file");
  v.onlyIf(wave, "`amplitude`", [&] {
    v.choice(
        {"waveform", "",
         "`sine`, or `cos4`: the breathing of Lujan et al. (1999), cos^4(pi (c - 1/2)) after c "
         "cycles, which dwells where the organ is at rest. The wave grows to its size within "
         "the first period."},
        motion.form, tissue::waveFormNames());
    v.number({"period", "s", "Of the wave."}, motion.period, keys::Range::closed(1.0e-3, 1.0e6));
    v.number({"phase", "", "Where the wave begins, in cycles."}, motion.phase,
             keys::Range::closed(-1.0, 1.0));
  });
  v.onlyIf(file, "`file`", [&] {
    v.flag({"periodic", "",
            "The table begins anew at its end, where it must be as in its first row, and grows to "
            "its size in its first pass; otherwise the organ stays where the last row is."},
           motion.periodic);
  });
}

void describe(keys::FieldVisitor& v, SupportConfig& support) {
  v.section({"select", "",
             "Where: nodes, for `glue`; for other kinds the faces of the surface of which all "
             "corners are selected. Coordinates in the organ's own frame, after scaling.",
             keys::Need::kRequired},
            support.select);
  v.choice(
      {"kind", "",
       "`glue`: held where it is at rest. `slide`: free along the surface, held normal to it. "
       "`springs`: drawn back to where it is at rest, as by ligaments or fat. Where supports "
       "overlap, what one of them holds is held; of the motions of several the last one holds; "
       "springs add up."},
      support.kind, supportKindNames());
  v.onlyIf(support.kind == "slide", "`kind: slide`", [&] {
    v.number({"stiffness", "Pa/m",
              "Against motion along the normal, where the surface is not a plane across an axis of "
              "the world, which is held exactly. By default a stress that would stretch the organ "
              "by its own size moves the surface by a thousandth of that."},
             support.stiffness, keys::Range::above(0.0, 1.0e15));
  });
  v.onlyIf(support.kind == "springs", "`kind: springs`", [&] {
    const keys::Range stiffness = keys::Range::closed(0.0, 1.0e12);
    const bool normal = v.number({"normal", "Pa/m",
                                  "Stress along the normal by displacement: of a layer of modulus "
                                  "E and thickness t between organ and bone about E/t."},
                                 support.springs.normal, stiffness);
    const bool tangential = v.number({"tangential", "Pa/m", "The same along the surface."},
                                     support.springs.tangential, stiffness);
    v.rule(support.kind != "springs" || normal || tangential, "",
           "springs need at least one of normal, tangential");
    v.number({"normal_damping", "Pa s/m", "Stress along the normal by velocity."},
             support.springs.normal_damping, stiffness);
    v.number({"tangential_damping", "Pa s/m", "The same along the surface."},
             support.springs.tangential_damping, stiffness);
  });
  v.onlyIf(support.kind != "slide", "`kind: glue` or `kind: springs`", [&] {
    v.section({"motion", "",
               "How that which holds it moves in simulated time: breathing, a heartbeat. Springs "
               "follow by their anchors."},
              support.motion);
  });
}

void describe(keys::FieldVisitor& v, PressureConfig& pressure) {
  const bool has_cavity = v.integer(
      {"cavity", "",
       "Presses on the surface of this cavity: 0 is the largest, 1 the next. Cavities are where "
       "the "
       "surface has a closed shell inside another one, or what the tetrahedra leave empty inside."},
      pressure.cavity, keys::Range::closed(0, 1000));
  const bool has_select =
      v.section({"select", "",
                 "Presses on the faces of the surface of which all corners are selected; "
                 "coordinates in the organ's own frame, after scaling."},
                pressure.select);
  v.rule(has_cavity != has_select, "", "needs exactly one of cavity, select");
  v.number({"pressure", "Pa",
            "At rest, above that around the organ; it follows the deformed faces, from the cavity "
            "into the tissue."},
           pressure.pressure, keys::Range::closed(-1.0e6, 1.0e6));
  v.number({"volume_stiffness", "Pa",
            "Of what fills a cavity, such as bile: the pressure falls by this times the relative "
            "growth of the cavity's volume since the organ came to rest. Large against the wall's "
            "modulus the volume is kept; 0: the pressure is constant, as of a gas that can leave."},
           pressure.volume_stiffness, keys::Range::closed(0.0, 1.0e9));
  v.flag({"balanced", "",
          "The mesh is the shape under `pressure`, as it was imaged: the wall is taken to balance "
          "it, and only what differs from it acts. Otherwise the organ is without stress in its "
          "mesh, and comes to rest inflated."},
         pressure.balanced);
}

}  // namespace palpate::scene
