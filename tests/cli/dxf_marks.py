"""usage: dxf_marks.py FILE - how many closed polylines are on layer MARKS, and their area"""
import sys

import ezdxf

areas = []
for entity in ezdxf.readfile(sys.argv[1]).modelspace().query('LWPOLYLINE[layer=="MARKS"]'):
    points = [point[:2] for point in entity.get_points()]
    if entity.closed:
        areas.append(abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1]))) / 2)
print(f"{len(areas)} closed, {sum(areas):.4f} mm2")
