"""usage: dxf_audit.py FILE... - what ezdxf, another reader of DXF files, finds in files of blanks"""
import math
import sys

import ezdxf

for path in sys.argv[1:]:
    document = ezdxf.readfile(path)
    auditor = document.audit()
    if auditor.errors or auditor.fixes:
        sys.exit(f"{path}: {[e.message for e in auditor.errors + auditor.fixes]}")
    space = document.modelspace()
    kinds = {}
    for entity in space:
        key = (entity.dxf.layer, entity.dxftype())
        kinds[key] = kinds.get(key, 0) + 1
        if not document.layers.has_entry(entity.dxf.layer):
            sys.exit(f"{path}: layer {entity.dxf.layer} is not declared")
        if entity.dxf.layer in ("BEND_UP", "BEND_DOWN"):
            tags = entity.get_xdata("SPIA")
            values = {tags[k].value: tags[k + 1].value for k in range(0, len(tags) - 1) if tags[k + 1].code == 1040}
            if tags[0].value != "bend" and tags[1].value != "bend":
                sys.exit(f"{path}: the extended data of a bend are {tags}")
            if not (0 < values["angle_deg"] <= 360 and values["inner_radius"] >= 0 and 0 <= values.get("k", 0) <= 1):
                sys.exit(f"{path}: a bend with {values}")
            if "allowance" in values and "k" in values: # a sharp fold has no K
                arc = math.radians(values["angle_deg"]) * (values["inner_radius"] + values["k"] * values["thickness"])
                if abs(arc - values["allowance"]) > 1e-9 * arc or "deduction" not in values:
                    sys.exit(f"{path}: a bend with {values}, whose arc is {arc} long")
    for name, line_type in (("BEND_UP", "DASHED"), ("BEND_DOWN", "DASHED"), ("BEND_ZONE", "DOT")):
        if document.layers.has_entry(name) and document.layers.get(name).dxf.linetype != line_type:
            sys.exit(f"{path}: layer {name} is {document.layers.get(name).dxf.linetype}")
    # Outlines and holes are closed: every end of what is cut meets another.
    ends = []
    for entity in space:
        if entity.dxf.layer not in ("OUTLINE", "HOLES"):
            continue
        kind = entity.dxftype()
        if kind in ("LWPOLYLINE", "POLYLINE"):
            if not (entity.closed if kind == "LWPOLYLINE" else entity.is_closed):
                sys.exit(f"{path}: a {kind} of {entity.dxf.layer} is open")
        elif kind == "LINE":
            ends += [entity.dxf.start, entity.dxf.end]
        elif kind == "ARC":
            ends += [entity.start_point, entity.end_point]
        elif kind == "SPLINE":
            ends += [ezdxf.math.Vec3(entity.control_points[0]), ezdxf.math.Vec3(entity.control_points[-1])]
        elif kind != "CIRCLE":
            sys.exit(f"{path}: {kind} on {entity.dxf.layer}")
    for k, a in enumerate(ends):
        near = min((math.dist(a.xyz, b.xyz) for j, b in enumerate(ends) if j != k), default=math.inf)
        if near > 1e-6:
            sys.exit(f"{path}: an end at {a} meets nothing within {near}")
    print(path.rsplit("/", 1)[-1], document.dxfversion, dict(sorted(kinds.items())))
